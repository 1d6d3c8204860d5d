//! Header, sections and what surrounds them.

use trimloop_part21::{Exchange, Param, Position};

fn parse(text: &str) -> Exchange {
    Exchange::parse(text.as_bytes().to_vec()).expect("an exchange file")
}

const HEADER: &str = "ISO-10303-21;
HEADER;
/* made by hand */
FILE_DESCRIPTION(('a part','in two lines'),'2;1');
FILE_NAME('part.stp','2024-01-02T03:04:05',('M\\X\\FCller'),('Firm','Other'),'pre 1','CAD 2','nobody');
FILE_SCHEMA(('AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }'));
ENDSEC;
";

#[test]
fn the_header() {
    let exchange = parse(&format!("{HEADER}DATA;\nENDSEC;\nEND-ISO-10303-21;"));
    let header = exchange.header();
    assert_eq!(header.description, ["a part", "in two lines"]);
    assert_eq!(header.implementation_level, "2;1");
    assert_eq!(header.name, "part.stp");
    assert_eq!(header.time_stamp, "2024-01-02T03:04:05");
    assert_eq!(header.author, ["Müller"]);
    assert_eq!(header.organization, ["Firm", "Other"]);
    assert_eq!(header.preprocessor_version, "pre 1");
    assert_eq!(header.originating_system, "CAD 2");
    assert_eq!(header.authorization, "nobody");
    assert_eq!(header.schemas, ["AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }"]);
    assert_eq!(exchange.errors(), []);
    assert!(exchange.is_empty());
}

#[test]
fn header_entities_that_are_not_known_are_passed_over() {
    let text = "ISO-10303-21;HEADER;SECTION_LANGUAGE($,'en');!OURS(1);FILE_SCHEMA(('S'));ENDSEC;DATA;ENDSEC;END-ISO-10303-21;";
    assert_eq!(parse(text).header().schemas, ["S"]);
    assert_eq!(parse(text).errors(), []);
}

#[test]
fn a_string_where_the_header_should_have_a_list() {
    let text = "ISO-10303-21;HEADER;FILE_NAME('','','me',$,'','','');FILE_SCHEMA('S');ENDSEC;DATA;ENDSEC;END-ISO-10303-21;";
    let header = parse(text).header().clone();
    assert_eq!(
        (header.author, header.organization, header.schemas),
        (vec!["me".into()], vec![], vec!["S".into()])
    );
}

#[test]
fn a_damaged_header_entity_is_one_error_and_the_others_are_read() {
    let text = "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((?),'');\nFILE_SCHEMA(('S'));\nENDSEC;\nDATA;\n#1=A();\nENDSEC;\nEND-ISO-10303-21;";
    let exchange = parse(text);
    assert_eq!(exchange.errors().len(), 1);
    assert_eq!(exchange.errors()[0].position, Position { line: 3, column: 19 });
    assert_eq!(exchange.header().schemas, ["S"]);
    assert_eq!(exchange.len(), 1);
}

#[test]
fn instances_in_file_order_and_by_number() {
    let exchange = parse(&format!("{HEADER}DATA;\n#30=C();\n#10=A();\n#20=B();\nENDSEC;\nEND-ISO-10303-21;"));
    assert_eq!(exchange.instances().map(|instance| instance.id()).collect::<Vec<_>>(), [30, 10, 20]);
    assert_eq!(exchange.get(10).unwrap().keyword(), "A");
    assert_eq!(exchange.index_of(20), Some(2));
    assert!(exchange.get(11).is_none() && exchange.get(0).is_none() && exchange.get(u64::MAX).is_none());
    assert_eq!(exchange.at(0).id(), 30);
}

#[test]
fn numbers_far_apart() {
    let exchange = parse(&format!(
        "{HEADER}DATA;\n#18446744073709551615=C();\n#1=A();\n#9000000000=B();\nENDSEC;\nEND-ISO-10303-21;"
    ));
    assert_eq!(exchange.errors(), []);
    assert_eq!(exchange.get(u64::MAX).unwrap().keyword(), "C");
    assert_eq!(exchange.get(9_000_000_000).unwrap().keyword(), "B");
    assert!(exchange.get(2).is_none());
}

#[test]
fn several_data_sections_with_names_and_schemas() {
    let text = "ISO-10303-21;HEADER;ENDSEC;DATA('one',('S1'));#1=A();#2=B();ENDSEC;DATA ( 'two' , ('S2','S3') ) ;#3=C();ENDSEC;END-ISO-10303-21;";
    let exchange = parse(text);
    assert_eq!(exchange.errors(), []);
    let [one, two] = exchange.sections() else { panic!("two sections") };
    assert_eq!(
        (one.name.as_str(), &one.schemas[..], one.instances.clone()),
        ("one", &["S1".to_string()][..], 0..2)
    );
    assert_eq!((two.name.as_str(), two.schemas.len(), two.instances.clone()), ("two", 2, 2..3));
}

