//! ISO 10303-21 exchange files ("STEP files"): text to an entity table. Knows no schema.
//!
//! [`Exchange`] holds the text and a table of records; a record's arguments are parsed when they are asked for. Reading
//! never fails because of one record: each damaged one is a [`SyntaxError`], and the others are there.
//!
//! ```
//! use trimloop_part21::{Exchange, Param};
//!
//! let text = "ISO-10303-21;
//! HEADER;
//! FILE_DESCRIPTION((''),'2;1');
//! FILE_NAME('','',(''),(''),'','','');
//! FILE_SCHEMA(('AUTOMOTIVE_DESIGN'));
//! ENDSEC;
//! DATA;
//! #10=CARTESIAN_POINT('origin',(0.,0.,2.5E1));
//! ENDSEC;
//! END-ISO-10303-21;";
//! let exchange = Exchange::parse(text.into())?;
//! assert_eq!(exchange.header().schemas, ["AUTOMOTIVE_DESIGN"]);
//!
//! let point = exchange.get(10).unwrap();
//! assert_eq!(point.keyword(), "CARTESIAN_POINT");
//! let mut args = point.args();
//! let Some(Param::String(name)) = args.next() else { panic!() };
//! assert_eq!(name.decode(), "origin");
//! let Some(Param::List(coordinates)) = args.next() else { panic!() };
//! assert!(matches!(coordinates.last(), Some(Param::Real(25.0))));
//! # Ok::<(), trimloop_part21::ReadError>(())
//! ```
//!
//! One pass over the bytes finds where records end, knowing only strings and comments; then all records are
//! checked against the grammar in parallel.

mod anchor;
mod check;
#[cfg(feature = "compression")]
mod container;
mod error;
mod exchange;
mod fault;
mod grammar;
mod header;
mod ids;
mod instance;
mod layout;
mod looks_like;
mod open;
mod options;
mod param;
mod position;
mod record;
mod scan;
mod scope;
mod source;
mod text;
mod utf16;

pub use anchor::{Anchor, ExternalReference};
pub use error::{ReadError, SyntaxError};
pub use exchange::{DataSection, Exchange};
pub use header::Header;
pub use instance::Instance;
pub use options::ReadOptions;
pub use param::{Args, Param};
pub use position::Position;
pub use source::FileBytes;
pub use text::Text;
