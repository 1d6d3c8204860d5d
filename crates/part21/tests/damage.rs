//! Damaged records cost one error each; everything else is read.

use trimloop_part21::{Exchange, ReadOptions};

/// `#1`, then what is given on its own lines (the first is line 6), then `#9`; `#1` and `#9` must be there. Gives the
/// instances between and the errors as `line:column #instance`.
fn read(between: &str) -> (Vec<u64>, Vec<String>) {
    let text = format!(
        "ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\n#1=A();\n{between}\n#9=Z('x');\nENDSEC;\nEND-ISO-10303-21;\n"
    );
    let exchange = Exchange::parse(text.into_bytes()).expect("an exchange file");
    assert_eq!(exchange.get(1).expect("the instance before").keyword(), "A");
    assert_eq!(exchange.get(9).expect("the instance after").keyword(), "Z");
    let ids = exchange.instances().map(|instance| instance.id()).filter(|id| ![1, 9].contains(id)).collect();
    let error = |error: &trimloop_part21::SyntaxError| {
        let instance = error.instance.map_or("-".into(), |id| format!("#{id}"));
        format!("{}:{} {instance}", error.position.line, error.position.column)
    };
    (ids, exchange.errors().iter().map(error).collect())
}

fn damaged(between: &str, ids: &[u64], errors: &[&str]) {
    assert_eq!(
        read(between),
        (ids.to_vec(), errors.iter().map(|error| error.to_string()).collect()),
        "{between}"
    );
}

#[test]
fn something_that_is_no_parameter() {
    damaged("#2=B(1,?);\n#3=C();", &[3], &["6:8 #2"]);
}

#[test]
fn missing_and_doubled_commas() {
    damaged("#2=B(1 2);\n#3=C(1,,2);\n#4=D(1,);", &[], &["6:8 #2", "7:8 #3", "8:8 #4"]);
}

#[test]
fn a_parenthesis_too_few_and_one_too_many() {
    damaged("#2=B((1,2);\n#3=C((1)));", &[3], &["6:11 #2", "7:10 #3"]);
}

#[test]
fn a_quote_too_few_loses_one_record() {
    damaged("#2=B('abc,$);\n#3=C('x');\n#4=D('y');", &[3, 4], &["6:6 #2"]);
}

#[test]
fn a_quote_too_many_loses_one_record() {
    damaged("#2=B('it's','');\n#3=C('x');", &[3], &["6:10 #2"]);
}

#[test]
fn a_quote_too_few_in_the_last_record() {
    let text = "ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\n#1=A();\n#2=B('abc);\nENDSEC;\nEND-ISO-10303-21;\n";
    let exchange = Exchange::parse(text.into()).unwrap();
    assert_eq!(exchange.len(), 1);
    assert_eq!(exchange.errors().len(), 1);
}

#[test]
fn a_comment_that_is_not_closed_loses_one_record() {
    damaged("#2=B(/* 1);\n#3=C('x');", &[3], &["6:6 #2"]);
}

#[test]
fn a_missing_semicolon_loses_nothing() {
    damaged(
        "#2=B(1)\n#3=C(2)\n#4=D(3);\n#5=E(4) #6=F(5);",
        &[2, 3, 4, 5, 6],
        &["7:1 #2", "8:1 #3", "9:9 #5"],
    );
    damaged("  #2=B(1)\n  #3=C(2)\n\t#4=D(3);", &[2, 3, 4], &["7:3 #2", "8:2 #3"]);
    damaged("  #2=B(?)\n  #3=C(?)\n\t#4=D(3);", &[4], &["6:8 #2", "7:8 #3"]);
}

#[test]
fn a_record_that_breaks_off_before_the_next() {
    damaged("#2=B(1,(2,\n#3=C('x');", &[3], &["7:3 #2"]);
    damaged("#2=B\n#3=C\n#4=D();", &[4], &["7:1 #2", "8:1 #3"]);
    damaged("#2\n#3=C();", &[3], &["7:1 -"]);
}

#[test]
fn a_commented_out_instance_does_not_come_back_when_its_surroundings_are_damaged() {
    damaged("#2=B(?,/*\n#3=C();\n*/1);", &[], &["6:6 #2"]);
}

#[test]
fn numbers_that_are_none() {
    damaged(
        "#2=B(-);\n#3=C(+.);\n#4=D(1.0.0);\n#5=E(NaN);\n#6=F(1.#INF);",
        &[],
        &["6:6 #2", "7:6 #3", "8:9 #4", "9:6 #5", "10:8 #6"],
    );
}

#[test]
fn enumerations_binaries_and_references_that_are_none() {
    damaged("#2=B(.T);\n#3=C(\"0G\");\n#4=D(#);\n#5=E(@);", &[], &["6:6 #2", "7:6 #3", "8:6 #4", "9:6 #5"]);
}

