//! Every kind of parameter and instance that ISO 10303-21 has.

use trimloop_part21::{Args, Exchange, Param};

/// A file with these instances.
fn exchange(data: &str) -> Exchange {
    let text = format!("ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\n{data}\nENDSEC;\nEND-ISO-10303-21;\n");
    Exchange::parse(text.into_bytes()).expect("an exchange file")
}

/// The arguments of `#1=A(...)`, written out in a form of their own.
fn written(args: &str) -> String {
    let exchange = exchange(&format!("#1=A({args});"));
    assert_eq!(exchange.errors(), []);
    let parameters = exchange.get(1).expect("the instance").args();
    show(parameters)
}

fn show(args: Args) -> String {
    args.map(show_one).collect::<Vec<_>>().join(" ")
}

fn show_one(param: Param) -> String {
    match param {
        Param::Omitted => "omitted".into(),
        Param::Derived => "derived".into(),
        Param::Integer(value) => format!("i{value}"),
        Param::Real(value) => format!("r{value}"),
        Param::String(text) => format!("s<{}>", text.decode()),
        Param::Enumeration(name) => format!(".{name}."),
        Param::Binary(digits) => format!("b{digits}"),
        Param::Reference(id) => format!("#{id}"),
        Param::Other(name) => format!("other{name}"),
        Param::List(list) => format!("[{}]", show(list)),
        Param::Typed(name, list) => format!("{name}[{}]", show(list)),
    }
}

#[test]
fn no_parameters() {
    assert_eq!(written(""), "");
    assert_eq!(written("  "), "");
}

#[test]
fn omitted_and_derived() {
    assert_eq!(written("$,*, $ ,* "), "omitted derived omitted derived");
}

#[test]
fn integers() {
    assert_eq!(written("0,-1,+12,007,99999999999999999999"), "i0 i-1 i12 i7 i9223372036854775807");
}

#[test]
fn reals() {
    assert_eq!(written("1.,-2.5,3.25E2,1.E-3,+4.e+2"), "r1 r-2.5 r325 r0.001 r400");
}

#[test]
fn reals_as_careless_writers_have_them() {
    assert_eq!(written(".5,-.5,1E5,1.5D3,2.d-1"), "r0.5 r-0.5 r100000 r1500 r0.2");
}

#[test]
fn a_real_beyond_the_range_is_infinite_and_one_below_it_zero() {
    assert_eq!(written("1.E308,1.E309,-1.E309,1.E-400"), format!("r{} rinf r-inf r0", 1e308));
}

#[test]
fn strings() {
    assert_eq!(
        written("'','a b','it''s','/* no comment */','a;b'"),
        "s<> s<a b> s<it's> s</* no comment */> s<a;b>"
    );
}

#[test]
fn enumerations_and_logicals() {
    assert_eq!(written(".T.,.U.,.MILLI.,.milli.,.A_1."), ".T. .U. .MILLI. .milli. .A_1.");
}

#[test]
fn binaries() {
    assert_eq!(written("\"0\",\"3A\",\"01fF\""), "b0 b3A b01fF");
}

#[test]
fn references_up_to_64_bits() {
    assert_eq!(written("#1,#007,#18446744073709551615"), "#1 #7 #18446744073709551615");
}

#[test]
fn value_and_constant_references_of_edition_3() {
    assert_eq!(written("@12,#PI,@C_1"), "other@12 other#PI other@C_1");
}

#[test]
fn lists_inside_lists() {
    assert_eq!(written("(),(1,(2,(3)),4),5"), "[] [i1 [i2 [i3]] i4] i5");
}

#[test]
fn typed_parameters() {
    assert_eq!(
        written("LENGTH_MEASURE(2.5),!MINE('x'),a(B((1)))"),
        "LENGTH_MEASURE[r2.5] !MINE[s<x>] a[B[[i1]]]"
    );
}

#[test]
fn parentheses_in_strings_and_comments_do_not_count_when_a_list_is_passed_over() {
    let exchange = exchange("#1=A((')',(/*)*/1)),2);");
    let last = exchange.get(1).unwrap().args().nth(1);
    assert!(matches!(last, Some(Param::Integer(2))));
}

#[test]
fn white_space_comments_and_print_controls_anywhere_between_tokens() {
    let spread = "/*a*/( /*b*/1 /**/,\r\n/* ' ; */ 'x' \t, \\N\\ #2 )/***/ , \\F\\ T /*c*/ ( .A. )";
    assert_eq!(written(spread), "[i1 s<x> #2] T[.A.]");
}

