//! Files from strangers: no panic, no endless loop, no memory or time out of proportion.

use proptest::prelude::*;
use trimloop_part21::{Args, Exchange, Param, ReadError};

/// Looks at everything that can be looked at; gives the number of parameters.
fn walk(exchange: &Exchange) -> usize {
    let mut count = 0;
    for instance in exchange.instances() {
        assert!(exchange.get(instance.id()).is_some_and(|found| found.offset() == instance.offset()));
        assert!(!instance.keyword().is_empty());
        instance.parts().for_each(|(_, args)| count += walk_args(args));
        let known = instance.references().filter(|&id| exchange.get(id).is_some()).count();
        assert!(known <= instance.text().len());
    }
    exchange.anchors().for_each(|anchor| assert!(!anchor.name.contains('>')));
    assert_eq!(exchange.references().len(), exchange.references().count());
    count
}

fn walk_args(args: Args) -> usize {
    let inside = |param| match param {
        Param::List(list) | Param::Typed(_, list) => walk_args(list),
        Param::String(text) => usize::from(text.decode().len() > usize::MAX / 2),
        _ => 0,
    };
    args.map(|param| 1 + inside(param)).sum()
}

fn parse_and_walk(text: &[u8]) -> Result<Exchange, ReadError> {
    let exchange = Exchange::parse(text.to_vec())?;
    walk(&exchange);
    Ok(exchange)
}

const SMALL: &str = "\u{FEFF}ISO-10303-21;
HEADER;
FILE_DESCRIPTION((''),'2;1');
FILE_NAME('n\\X\\E4','',(''),(''),'','','');
FILE_SCHEMA(('S'));
ENDSEC;
ANCHOR;
<a>=#1;
ENDSEC;
REFERENCE;
#9=<u>;
ENDSEC;
DATA('d',('S'));
#1=A('it''s \\X2\\00E4\\X0\\',(1,-2.5E3),.T.,\"0F\",#2,$,*,L(1.),@3); /* c */
#2=(B()C('\\S\\d'));
#3=&SCOPE
#4=D();
ENDSCOPE /#4/ E(#4);
ENDSEC;
END-ISO-10303-21;
";

#[test]
fn cut_anywhere() {
    for length in 0..SMALL.len() {
        let _ = parse_and_walk(&SMALL.as_bytes()[..length]);
    }
    assert_eq!(parse_and_walk(SMALL.as_bytes()).unwrap().errors(), []);
}

#[test]
fn begun_anywhere() {
    for start in 0..SMALL.len() {
        let _ = parse_and_walk(&SMALL.as_bytes()[start..]);
    }
}

#[test]
fn any_byte_replaced_by_one_that_means_something() {
    for at in 0..SMALL.len() {
        for byte in *b"'();,#/*\"\\.<&=\n\0\xff" {
            let mut text = SMALL.as_bytes().to_vec();
            text[at] = byte;
            let _ = parse_and_walk(&text);
        }
    }
}

fn in_data(data: &str) -> Vec<u8> {
    format!("ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\n{data}\nENDSEC;\nEND-ISO-10303-21;\n").into_bytes()
}

#[test]
fn lists_nested_100_000_deep_are_one_error() {
    let (open, close) = ("(".repeat(100_000), ")".repeat(100_000));
    for list in [
        format!("#1=A({open}{close});"),
        format!("#1=A({open}"),
        format!("#1={open}"),
        format!("#1=A({})", "T(".repeat(100_000)),
    ] {
        let exchange = parse_and_walk(&in_data(&format!("{list}\n#2=B();"))).unwrap();
        assert_eq!(exchange.errors().len(), 1, "{:?}", exchange.errors());
        assert_eq!(exchange.errors()[0].instance, Some(1));
        assert!(exchange.get(1).is_none() && exchange.get(2).is_some());
    }
}

#[test]
fn lists_nested_as_deep_as_is_allowed() {
    let nested = |depth: usize| in_data(&format!("#1=A({}{});", "(".repeat(depth), ")".repeat(depth)));
    let exchange = Exchange::parse(nested(63)).unwrap();
    assert_eq!((exchange.errors().len(), walk(&exchange)), (0, 63));
    assert_eq!(Exchange::parse(nested(64)).unwrap().errors().len(), 1);
}

#[test]
fn only_the_beginning_of_a_record() {
    for text in [
        "#",
        "#1",
        "#1=",
        "#1=A",
        "#1=A(",
        "#1=A('",
        "#1=A('x",
        "#1=A(/*",
        "#1=(",
        "#1=(A",
        "#1=&SCOPE",
        "#1=A(1.",
    ] {
        assert!(matches!(parse_and_walk(text.as_bytes()), Err(ReadError::NotPart21(_))), "{text}");
    }
}

