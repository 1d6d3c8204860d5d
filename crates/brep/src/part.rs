//! One part: its bodies, and the arenas that their topology indexes.

use std::sync::Arc;

use glam::DVec3;
use trimloop_geom::{Curve, Interval, Surface};

use crate::{EntityRef, Rgba};

/// Index into [`Part::vertices`].
pub type VertexId = u32;
/// Index into [`Part::edges`].
pub type EdgeId = u32;
/// Index into [`Part::faces`].
pub type FaceId = u32;

/// The geometry of one product, in its own coordinates.
#[derive(Clone, Debug, Default)]
pub struct Part {
    /// The product's name as people see it, else its id.
    pub name: String,
    /// The product's id.
    pub id: String,
    /// The product definition, or the representation where there is no product.
    pub entity: EntityRef,
    /// Solids and sheets.
    pub bodies: Vec<Body>,
    /// All faces of all bodies.
    pub faces: Vec<Face>,
    /// All edges, each once, shared by the faces that meet there.
    pub edges: Vec<Edge>,
    /// All vertices, each once.
    pub vertices: Vec<Vertex>,
    /// Curves that bound no face.
    pub curves: Vec<FreeCurve>,
    /// Points that are no vertices.
    pub points: Vec<FreePoint>,
    /// Coordinates of tessellated faces ([`Facets::triangles`] index into it).
    pub facet_points: Vec<DVec3>,
    /// The accuracy that the file states for this part's geometry, millimetres (0 when it states none).
    pub uncertainty_mm: f64,
    /// Colour of everything that has none of its own.
    pub color: Option<Rgba>,
}

/// What a body claims to be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BodyKind {
    /// Its shells are closed; the first is the outer one, further ones are voids.
    Solid,
    /// Surfaces without an inside.
    Sheet,
}

/// A solid or a set of surfaces.
#[derive(Clone, Debug)]
pub struct Body {
    /// The body's own name, often empty.
    pub name: String,
    /// The entity it comes from.
    pub entity: EntityRef,
    /// What it claims to be.
    pub kind: BodyKind,
    /// At least one.
    pub shells: Vec<Shell>,
    /// Layer names it is assigned to.
    pub layers: Vec<String>,
}

/// Faces that belong together.
#[derive(Clone, Debug)]
pub struct Shell {
    /// The entity it comes from.
    pub entity: EntityRef,
    /// Whether the file declares it closed.
    pub closed: bool,
    /// Whether it bounds a void (a solid's further shells).
    pub void: bool,
    /// The faces, and for each whether the shell uses it backwards.
    pub faces: Vec<ShellFace>,
}

/// A shell's use of a face.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ShellFace {
    /// Which face.
    pub face: FaceId,
    /// Whether the shell's outward side is the face's back.
    pub reversed: bool,
}

/// A bounded piece of a surface.
#[derive(Clone, Debug)]
pub struct Face {
    /// The entity it comes from.
    pub entity: EntityRef,
    /// The face's own name, often empty.
    pub name: String,
    /// What it is a piece of.
    pub geometry: FaceGeometry,
    /// Whether the face's normal is the surface's (`same_sense`). Loops run counter-clockwise about the *face's*
    /// normal.
    pub same_sense: bool,
    /// The boundary; empty when the face is the whole of a closed surface or of the surface's domain.
    pub loops: Vec<Loop>,
    /// The colour that applies to this face, inherited ones resolved.
    pub color: Option<Rgba>,
    /// Whether the file hides it.
    pub hidden: bool,
}

/// What a face is a piece of.
#[derive(Clone, Debug)]
pub enum FaceGeometry {
    /// An exact surface.
    Surface(Arc<Surface>),
    /// Triangles as the file gives them.
    Facets(Facets),
    /// The entity could not be understood: the face is lost, for this reason.
    Unreadable(String),
}

/// Triangles as the file gives them (AP242 tessellated faces).
#[derive(Clone, Debug, Default)]
pub struct Facets {
    /// Indices into [`Part::facet_points`], counter-clockwise about the face's normal.
    pub triangles: Vec<[u32; 3]>,
    /// Unit normals: one per triangle corner in the order of `triangles`, or none.
    pub normals: Vec<[DVec3; 3]>,
}

/// One closed run of coedges, or a single vertex.
#[derive(Clone, Debug, Default)]
pub struct Loop {
    /// The entity it comes from.
    pub entity: EntityRef,
    /// The edges in order; the face's inside lies to the left, seen from its normal's tip.
    pub coedges: Vec<Coedge>,
    /// The vertex of a vertex loop.
    pub vertex: Option<VertexId>,
    /// Whether the file calls it the outer bound.
    pub outer: bool,
}

/// A loop's use of an edge.
#[derive(Clone, Debug)]
pub struct Coedge {
    /// Which edge.
    pub edge: EdgeId,
    /// Whether the loop runs from the edge's end to its start.
    pub reversed: bool,
    /// The file's own curve in the surface's parameters (x = u, y = v, in the units of `Surface`), running with the
    /// edge's curve; a hint, not the truth.
    pub pcurve: Option<Arc<Curve>>,
}

/// A bounded piece of a curve.
#[derive(Clone, Debug)]
pub struct Edge {
    /// The entity it comes from.
    pub entity: EntityRef,
    /// Where the edge starts.
    pub start: VertexId,
    /// Where it ends; equal to `start` when it closes on itself.
    pub end: VertexId,
    /// Its curve.
    pub curve: Arc<Curve>,
    /// The part of the curve between the vertices, `start < end`; on a closed curve it may extend past the domain.
    pub range: Interval,
    /// Whether the edge runs from `range.start` to `range.end` (else the other way).
    pub same_sense: bool,
}

/// A point where edges meet.
#[derive(Clone, Copy, Debug)]
pub struct Vertex {
    /// The entity it comes from.
    pub entity: EntityRef,
    /// Where it is.
    pub point: DVec3,
}

/// A curve that bounds no face.
#[derive(Clone, Debug)]
pub struct FreeCurve {
    /// The entity it comes from.
    pub entity: EntityRef,
    /// The curve.
    pub curve: Arc<Curve>,
    /// The part that is used; finite.
    pub range: Interval,
    /// Its colour.
    pub color: Option<Rgba>,
}

/// A point that is no vertex.
#[derive(Clone, Copy, Debug)]
pub struct FreePoint {
    /// The entity it comes from.
    pub entity: EntityRef,
    /// Where it is.
    pub point: DVec3,
    /// Its colour.
    pub color: Option<Rgba>,
}
