//! Strings: every escape of ISO 10303-21, raw bytes, and what is damaged.

use proptest::prelude::*;
use std::borrow::Cow;
use trimloop_part21::{Exchange, Param, Text};

fn decoded(inside: &[u8]) -> String {
    Text(inside).decode().into_owned()
}

#[test]
fn plain_text_is_borrowed() {
    assert!(matches!(Text(b"plain").decode(), Cow::Borrowed("plain")));
    assert!(matches!(Text("größe".as_bytes()).decode(), Cow::Borrowed("größe")));
}

#[test]
fn doubled_apostrophe_and_backslash() {
    assert_eq!(decoded(b"it''s"), "it's");
    assert_eq!(decoded(b"''''"), "''");
    assert_eq!(decoded(br"C:\\parts\\x"), r"C:\parts\x");
}

#[test]
fn x_is_one_byte_of_latin_1() {
    assert_eq!(decoded(br"\X\E4\X\fc"), "äü");
}

#[test]
fn x2_is_utf_16_with_surrogates() {
    assert_eq!(decoded(br"a\X2\03B103b2\X0\b"), "aαβb");
    assert_eq!(decoded(br"\X2\D83DDE00\X0\"), "😀");
    assert_eq!(decoded(br"\X2\\X0\"), "");
}

#[test]
fn x4_is_utf_32() {
    assert_eq!(decoded(br"\X4\0001F600000000E4\X0\!"), "😀ä!");
}

#[test]
fn s_is_the_upper_half_of_the_current_page() {
    // ISO 8859-1, until \P.\ names another: E4 is a-umlaut in -1, FD is dotless i in -9, and F1 is ya-pe in -5.
    assert_eq!(decoded(br"\S\d"), "ä");
    assert_eq!(decoded(br"\PE\\S\Q\S\2\PA\\S\Q"), "бВÑ");
    assert_eq!(decoded(br"\PI\\S\}"), "ı");
}

#[test]
fn s_in_every_page() {
    // What ISO 8859-1 to -9 have at F0, and -3, which has nothing there, at B1 (hexadecimal).
    let characters = [
        ("A", 'p', 'ð'),
        ("B", 'p', 'đ'),
        ("C", '1', 'ħ'),
        ("C", 'p', '\u{FFFD}'),
        ("D", 'p', 'đ'),
        ("D", '1', 'ą'),
        ("E", 'p', '№'),
        ("F", 'p', '\u{650}'),
        ("G", 'p', 'π'),
        ("H", 'p', 'נ'),
        ("I", 'p', 'ğ'),
    ];
    for (page, written, meant) in characters {
        assert_eq!(decoded(format!(r"\P{page}\\S\{written}").as_bytes()), meant.to_string(), "page {page}");
    }
}

#[test]
fn the_section_sign_with_its_apostrophe_single_or_doubled() {
    for (written, meant) in
        [(r"'\S\' 5'", "§ 5"), (r"'\S\''5'", "§5"), (r"'\S\''", "§"), (r"'C:\S\'", r"C:\S\")]
    {
        let text = format!("ISO-10303-21;HEADER;ENDSEC;DATA;#1=A({written},7);ENDSEC;END-ISO-10303-21;");
        let exchange = Exchange::parse(text.into_bytes()).unwrap();
        assert_eq!(exchange.errors(), [], "{written}");
        let mut args = exchange.get(1).unwrap().args();
        let Some(Param::String(string)) = args.next() else { panic!("{written}") };
        assert_eq!(string.decode(), meant);
        assert!(matches!(args.next(), Some(Param::Integer(7))));
    }
}

#[test]
fn raw_bytes_are_utf_8_if_they_can_be_and_latin_1_else() {
    assert_eq!(decoded("Maß ''x''".as_bytes()), "Maß 'x'");
    assert_eq!(decoded(b"Ma\xdf"), "Maß");
    assert_eq!(decoded(b"Ma\xdf \\X\\E4"), "Maß ä");
}

#[test]
fn a_string_over_several_lines_is_one_string() {
    assert_eq!(decoded(b"long\r\n text\nof\rlines"), "long textoflines");
}

#[test]
fn what_is_no_escape_stays() {
    for text in
        [r"C:\Users\X", r"\", r"\X", r"\X\", r"\X\G0", r"\X2", r"\P", r"\PZ\", r"\S", r"\S\", r"\X2\xyz"]
    {
        assert_eq!(decoded(text.as_bytes()), text);
    }
}

#[test]
fn a_run_of_hexadecimal_digits_without_its_end_is_read_as_far_as_it_goes() {
    assert_eq!(decoded(br"\X2\00E400F"), "ä00F");
    assert_eq!(decoded(br"\X4\000000E4z"), "äz");
}

#[test]
fn what_is_no_character_becomes_the_replacement_character() {
    assert_eq!(decoded(br"\X2\D83D\X0\"), "\u{FFFD}");
    assert_eq!(decoded(br"\X4\00110000\X0\"), "\u{FFFD}");
}

/// The ways to write a character, the shortest one at the front.
fn spellings(character: char) -> Vec<String> {
    let code = u32::from(character);
    let mut units = [0; 2];
    let utf16: String = character.encode_utf16(&mut units).iter().map(|unit| format!("{unit:04X}")).collect();
    let mut ways = match character {
        '\'' => vec!["''".into()],
        '\\' => vec![r"\\".into()],
        '\r' | '\n' => vec![],
        _ => vec![character.to_string()],
    };
    ways.push(format!(r"\X2\{utf16}\X0\"));
    ways.push(format!(r"\X4\{code:08X}\X0\"));
    if code < 0x100 {
        ways.push(format!(r"\X\{code:02x}"));
    }
    if (0xa0..0xff).contains(&code) && !matches!(code, 0xa7 | 0xdc) {
        ways.push(format!(r"\S\{}", char::from(code as u8 - 0x80)));
    }
    ways
}

proptest! {
    #[test]
    fn every_spelling_of_every_string_is_read_back(
        characters in proptest::collection::vec((any::<char>(), any::<proptest::sample::Index>()), 0..40)
    ) {
        let meant: String = characters.iter().map(|(character, _)| character).collect();
        let written: String = characters.iter().map(|(character, way)| way.get(&spellings(*character)).clone()).collect();
        // A character after \S\ must not look like the quote that ends a file's string.
        let text = format!("ISO-10303-21;HEADER;ENDSEC;DATA;#1=A('{written}',7);ENDSEC;END-ISO-10303-21;");
        let exchange = Exchange::parse(text.into_bytes()).unwrap();
        prop_assert_eq!(exchange.errors(), &[]);
        let mut args = exchange.get(1).unwrap().args();
        let Some(Param::String(string)) = args.next() else { panic!("no string") };
        prop_assert_eq!(string.decode(), meant);
        prop_assert!(matches!(args.next(), Some(Param::Integer(7))));
    }

    #[test]
    fn any_bytes_decode_to_something(bytes in proptest::collection::vec(any::<u8>(), 0..60)) {
        decoded(&bytes);
    }
}