#[test]
fn instance_numbers_beyond_64_bits() {
    damaged("#2=B(#18446744073709551616);\n#18446744073709551616=C();", &[], &["6:7 #2", "7:2 -"]);
}

#[test]
fn no_keyword_no_equals_sign_no_number() {
    damaged("#2=(1);\n#3 B();\n#=C();\nstray text;", &[], &["6:5 #2", "7:4 -", "8:1 -", "9:1 -"]);
}

#[test]
fn complex_instances_that_are_none() {
    damaged("#2=( );\n#3=(A()B(;\n#4=(A()1);", &[], &["6:6 #2", "7:10 #3", "8:8 #4"]);
}

#[test]
fn of_instances_with_the_same_number_the_first_counts() {
    let text = "ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\n#1=A();\n#2=B();\n#1=C();\n#3=D();\nENDSEC;\nEND-ISO-10303-21;\n";
    let exchange = Exchange::parse(text.into()).unwrap();
    assert_eq!(exchange.get(1).unwrap().keyword(), "A");
    assert_eq!(exchange.instances().map(|instance| instance.keyword()).collect::<Vec<_>>(), ["A", "B", "D"]);
    let [error] = exchange.errors() else { panic!("one error") };
    assert_eq!((error.position.line, error.instance), (7, Some(1)));
}

#[test]
fn sections_without_their_end() {
    let text = "ISO-10303-21;\nHEADER;\nFILE_SCHEMA(('S'));\nDATA;\n#1=A();\nEND-ISO-10303-21;\n";
    let exchange = Exchange::parse(text.into()).unwrap();
    assert_eq!((exchange.len(), exchange.header().schemas.len()), (1, 1));
    let lines: Vec<_> = exchange.errors().iter().map(|error| error.position.line).collect();
    assert_eq!(lines, [4, 6], "{:?}", exchange.errors());
    assert!(exchange.errors().iter().all(|error| error.message.contains("ENDSEC is missing")));
}

#[test]
fn text_between_sections_is_passed_over() {
    let text = "ISO-10303-21;\nHEADER;\nENDSEC;\nwhatever;\nDATA;\n#1=A();\nENDSEC;\nEND-ISO-10303-21;\n";
    let exchange = Exchange::parse(text.into()).unwrap();
    assert_eq!((exchange.len(), exchange.errors().len(), exchange.sections().len()), (1, 1, 1));
}

#[test]
fn a_file_without_its_end() {
    let exchange =
        Exchange::parse(b"ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\n#1=A();\n#2=B(1)".to_vec()).unwrap();
    assert_eq!(exchange.len(), 2);
    let [error] = exchange.errors() else { panic!("one error") };
    assert_eq!((error.position.line, error.position.column), (6, 8));
}

#[test]
fn section_words_without_their_semicolon() {
    let text = "ISO-10303-21\nHEADER\nFILE_SCHEMA(('S'))\nENDSEC\nDATA\n#1=A();\nENDSEC\nEND-ISO-10303-21\n";
    let exchange = Exchange::parse(text.into()).unwrap();
    assert_eq!((exchange.len(), exchange.header().schemas.len()), (1, 1));
    assert!(
        exchange.errors().iter().all(|error| error.message.contains("semicolon")),
        "{:?}",
        exchange.errors()
    );
}

#[test]
fn instances_without_any_section_around_them() {
    let exchange = Exchange::parse(b"#1=A();\n#2=B();\n".to_vec()).unwrap();
    assert_eq!(exchange.len(), 2);
    assert!(!exchange.errors().is_empty());
}

#[test]
fn errors_are_in_file_order_and_read_as_sentences_with_a_place() {
    let text = "ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\n#1=A(?);\n#2=A();\n#2=A();\n#3=A(?);\nENDSEC;\nEND-ISO-10303-21;\n";
    let exchange = Exchange::parse(text.into()).unwrap();
    let lines: Vec<_> = exchange.errors().iter().map(|error| error.position.line).collect();
    assert_eq!(lines, [5, 7, 8]);
    assert_eq!(exchange.errors()[0].to_string(), "line 5, column 6: a parameter is expected");
}

#[test]
fn only_so_many_errors_are_kept_but_all_are_counted() {
    let text = format!(
        "ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\n{}ENDSEC;\nEND-ISO-10303-21;\n",
        "#1=A(?);\n".repeat(5000)
    );
    let options = ReadOptions { max_errors: 100, ..ReadOptions::default() };
    let exchange = Exchange::parse_with(text.into(), &options).unwrap();
    assert_eq!(exchange.errors().len(), 101);
    assert!(exchange.errors()[100].message.contains("4900"));
}
