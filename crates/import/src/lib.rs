//! What CAD file entities mean: STEP (AP203, AP214, AP242) and IGES (5.1 to 5.3) to the exact model.
//!
//! ```
//! use trimloop_import::import_step;
//! use trimloop_part21::Exchange;
//!
//! let text = "ISO-10303-21;
//! HEADER;
//! FILE_DESCRIPTION((''),'2;1');
//! FILE_NAME('','',(''),(''),'','','');
//! FILE_SCHEMA(('AUTOMOTIVE_DESIGN'));
//! ENDSEC;
//! DATA;
//! #1=CARTESIAN_POINT('',(0.,0.,0.));
//! #2=AXIS2_PLACEMENT_3D('',#1,$,$);
//! #3=SPHERICAL_SURFACE('',#2,2.);
//! #4=ADVANCED_FACE('ball',(),#3,.T.);
//! #5=CLOSED_SHELL('',(#4));
//! #6=MANIFOLD_SOLID_BREP('solid',#5);
//! ENDSEC;
//! END-ISO-10303-21;";
//! let model = import_step(&Exchange::parse(text.into())?)?;
//! assert_eq!(model.parts[0].bodies[0].name, "solid");
//! assert_eq!(model.parts[0].faces[0].name, "ball");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! One pass classifies the records; products, uses and styles are then read once each, and every part on its own:
//! first its topology, which only follows references, then its geometry, each curve, surface and edge by itself.
//! What is wrong with the file is repaired where that is possible and reported in any case; one bad entity costs
//! at most its face.

mod hint;
mod iges;
mod parallel;
mod run;
mod seam;
mod sew;
mod sniff;
mod split;
mod step;
mod tspline;

use std::path::Path;

use trimloop_brep::Model;
use trimloop_geom::TSpline;
use trimloop_iges::IgesFile;
use trimloop_part21::{Exchange, FileBytes, ReadError, ReadOptions};

pub use self::sniff::Format;

/// What the caller wants of an import.
#[derive(Clone, Debug)]
pub struct ImportOptions {
    /// The most bytes a packed file may unpack to.
    pub max_unpacked_bytes: u64,
}

impl Default for ImportOptions {
    /// 4 GiB.
    fn default() -> Self {
        Self { max_unpacked_bytes: 4 << 30 }
    }
}

/// Why nothing could be imported.
#[derive(Debug, thiserror::Error)]
pub enum ImportError {
    /// The file could not be read as an exchange file.
    #[error(transparent)]
    Part21(#[from] ReadError),
    /// The file could not be read as an IGES file.
    #[error(transparent)]
    Iges(#[from] trimloop_iges::ReadError),
    /// The file could not be read as a T-spline.
    #[error(transparent)]
    TSpline(#[from] trimloop_geom::tspline::TextError),
    /// Nothing in it is geometry that can be shown.
    #[error("{0}")]
    Nothing(String),
}

/// A CAD file whose text has been read, and whose meaning has not.
#[derive(Debug)]
pub enum Parsed {
    /// ISO 10303-21.
    Step(Exchange),
    /// IGES.
    Iges(IgesFile),
    /// A T-spline.
    TSpline(TSpline),
}

impl Parsed {
    /// Reads a CAD file, whatever its format (by content, not by name).
    pub fn read(path: &Path, options: &ImportOptions) -> Result<Self, ImportError> {
        let read = ReadOptions { max_bytes: options.max_unpacked_bytes, ..ReadOptions::default() };
        Ok(match Format::of_file(path).map_err(ReadError::Io)? {
            Format::Step => Self::Step(Exchange::read(path, &read)?),
            Format::Iges => Self::Iges(IgesFile::parse(&FileBytes::read(path, &read)?)?),
            Format::TSpline => {
                let bytes = FileBytes::read(path, &read)?;
                Self::TSpline(TSpline::parse(&String::from_utf8_lossy(&bytes))?)
            }
        })
    }

    /// What it means.
    pub fn import(&self) -> Result<Model, ImportError> {
        match self {
            Self::Step(exchange) => import_step(exchange),
            Self::Iges(file) => import_iges(file),
            Self::TSpline(spline) => tspline::import(spline),
        }
    }
}

/// The exact model of a CAD file: [`Parsed::read`], then [`Parsed::import`].
pub fn read(path: &Path, options: &ImportOptions) -> Result<Model, ImportError> {
    Parsed::read(path, options)?.import()
}

/// The exact model of a parsed IGES file.
pub fn import_iges(file: &IgesFile) -> Result<Model, ImportError> {
    iges::import(file)
}

/// The exact model of a parsed STEP file.
pub fn import_step(exchange: &Exchange) -> Result<Model, ImportError> {
    step::import(exchange)
}
