//! The compressed form says the same as the fixed one.

use trimloop_iges::IgesFile;

const DIRECTORY: [[&str; 2]; 3] = [
    [
        "     116       1       0       0       1       0       0       000000001D      1",
        "     116       5       3       1       0                  A@B       2D      2",
    ],
    [
        "     406       2       0       0       1       0       0       000000001D      3",
        "     406       5       3       2      15                  A@B       2D      4",
    ],
    [
        "     116       4       0       0       1       0       0       000010001D      5",
        "     116       5       3       1       0                               D      6",
    ],
];

fn letter(text: &str, section: char, number: u32) -> String {
    format!("{text:<72}{section}{number:>7}\n")
}

/// A string that crosses a line right after blanks that the compressed form has not kept.
fn name() -> [String; 2] {
    [format!("406,1,70H{}", "a".repeat(50)), format!("{}D3 is no entity here;", "b".repeat(2))]
}

fn fixed() -> String {
    let [first, second] = name();
    let mut text = letter("two points", 'S', 1) + &letter("1H,,1H;,1Ht,,,,,,,,,,1.,2,2HMM;", 'G', 1);
    DIRECTORY.iter().flatten().for_each(|line| text += &format!("{line}\n"));
    text += &letter(&format!("{:<64}{:>8}", "116,1.,2.,3.;", 1), 'P', 1);
    text += &letter(&format!("{first:<64}{:>8}", 3), 'P', 2);
    text += &letter(&format!("{second:<64}{:>8}", 3), 'P', 3);
    text += &letter(&format!("{:<64}{:>8}", "116,4.,5.,6.;", 5), 'P', 4);
    text + &letter("S      1G      1D      6P      4", 'T', 1)
}

fn compressed() -> String {
    let [first, second] = name();
    letter("", 'C', 1)
        + &letter("two points", 'S', 1)
        + &letter("1H,,1H;,1Ht,,,,,,,,,,1.,2,2HMM;", 'G', 1)
        + "D1@1_116@3_0@4_0@5_1@6_0@7_0@8_0@9_00000001@12_5@13_3@14_1\n@15_0@16_@17_@18_A@B@19_2;\n"
        + "116,1.,2.,3.;\n"
        + &format!("D3@1_406@14_2@15_15;\n{}\n{second}\n", first.trim_end())
        + "D5@1_116@9_00010001@14_1@15_0@18_@19_;\n"
        + "116,4.,5.,6.;\n"
        + &letter("S      1G      1D      6P      4", 'T', 1)
}

#[test]
fn both_forms_say_the_same() {
    let [fixed, compressed] =
        [fixed(), compressed()].map(|text| IgesFile::parse(text.as_bytes()).expect("a file"));
    assert_eq!(fixed.errors(), []);
    assert_eq!(compressed.errors(), []);
    assert_eq!((fixed.len(), compressed.len()), (3, 3));
    assert_eq!(fixed.start(), compressed.start());
    assert_eq!(fixed.global(), compressed.global());
    for (a, b) in fixed.entities().zip(compressed.entities()) {
        let mut expected = a.directory.clone();
        expected.line = b.directory.line;
        assert_eq!(&expected, b.directory);
        assert_eq!(a.values().collect::<Vec<_>>(), b.values().collect::<Vec<_>>());
    }
    assert_eq!(compressed.get(1).expect("a point").directory.label, "A@B(2)");
}

#[test]
fn lines_of_damage_are_named() {
    let text = compressed().replace("D5@1_116", "D9@1_116@77_x");
    let file = IgesFile::parse(text.as_bytes()).expect("a file");
    let messages: Vec<String> = file.errors().iter().map(ToString::to_string).collect();
    assert_eq!(
        messages,
        [
            "line 10 (Directory section): entity 5 is numbered 9",
            "line 10 (Directory section): entity 5 has no field 77"
        ]
    );
    assert_eq!(file.len(), 3);
}

#[test]
fn wrong_counts_of_parameter_lines_are_found_out() {
    let text = compressed().replace("@14_2@15_15", "@14_1@15_15");
    let file = IgesFile::parse(text.as_bytes()).expect("a file");
    assert_eq!(file.len(), 3);
    assert_eq!(file.get(5).expect("a point").values().count(), 4);
}

#[test]
fn a_file_cut_off_anywhere_is_read_as_far_as_it_goes() {
    let text = compressed();
    for at in 0..text.len() {
        if let Ok(file) = IgesFile::parse(&text.as_bytes()[..at]) {
            file.entities().for_each(|entity| assert!(entity.values().count() < 100));
        }
    }
}
