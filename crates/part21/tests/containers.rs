//! Files on disk, and exchange files inside gzip and zip containers.
#![cfg(feature = "compression")]

use flate2::{Compression, write::GzEncoder};
use std::io::{Cursor, Write};
use trimloop_part21::{Exchange, FileBytes, ReadError, ReadOptions};
use zip::write::{SimpleFileOptions, ZipWriter};

const TEXT: &str = "ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\n#1=A('x');\nENDSEC;\nEND-ISO-10303-21;\n";

fn gzip(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::fast());
    encoder.write_all(bytes).unwrap();
    encoder.finish().unwrap()
}

fn zip(entries: &[(&str, &[u8])]) -> Vec<u8> {
    let mut writer = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, bytes) in entries {
        writer.start_file(*name, SimpleFileOptions::default()).unwrap();
        writer.write_all(bytes).unwrap();
    }
    writer.finish().unwrap().into_inner()
}

fn is_the_text(bytes: Vec<u8>) {
    assert_eq!(Exchange::parse(bytes).unwrap().text(), TEXT.as_bytes());
}

fn refused(bytes: Vec<u8>, why: &str) {
    match Exchange::parse(bytes) {
        Err(ReadError::NotPart21(message)) => assert!(message.contains(why), "{message}"),
        other => panic!("{other:?}"),
    }
}

#[test]
fn gzip_of_one_and_of_several_members() {
    is_the_text(gzip(TEXT.as_bytes()));
    let (first, second) = TEXT.as_bytes().split_at(30);
    is_the_text([gzip(first), gzip(second)].concat());
}

#[test]
fn gzip_with_padding_after_it() {
    is_the_text([gzip(TEXT.as_bytes()), b"padding".to_vec()].concat());
}

#[test]
fn of_a_zip_the_first_entry_that_is_named_like_a_step_file() {
    is_the_text(zip(&[
        ("readme.txt", &[b'x'; 5000]),
        ("sub/Part.STEP", TEXT.as_bytes()),
        ("other.stp", b"no"),
    ]));
    is_the_text(zip(&[("part.p21", TEXT.as_bytes())]));
}

#[test]
fn of_a_zip_without_such_a_name_the_largest_entry() {
    is_the_text(zip(&[("a", b"small"), ("b", TEXT.as_bytes()), ("c", b"small")]));
}

#[test]
fn gzip_inside_zip() {
    is_the_text(zip(&[("part.stp.gz", &gzip(TEXT.as_bytes()))]));
}

#[test]
fn containers_inside_containers_are_not_opened_without_end() {
    let packed = (0..5).fold(TEXT.as_bytes().to_vec(), |bytes, _| gzip(&bytes));
    refused(packed, "gzip");
}

#[test]
fn a_zip_with_nothing_in_it() {
    refused(zip(&[]), "no file");
}

#[test]
fn a_zip_with_something_else_in_it() {
    refused(zip(&[("a.pdf", b"%PDF-1.7")]), "PDF");
}

#[test]
fn damaged_containers() {
    let gzipped = gzip(TEXT.as_bytes());
    refused(gzipped[..gzipped.len() - 20].to_vec(), "gzip container is damaged");
    refused(b"PK\x03\x04 and no more".to_vec(), "zip container cannot be read");
    let mut zipped = zip(&[("part.stp", &TEXT.repeat(50).into_bytes())]);
    zipped[60] ^= 0xff;
    refused(zipped, "zip container");
}

#[test]
fn what_unpacks_to_more_than_the_cap_is_refused_whatever_it_declares() {
    let options = ReadOptions { max_bytes: 10_000, ..ReadOptions::default() };
    let bomb = [TEXT.as_bytes(), &vec![b' '; 50_000_000]].concat();
    for packed in [gzip(&bomb), zip(&[("part.stp", &bomb)]), bomb] {
        assert!(matches!(Exchange::parse_with(packed, &options), Err(ReadError::TooLarge { cap: 10_000 })));
    }
    assert!(Exchange::parse_with(gzip(TEXT.as_bytes()), &options).is_ok());
}

#[test]
fn files_are_read_packed_or_not() {
    let folder = tempfile::tempdir().unwrap();
    for (name, bytes) in [("a.stp", TEXT.as_bytes().to_vec()), ("a.stp.gz", gzip(TEXT.as_bytes()))] {
        let path = folder.path().join(name);
        std::fs::write(&path, bytes).unwrap();
        let exchange = Exchange::read(&path, &ReadOptions::default()).unwrap();
        assert_eq!((exchange.len(), exchange.errors().len()), (1, 0));
    }
}

#[test]
fn files_that_cannot_be_read() {
    let folder = tempfile::tempdir().unwrap();
    let read = |name: &str, options| Exchange::read(&folder.path().join(name), &options);
    assert!(matches!(read("none.stp", ReadOptions::default()), Err(ReadError::Io(_))));
    assert!(matches!(read(".", ReadOptions::default()), Err(ReadError::Io(_))));
    std::fs::write(folder.path().join("empty.stp"), b"").unwrap();
    assert!(matches!(read("empty.stp", ReadOptions::default()), Err(ReadError::NotPart21(_))));
    std::fs::write(folder.path().join("large.stp"), TEXT).unwrap();
    let small = ReadOptions { max_bytes: 20, ..ReadOptions::default() };
    assert!(matches!(read("large.stp", small), Err(ReadError::TooLarge { cap: 20 })));
}

#[test]
fn bytes_of_files_are_as_they_lie_there() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.igs");
    let read = |max_bytes| FileBytes::read(&path, &ReadOptions { max_bytes, ..ReadOptions::default() });
    assert!(matches!(read(10), Err(ReadError::Io(_))));
    for text in ["", "0123456789"] {
        std::fs::write(&path, text).unwrap();
        assert_eq!(&*read(10).unwrap(), text.as_bytes());
    }
    assert!(matches!(read(9), Err(ReadError::TooLarge { cap: 9 })));
}
