//! IGES 5.1 to 5.3 files: text to sections, directory entries and parameters. Knows no entity.
//!
//! [`IgesFile`] holds the Global section, the directory and each entity's parameter text, whose values are read when
//! they are asked for. Reading never fails because of one entity: what is damaged is a [`SyntaxError`], and the rest is
//! there.
//!
//! ```
//! use trimloop_iges::{IgesFile, Value};
//!
//! let line = |text: &str, section: char, number: u32| format!("{text:<72}{section}{number:>7}\n");
//! let text = [
//!     line("", 'S', 1),
//!     line("1H,,1H;,4Htest,,,,,,,,,,1.,2,2HMM;", 'G', 1),
//!     line("     116       1       0       0       0       0       0       000000000", 'D', 1),
//!     line("     116       0       0       1       0", 'D', 2),
//!     line("116,1.0,2.5D1,0.;                                                      1", 'P', 1),
//!     line("S      1G      1D      2P      1", 'T', 1),
//! ];
//! let file = IgesFile::parse(text.concat().as_bytes())?;
//! assert_eq!(file.global().unit_name, "MM");
//!
//! let point = file.get(1).unwrap();
//! assert_eq!(point.directory.entity_type, 116);
//! assert_eq!(point.values().nth(2), Some(Value::Real(25.0)));
//! # Ok::<(), trimloop_iges::ReadError>(())
//! ```

mod compressed;
mod delimiters;
mod directory;
mod entity;
mod error;
mod file;
mod global;
mod lines;
mod value;

pub use delimiters::Delimiters;
pub use directory::{DirectoryEntry, Status};
pub use entity::{Entity, Values};
pub use error::{ReadError, SyntaxError};
pub use file::IgesFile;
pub use global::Global;
pub use lines::Section;
pub use value::Value;
