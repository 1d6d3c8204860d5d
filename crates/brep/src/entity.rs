//! Names for the entities of an input file.

use std::fmt;

/// An entity of the input file, as its own users name it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum EntityRef {
    /// No entity: the file as a whole, or something made by a repair.
    #[default]
    None,
    /// STEP instance name, shown as `#14`.
    Step(u64),
    /// IGES directory entry sequence number, shown as `D45`.
    Iges(u32),
}

impl fmt::Display for EntityRef {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::None => Ok(()),
            Self::Step(id) => write!(f, "#{id}"),
            Self::Iges(de) => write!(f, "D{de}"),
        }
    }
}
