//! What the process tells its caller.

/// How a run ended; the greater, the worse.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Outcome {
    /// All well.
    Good,
    /// Written, but a face was lost or a part of the file could not be read (or, where that is asked to be strict, a
    /// face was only approximated).
    Incomplete,
    /// Nothing usable: bad usage, unreadable file, unwritable output.
    Failed,
    /// Stopped by the user.
    Cancelled,
}

impl Outcome {
    /// The process's exit code.
    pub const fn code(self) -> u8 {
        match self {
            Self::Good => 0,
            Self::Incomplete => 1,
            Self::Failed => 2,
            Self::Cancelled => 130,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Outcome;

    #[test]
    fn the_worst_of_several_inputs_wins() {
        let outcomes = [Outcome::Good, Outcome::Failed, Outcome::Incomplete];
        assert_eq!(outcomes.into_iter().max(), Some(Outcome::Failed));
    }
}