/// What makes a careless reader look through the rest of the file again for each of many places. Each text has about
/// half a megabyte; quadratic work would take many minutes.
#[test]
fn nothing_is_searched_for_again_and_again() {
    let repeated = |unit: &str| unit.repeat(500_000 / unit.len());
    for unit in [
        "/*",
        "'",
        "''",
        "/*'",
        "'/*",
        "#1=A('\n",
        "#1=A(/*\n",
        "#1=A('/*')\n",
        "#1=A(1)\n",
        "#1=A(1) ",
        "HEADER;A(/*\nENDSEC;\n",
        "ENDSEC/*",
        "ENDSEC ",
        "DATA(",
        "DATA(/*\n#1=",
        "DATA",
        "HEADER;A(1)",
        "ANCHOR;<",
        "REFERENCE;#1=<",
        "ANCHOR;<a>='\nENDSEC;",
        "#1=&SCOPE ",
        "#1=&SCOPE #2=A();",
        "ENDSCOPE A();",
        "#;",
        ";",
        "(",
        "#1=A(((((((((1;",
        "SIGNATURE;",
        "\\S\\'",
        "\n#",
        "\n ",
        "#1=A(\n'\\S\\'",
        "HEADER;A('\n",
        "\r",
        "#\r#1 = ",
        "#1=A(?)\n'",
        "/*/",
        "*/",
    ] {
        let _ = parse_and_walk(repeated(unit).as_bytes());
        let _ = parse_and_walk(&in_data(&repeated(unit)));
        let _ = parse_and_walk(&in_data(&format!("{};", repeated(unit))));
        let _ = parse_and_walk(&in_data(&format!("{}*/;", repeated(unit))));
        let _ = parse_and_walk(format!("ISO-10303-21;HEADER;{}", repeated(unit)).as_bytes());
    }
}

#[test]
fn a_list_of_a_million_elements() {
    let list = vec!["#1"; 1_000_000].join(",");
    let exchange = Exchange::parse(in_data(&format!("#1=A(({list}),'end');"))).unwrap();
    assert_eq!(walk(&exchange), 1_000_002);
}

#[test]
fn files_that_are_something_else_are_named() {
    let iges = format!("{:72}S      1\n", "a part");
    let mut binary_stl = vec![b'x'; 84 + 50];
    binary_stl[80..84].copy_from_slice(&1u32.to_le_bytes());
    for (bytes, named) in [
        (&b""[..], "empty"),
        (b" \n\0", "empty"),
        (b"%PDF-1.7\n", "PDF"),
        (b"<!DOCTYPE html><html>", "HTML"),
        (b"<?xml version=\"1.0\"?>\n<iso_10303_28>", "STEP-XML"),
        (b"solid cube\nfacet normal 0 0 1", "STL"),
        (b"glTF\x02\0\0\0", "glTF"),
        (b"ply\nformat ascii 1.0", "PLY"),
        (b"DBRep_DrawableShape\n", "OpenCASCADE"),
        (b"\x89HDF\r\n\x1a\n", "HDF5"),
        (b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1", "OLE"),
        (b"version https://git-lfs.github.com/spec/v1\n", "Git LFS"),
        (b"BZh91AY", "bzip2"),
        (iges.as_bytes(), "IGES"),
        (&binary_stl, "binary STL"),
        (b"just some text", "not a STEP file"),
        (b"DATA;\n", "not a STEP file"),
    ] {
        match Exchange::parse(bytes.to_vec()) {
            Err(ReadError::NotPart21(message)) => assert!(message.contains(named), "{named}: {message}"),
            other => panic!("{named}: {other:?}"),
        }
    }
}

proptest! {
    #[test]
    fn any_bytes(bytes in proptest::collection::vec(any::<u8>(), 0..400)) {
        let _ = parse_and_walk(&bytes);
        let _ = parse_and_walk(&[b"ISO-10303-21;DATA;#1=", &bytes[..]].concat());
    }

    #[test]
    fn any_tokens(tokens in proptest::collection::vec(proptest::sample::select(TOKENS.to_vec()), 0..60)) {
        let _ = parse_and_walk(format!("ISO-10303-21;DATA;{}", tokens.concat()).as_bytes());
    }
}

const TOKENS: [&str; 36] = [
    "#1",
    "#2=",
    "\n#3=",
    "\n  #4=",
    " ",
    "A",
    "(",
    ")",
    "(",
    ")",
    ",",
    ";",
    ";\n",
    "'",
    "''",
    "\\S\\",
    "\\X2\\",
    "00E4",
    "\\X0\\",
    "/*",
    "*/",
    "1",
    "1.5E3",
    "$",
    "*",
    ".T.",
    "\"0\"",
    "&SCOPE",
    "ENDSCOPE",
    "/",
    "<a>",
    "ENDSEC;",
    "DATA;",
    "HEADER;",
    "ANCHOR;",
    "REFERENCE;",
];
