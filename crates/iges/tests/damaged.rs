//! Damaged files: an error or what is left, never a panic.

use proptest::prelude::*;
use trimloop_iges::{IgesFile, ReadError, Section, Value};

fn line(text: &str, section: char, number: u32) -> String {
    format!("{text:<72}{section}{number:>7}\n")
}

/// Two points, the second with a string across two lines.
fn file() -> String {
    [
        line("A file for people", 'S', 1),
        line("1H,,1H;,4Htest,8Htest.igs,3HCAD,3Hpre,32,38,6,308,15,4Htest,1.,2,2HMM,1,", 'G', 1),
        line("0.01,15H20240102.030405,1.E-4,1000.,2Hme,4Hhere,11,0,;", 'G', 2),
        line("     116       1       0       0       0       0       0       000000000", 'D', 1),
        line("     116       0       0       1       0                   FIRST       0", 'D', 2),
        line("     406       2       0       0       0       0       0       000000000", 'D', 3),
        line("     406       0       0       2      15                               0", 'D', 4),
        line("116,1.0,2.5D1,0.;                                                      1", 'P', 1),
        line(&format!("{:<64}       3", format!("406,1,60H{}", "a".repeat(55))), 'P', 2),
        line(&format!("{:<64}       3", "bcdef;"), 'P', 3),
        line("S      1G      2D      4P      3", 'T', 1),
    ]
    .concat()
}

#[test]
fn strings_cross_lines() {
    let text = file();
    let read = IgesFile::parse(text.as_bytes()).expect("a file");
    assert_eq!(read.errors(), []);
    let name = read.get(3).expect("the name").values().nth(2).expect("its text");
    assert_eq!(name.text().expect("a string"), format!("{}bcdef", "a".repeat(55)));
    assert_eq!(read.start(), "A file for people");
}

#[test]
fn wrong_counts_are_reported_and_what_lines_say_of_themselves_is_taken() {
    let text = file().replace("P      3   ", "P      9   ").replace("       2      15", "       1      15");
    let read = IgesFile::parse(text.as_bytes()).expect("a file");
    let [error] = read.errors() else { panic!("{:?}", read.errors()) };
    assert_eq!((error.section, error.line), (Section::Terminate, 11));
    let values: Vec<_> = read.get(3).expect("the name").values().collect();
    assert!(matches!(values[2], Value::Text(text) if text.len() == 60), "{values:?}");
}

/// Every line points back to the first entity, and entries count one line each: the record's end tells.
#[test]
fn records_end_at_their_delimiter_where_nothing_else_tells() {
    let text = file().replace("       3P", "       1P").replace("       2      15", "       1      15");
    let read = IgesFile::parse(text.as_bytes()).expect("a file");
    let name = read.get(3).expect("the name").values().nth(2).expect("its text");
    assert_eq!(name.text().expect("a string"), format!("{}bcdef", "a".repeat(55)));
}

#[test]
fn pointers_to_nowhere_lead_nowhere() {
    let read = IgesFile::parse(file().as_bytes()).expect("a file");
    for number in [0, 2, 5, u32::MAX] {
        assert!(read.get(number).is_none(), "{number}");
    }
}

#[test]
fn a_file_cut_off_anywhere_is_read_as_far_as_it_goes() {
    let text = file();
    for at in 0..text.len() {
        match IgesFile::parse(&text.as_bytes()[..at]) {
            Ok(read) => read.entities().for_each(|entity| assert!(entity.values().count() < 100)),
            Err(error) => assert!(matches!(error, ReadError::Empty | ReadError::NotIges(_)), "{error}"),
        }
    }
}

proptest! {
    #[test]
    fn any_bytes_end_in_a_result(bytes in proptest::collection::vec(any::<u8>(), 0..2000)) {
        let _ = IgesFile::parse(&bytes);
    }

    #[test]
    fn any_changes_end_in_a_result(changes in proptest::collection::vec((0usize..880, any::<u8>()), 0..20)) {
        let mut bytes = file().into_bytes();
        for (at, byte) in changes {
            let at = at % bytes.len();
            bytes[at] = byte;
        }
        if let Ok(read) = IgesFile::parse(&bytes) {
            for entity in read.entities() {
                entity.values().for_each(|value| drop((value.real(), value.integer(), value.text())));
            }
        }
    }
}
