//! The two delimiters that a file may choose (IGES 5.3 section 2.2.4.3.1 and .2).

/// What stands between parameters and what ends a record.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Delimiters {
    /// Between parameters; a comma where the file does not say.
    pub parameter: u8,
    /// After the last one; a semicolon where the file does not say.
    pub record: u8,
}

impl Default for Delimiters {
    fn default() -> Self {
        Self { parameter: b',', record: b';' }
    }
}

impl Delimiters {
    /// The delimiters that a Global section begins with, and how many bytes say so.
    pub(crate) fn of_global(text: &[u8]) -> (Self, usize) {
        let mut delimiters = Self::default();
        let mut at = leading_blanks(text);
        match &text[at..] {
            [b'1', b'H' | b'h', chosen, ..] => {
                delimiters.parameter = *chosen;
                at += 3;
            }
            [b',', ..] | [] => {}
            _ => return (delimiters, 0),
        }
        at += usize::from(text.get(at) == Some(&delimiters.parameter));
        at += leading_blanks(&text[at..]);
        if let [b'1', b'H' | b'h', chosen, ..] = &text[at..] {
            delimiters.record = *chosen;
            at += 3;
        }
        at += usize::from(text.get(at) == Some(&delimiters.parameter));
        (delimiters, at)
    }
}

fn leading_blanks(text: &[u8]) -> usize {
    text.iter().take_while(|b| **b == b' ').count()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chosen(text: &str) -> (char, char, &str) {
        let (Delimiters { parameter, record }, at) = Delimiters::of_global(text.as_bytes());
        (char::from(parameter), char::from(record), &text[at..])
    }

    #[test]
    fn a_file_may_choose_both_one_or_none() {
        assert_eq!(chosen("1H,,1H;,4Htest"), (',', ';', "4Htest"));
        assert_eq!(chosen(",,4Htest"), (',', ';', "4Htest"));
        assert_eq!(chosen("1H//1H#/4Htest"), ('/', '#', "4Htest"));
        assert_eq!(chosen("1H||| 4Htest"), ('|', ';', " 4Htest"));
        assert_eq!(chosen(",1H:,4Htest"), (',', ':', "4Htest"));
        assert_eq!(chosen(""), (',', ';', ""));
    }
}