#[test]
fn the_sections_of_edition_3() {
    let text = "ISO-10303-21;HEADER;ENDSEC;
ANCHOR;
<top;it's>=#10;
<b>=$ {tag:'x'};
<list>=(#1,<other>);
ENDSEC;
REFERENCE;
#50 = <http://example.com/a;b#c>;
@51=<#local>;
ENDSEC;
DATA;
#10=A(#50);
ENDSEC;
END-ISO-10303-21;
SIGNATURE
MIIB/+=';
ENDSEC;";
    let exchange = parse(text);
    assert_eq!(exchange.errors(), []);
    let anchors: Vec<_> = exchange.anchors().collect();
    assert_eq!(anchors.iter().map(|anchor| anchor.name).collect::<Vec<_>>(), ["top;it's", "b", "list"]);
    assert!(matches!(anchors[0].item, Param::Reference(10)));
    assert!(matches!(anchors[1].item, Param::Omitted));
    let references: Vec<_> = exchange.references().map(|reference| (reference.name, reference.uri)).collect();
    assert_eq!(references, [("#50", "http://example.com/a;b#c"), ("@51", "#local")]);
    assert_eq!(exchange.len(), 1);
}

#[test]
fn a_signature_inside_the_file_is_passed_over() {
    let text = "ISO-10303-21;HEADER;ENDSEC;SIGNATURE;MIIB/*'\nENDSEC;DATA;#1=A();ENDSEC;END-ISO-10303-21;";
    assert_eq!(parse(text).errors(), []);
    assert_eq!(parse(text).len(), 1);
}

#[test]
fn every_line_ending() {
    let text = format!("{HEADER}DATA;\n#1=A(\n1);\n#2=B(?);\nENDSEC;\nEND-ISO-10303-21;");
    for ending in ["\n", "\r\n", "\r"] {
        let exchange = parse(&text.replace('\n', ending));
        assert_eq!(exchange.len(), 1);
        assert_eq!(exchange.errors().len(), 1);
        assert_eq!(exchange.errors()[0].position, Position { line: 11, column: 6 });
    }
}

#[test]
fn byte_order_mark_and_text_before_the_beginning() {
    let text = format!("{HEADER}DATA;\n#1=A();\nENDSEC;\nEND-ISO-10303-21;");
    for before in ["\u{FEFF}", "\n\n  ", "Content-Type: model/step\n\n", "/* comment */"] {
        let exchange = parse(&format!("{before}{text}"));
        assert_eq!((exchange.len(), exchange.errors().len()), (1, 0), "{before:?}");
    }
}

#[test]
fn utf_16() {
    let text = format!("{HEADER}DATA;\n#1=A('ü');\nENDSEC;\nEND-ISO-10303-21;");
    let units = |mark: bool| {
        "\u{FEFF}".encode_utf16().filter(move |_| mark).chain(text.encode_utf16()).collect::<Vec<_>>()
    };
    for mark in [true, false] {
        for bytes in [u16::to_le_bytes, u16::to_be_bytes] {
            let exchange = Exchange::parse(units(mark).into_iter().flat_map(bytes).collect()).unwrap();
            assert_eq!(exchange.errors(), []);
            let Some(Param::String(string)) = exchange.get(1).unwrap().args().next() else {
                panic!("no string")
            };
            assert_eq!(string.decode(), "ü");
        }
    }
}

#[test]
fn what_follows_the_end_is_ignored() {
    let exchange = parse(&format!("{HEADER}DATA;\n#1=A();\nENDSEC;\nEND-ISO-10303-21;\n\0\0\u{1a} #2=B('"));
    assert_eq!((exchange.len(), exchange.errors().len()), (1, 0));
}

#[test]
fn scope_structures_of_edition_1() {
    let text = "ISO-10303-21;HEADER;ENDSEC;DATA;
#1=&SCOPE
#2=POINT(1.);
#3 = &SCOPE #4=POINT(2.); ENDSCOPE /#4/ LINE(#4);
ENDSCOPE /#2, #3/ CURVE(#2,#3);
#5=POINT(3.);
ENDSEC;END-ISO-10303-21;";
    let exchange = parse(text);
    assert_eq!(exchange.errors(), []);
    let found: Vec<_> = exchange.instances().map(|instance| (instance.id(), instance.keyword())).collect();
    assert_eq!(found, [(2, "POINT"), (4, "POINT"), (3, "LINE"), (1, "CURVE"), (5, "POINT")]);
    assert_eq!(exchange.get(1).unwrap().references().collect::<Vec<_>>(), [2, 3]);
}
