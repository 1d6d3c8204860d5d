//! T-splines in this project's own text format.

use std::sync::Arc;

use trimloop_brep::{
    Body, BodyKind, EntityRef, Face, FaceGeometry, Model, Node, Part, Shell, ShellFace, Source,
};
use trimloop_geom::{Surface, TSpline};

use crate::ImportError;

/// One part with one face: the whole surface, exactly, as NURBS.
pub(crate) fn import(spline: &TSpline) -> Result<Model, ImportError> {
    let nurbs = spline.to_nurbs().map_err(|error| ImportError::Nothing(error.to_string()))?;
    let name = "T-spline".to_owned();
    let face = Face {
        entity: EntityRef::None,
        name: String::new(),
        geometry: FaceGeometry::Surface(Arc::new(Surface::Nurbs(nurbs))),
        same_sense: true,
        loops: Vec::new(),
        color: None,
        hidden: false,
    };
    let shell = Shell {
        entity: EntityRef::None,
        closed: false,
        void: false,
        faces: vec![ShellFace { face: 0, reversed: false }],
    };
    let body = Body {
        name: String::new(),
        entity: EntityRef::None,
        kind: BodyKind::Sheet,
        shells: vec![shell],
        layers: Vec::new(),
    };
    let part = Part { name: name.clone(), bodies: vec![body], faces: vec![face], ..Part::default() };
    let node = Node { name, part: Some(0), ..Node::default() };
    let source = Source {
        format: "tspline",
        schema: "T-spline 1".to_owned(),
        length_units: vec!["millimetre".to_owned()],
        ..Source::default()
    };
    Ok(Model { source, parts: vec![part], nodes: vec![node], roots: vec![0], ..Model::default() })
}
