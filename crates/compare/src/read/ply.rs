//! PLY: points and polygons, as text or binary.

use glam::DVec3;
use ply_rs_bw::parser::{Parser, Reader};
use ply_rs_bw::ply::{Property, PropertyAccess, PropertyAccessResult};

use super::{MeshError, MeshFile, millimetres};
use crate::triangles::{Piece, Triangles};

/// A vertex or a face: whatever properties it has, only places and corners matter.
#[derive(Default)]
struct Element {
    point: [f64; 3],
    corners: Vec<u32>,
    unusable: bool,
}

impl PropertyAccess for Element {
    fn new() -> Self {
        Self::default()
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        let axis = match name {
            "x" => 0,
            "y" => 1,
            "z" => 2,
            "vertex_indices" | "vertex_index" => {
                match property.to_u32_list() {
                    Some(corners) => self.corners = corners,
                    None => self.unusable = true,
                }
                return PropertyAccessResult::Set;
            }
            _ => return PropertyAccessResult::Ignored,
        };
        self.point[axis] = match property {
            Property::Char(value) => value.into(),
            Property::UChar(value) => value.into(),
            Property::Short(value) => value.into(),
            Property::UShort(value) => value.into(),
            Property::Int(value) => value.into(),
            Property::UInt(value) => value.into(),
            Property::Float(value) => value.into(),
            Property::Double(value) => value,
            _ => return PropertyAccessResult::UnsupportedType,
        };
        PropertyAccessResult::Set
    }
}

pub(super) fn read(bytes: &[u8]) -> Result<MeshFile, MeshError> {
    let damaged =
        |error: &dyn std::fmt::Display| MeshError::unusable(format!("the PLY file is damaged: {error}"));
    let parser = Parser::<Element>::new();
    let mut reader = Reader::new(bytes);
    let header = parser.read_header(&mut reader).map_err(|error| damaged(&error))?;
    let mut triangles = Triangles::default();
    for (name, element) in &header.elements {
        // Every element takes a byte at least: a larger count is a lie.
        if element.count > bytes.len() {
            return Err(damaged(&format!("{} elements `{name}` in {} bytes", element.count, bytes.len())));
        }
        let found = parser
            .read_payload_for_element(&mut reader, element, &header)
            .map_err(|error| damaged(&error))?;
        match name.as_str() {
            "vertex" => triangles.points = found.iter().map(|it| DVec3::from_array(it.point)).collect(),
            "face" => {
                for face in &found {
                    if face.unusable {
                        return Err(damaged(&"a face has corners that are no whole numbers"));
                    }
                    // Polygons are taken for convex, as everybody does.
                    let fan = face.corners.windows(2).skip(1);
                    triangles.triangles.extend(fan.map(|pair| [face.corners[0], pair[0], pair[1]]));
                }
            }
            _ => {}
        }
    }
    if triangles.triangles.iter().flatten().any(|&index| index as usize >= triangles.points.len()) {
        return Err(damaged(&"a face has a vertex that there is none of"));
    }
    triangles.pieces = vec![Piece { name: String::new(), triangles: 0..triangles.triangles.len() }];
    Ok(millimetres("ply", triangles))
}