#[test]
fn counting_and_skipping_agree_with_iterating() {
    let exchange = exchange("#1=A((1,(2)),'x',T((3)),$,4.5);");
    let args = exchange.get(1).unwrap().args();
    assert_eq!(args.count(), args.collect::<Vec<_>>().len());
    assert!(matches!(args.clone().nth(3), Some(Param::Omitted)));
    assert!(matches!(args.clone().nth(4), Some(Param::Real(4.5))));
    assert!(args.clone().nth(5).is_none());
}

#[test]
fn iterating_a_copy_starts_anew() {
    let exchange = exchange("#1=A((1,2),3);");
    let args = exchange.get(1).unwrap().args();
    let mut copy = args;
    copy.by_ref().for_each(drop);
    assert!(copy.next().is_none());
    assert_eq!(show(args), "[i1 i2] i3");
}

#[test]
fn all_references_of_an_instance_in_order() {
    let exchange = exchange("#1=(A(#5,(#3,(#4)))B()C(T(#5),'#9'));");
    assert_eq!(exchange.get(1).unwrap().references().collect::<Vec<_>>(), [5, 3, 4, 5]);
}

#[test]
fn a_simple_instance_has_one_part() {
    let exchange = exchange("#7=PLANE('',#1);");
    let plane = exchange.get(7).unwrap();
    assert_eq!((plane.id(), plane.keyword(), plane.is_complex()), (7, "PLANE", false));
    assert_eq!(
        plane.parts().map(|(name, args)| (name, show(args))).collect::<Vec<_>>(),
        [("PLANE", "s<> #1".into())]
    );
    assert_eq!(plane.part("plane").map(show).as_deref(), Some("s<> #1"));
    assert!(plane.part("LINE").is_none());
}

#[test]
fn a_complex_instance_has_its_parts_in_order() {
    let exchange = exchange("#7=(LENGTH_UNIT()NAMED_UNIT(*) /* and */\nSI_UNIT(.MILLI.,.METRE.));");
    let unit = exchange.get(7).unwrap();
    assert!(unit.is_complex());
    assert_eq!(unit.keyword(), "LENGTH_UNIT");
    assert_eq!(show(unit.args()), "");
    assert_eq!(
        unit.parts().map(|(name, _)| name).collect::<Vec<_>>(),
        ["LENGTH_UNIT", "NAMED_UNIT", "SI_UNIT"]
    );
    assert_eq!(unit.part("SI_UNIT").map(show).as_deref(), Some(".MILLI. .METRE."));
}

#[test]
fn user_defined_and_lower_case_keywords_stay_as_written() {
    let exchange = exchange("#1=!MY_OWN('x');\n#2=plane('');");
    assert_eq!(exchange.get(1).unwrap().keyword(), "!MY_OWN");
    assert_eq!(exchange.get(2).unwrap().keyword(), "plane");
}

#[test]
fn blanks_and_comments_around_the_number_and_the_keyword() {
    let exchange = exchange("# 12 /*x*/ = /*y*/ A /*z*/ (1) /*end*/ ;\n#13\n=\nB\n(2)\n;");
    assert_eq!(exchange.errors(), []);
    assert_eq!(show(exchange.get(12).unwrap().args()), "i1");
    assert_eq!(show(exchange.get(13).unwrap().args()), "i2");
}

#[test]
fn a_comment_longer_than_64_kib_before_a_keyword() {
    let exchange = exchange(&format!("#1=/*{}*/PLANE('',#2);", "x".repeat(70_000)));
    let plane = exchange.get(1).unwrap();
    assert_eq!((plane.keyword(), show(plane.args()).as_str()), ("PLANE", "s<> #2"));
    assert_eq!(plane.part("PLANE").map(show).as_deref(), Some("s<> #2"));
}

#[test]
fn an_instance_knows_where_it_is_written() {
    let exchange = exchange("#1=A();\n  #2=B(1) ;");
    let second = exchange.get(2).unwrap();
    assert_eq!(second.text(), b"#2=B(1)");
    assert_eq!(&exchange.text()[second.offset()..][..3], b"#2=");
    assert_eq!(exchange.position(second.offset()).line, 6);
    assert_eq!(exchange.position(second.offset()).column, 3);
}
