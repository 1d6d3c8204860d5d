//! The entity types that the import understands.

macro_rules! kinds {
    ($($variant:ident = $keyword:literal,)*) => {
        /// What a record is, by its keyword; the variants are named after the keywords.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        #[repr(u8)]
        pub(crate) enum Kind {
            /// A keyword without a meaning for shape, structure or looks.
            Other,
            $(#[doc = $keyword] $variant,)*
        }

        /// Every known keyword with its kind.
        pub(crate) const KEYWORDS: &[(&str, Kind)] = &[$(($keyword, Kind::$variant),)*];

        impl Kind {
            /// The keyword of this kind; empty for `Other`.
            pub fn keyword(self) -> &'static str {
                match self {
                    Self::Other => "",
                    $(Self::$variant => $keyword,)*
                }
            }
        }
    };
}

// A complex instance takes the kind of that of its parts which stands first in this list, so subtypes stand
// before their supertypes.
kinds! {
    // Points, directions, placements.
    CartesianPoint = "CARTESIAN_POINT",
    Direction = "DIRECTION",
    Vector = "VECTOR",
    Axis1Placement = "AXIS1_PLACEMENT",
    Axis2Placement2d = "AXIS2_PLACEMENT_2D",
    Axis2Placement3d = "AXIS2_PLACEMENT_3D",
    CartesianTransformationOperator3d = "CARTESIAN_TRANSFORMATION_OPERATOR_3D",
    CartesianTransformationOperator2d = "CARTESIAN_TRANSFORMATION_OPERATOR_2D",
    CartesianTransformationOperator = "CARTESIAN_TRANSFORMATION_OPERATOR",
    ItemDefinedTransformation = "ITEM_DEFINED_TRANSFORMATION",
    // Curves.
    Line = "LINE",
    Circle = "CIRCLE",
    Ellipse = "ELLIPSE",
    Parabola = "PARABOLA",
    Hyperbola = "HYPERBOLA",
    Polyline = "POLYLINE",
    TrimmedCurve = "TRIMMED_CURVE",
    OuterBoundaryCurve = "OUTER_BOUNDARY_CURVE",
    BoundaryCurve = "BOUNDARY_CURVE",
    CompositeCurveOnSurface = "COMPOSITE_CURVE_ON_SURFACE",
    CompositeCurve = "COMPOSITE_CURVE",
    ReparametrisedCompositeCurveSegment = "REPARAMETRISED_COMPOSITE_CURVE_SEGMENT",
    CompositeCurveSegment = "COMPOSITE_CURVE_SEGMENT",
    BoundedPcurve = "BOUNDED_PCURVE",
    Pcurve = "PCURVE",
    SeamCurve = "SEAM_CURVE",
    IntersectionCurve = "INTERSECTION_CURVE",
    BoundedSurfaceCurve = "BOUNDED_SURFACE_CURVE",
    SurfaceCurve = "SURFACE_CURVE",
    OffsetCurve3d = "OFFSET_CURVE_3D",
    CurveReplica = "CURVE_REPLICA",
    BSplineCurveWithKnots = "B_SPLINE_CURVE_WITH_KNOTS",
    UniformCurve = "UNIFORM_CURVE",
    QuasiUniformCurve = "QUASI_UNIFORM_CURVE",
    BezierCurve = "BEZIER_CURVE",
    RationalBSplineCurve = "RATIONAL_B_SPLINE_CURVE",
    BSplineCurve = "B_SPLINE_CURVE",
    DefinitionalRepresentation = "DEFINITIONAL_REPRESENTATION",
    // Surfaces.
    Plane = "PLANE",
    CylindricalSurface = "CYLINDRICAL_SURFACE",
    ConicalSurface = "CONICAL_SURFACE",
    SphericalSurface = "SPHERICAL_SURFACE",
    DegenerateToroidalSurface = "DEGENERATE_TOROIDAL_SURFACE",
    ToroidalSurface = "TOROIDAL_SURFACE",
    SurfaceOfLinearExtrusion = "SURFACE_OF_LINEAR_EXTRUSION",
    SurfaceOfRevolution = "SURFACE_OF_REVOLUTION",
    OffsetSurface = "OFFSET_SURFACE",
    RectangularTrimmedSurface = "RECTANGULAR_TRIMMED_SURFACE",
    CurveBoundedSurface = "CURVE_BOUNDED_SURFACE",
    RectangularCompositeSurface = "RECTANGULAR_COMPOSITE_SURFACE",
    SurfacePatch = "SURFACE_PATCH",
    SurfaceReplica = "SURFACE_REPLICA",
    OrientedSurface = "ORIENTED_SURFACE",
    BSplineSurfaceWithKnots = "B_SPLINE_SURFACE_WITH_KNOTS",
    UniformSurface = "UNIFORM_SURFACE",
    QuasiUniformSurface = "QUASI_UNIFORM_SURFACE",
    BezierSurface = "BEZIER_SURFACE",
    RationalBSplineSurface = "RATIONAL_B_SPLINE_SURFACE",
    BSplineSurface = "B_SPLINE_SURFACE",
    // Topology.
    VertexPoint = "VERTEX_POINT",
    OrientedEdge = "ORIENTED_EDGE",
    EdgeCurve = "EDGE_CURVE",
    Subedge = "SUBEDGE",
    Edge = "EDGE",
    EdgeLoop = "EDGE_LOOP",
    PolyLoop = "POLY_LOOP",
    VertexLoop = "VERTEX_LOOP",
    FaceOuterBound = "FACE_OUTER_BOUND",
    FaceBound = "FACE_BOUND",
    OrientedFace = "ORIENTED_FACE",
    AdvancedFace = "ADVANCED_FACE",
    FaceSurface = "FACE_SURFACE",
    Subface = "SUBFACE",
    Face = "FACE",
    OrientedClosedShell = "ORIENTED_CLOSED_SHELL",
    OrientedOpenShell = "ORIENTED_OPEN_SHELL",
    ClosedShell = "CLOSED_SHELL",
    OpenShell = "OPEN_SHELL",
    SurfacedOpenShell = "SURFACED_OPEN_SHELL",
    ConnectedFaceSubSet = "CONNECTED_FACE_SUB_SET",
    ConnectedFaceSet = "CONNECTED_FACE_SET",
    ConnectedEdgeSet = "CONNECTED_EDGE_SET",
    WireShell = "WIRE_SHELL",
    // Solids and models.
    BrepWithVoids = "BREP_WITH_VOIDS",
    FacetedBrep = "FACETED_BREP",
    ManifoldSolidBrep = "MANIFOLD_SOLID_BREP",
    ShellBasedSurfaceModel = "SHELL_BASED_SURFACE_MODEL",
    FaceBasedSurfaceModel = "FACE_BASED_SURFACE_MODEL",
    ShellBasedWireframeModel = "SHELL_BASED_WIREFRAME_MODEL",
    EdgeBasedWireframeModel = "EDGE_BASED_WIREFRAME_MODEL",
    GeometricCurveSet = "GEOMETRIC_CURVE_SET",
    GeometricSet = "GEOMETRIC_SET",
    // Tessellated geometry.
    RepositionedTessellatedItem = "REPOSITIONED_TESSELLATED_ITEM",
    TessellatedSolid = "TESSELLATED_SOLID",
    TessellatedShell = "TESSELLATED_SHELL",
    TessellatedGeometricSet = "TESSELLATED_GEOMETRIC_SET",
    ComplexTriangulatedFace = "COMPLEX_TRIANGULATED_FACE",
    TriangulatedFace = "TRIANGULATED_FACE",
    ComplexTriangulatedSurfaceSet = "COMPLEX_TRIANGULATED_SURFACE_SET",
    TriangulatedSurfaceSet = "TRIANGULATED_SURFACE_SET",
    TriangulatedPointSet = "TRIANGULATED_POINT_SET",
    TessellatedCurveSet = "TESSELLATED_CURVE_SET",
    TessellatedEdge = "TESSELLATED_EDGE",
    TessellatedConnectingEdge = "TESSELLATED_CONNECTING_EDGE",
    TessellatedWire = "TESSELLATED_WIRE",
    TessellatedPointSet = "TESSELLATED_POINT_SET",
    CoordinatesList = "COORDINATES_LIST",
    // Representations.
    MappedItem = "MAPPED_ITEM",
    RepresentationMap = "REPRESENTATION_MAP",
    DraughtingModel = "DRAUGHTING_MODEL",
    MechanicalDesignGeometricPresentationRepresentation =
        "MECHANICAL_DESIGN_GEOMETRIC_PRESENTATION_REPRESENTATION",
    PresentationArea = "PRESENTATION_AREA",
    PresentationView = "PRESENTATION_VIEW",
    ConstructiveGeometryRepresentation = "CONSTRUCTIVE_GEOMETRY_REPRESENTATION",
    TessellatedShapeRepresentationWithAccuracyParameters =
        "TESSELLATED_SHAPE_REPRESENTATION_WITH_ACCURACY_PARAMETERS",
    TessellatedShapeRepresentation = "TESSELLATED_SHAPE_REPRESENTATION",
    AdvancedBrepShapeRepresentation = "ADVANCED_BREP_SHAPE_REPRESENTATION",
    FacetedBrepShapeRepresentation = "FACETED_BREP_SHAPE_REPRESENTATION",
    ElementaryBrepShapeRepresentation = "ELEMENTARY_BREP_SHAPE_REPRESENTATION",
    ManifoldSurfaceShapeRepresentation = "MANIFOLD_SURFACE_SHAPE_REPRESENTATION",
    NonManifoldSurfaceShapeRepresentation = "NON_MANIFOLD_SURFACE_SHAPE_REPRESENTATION",
    GeometricallyBoundedSurfaceShapeRepresentation = "GEOMETRICALLY_BOUNDED_SURFACE_SHAPE_REPRESENTATION",
    GeometricallyBoundedWireframeShapeRepresentation = "GEOMETRICALLY_BOUNDED_WIREFRAME_SHAPE_REPRESENTATION",
    EdgeBasedWireframeShapeRepresentation = "EDGE_BASED_WIREFRAME_SHAPE_REPRESENTATION",
    ShellBasedWireframeShapeRepresentation = "SHELL_BASED_WIREFRAME_SHAPE_REPRESENTATION",
    CsgShapeRepresentation = "CSG_SHAPE_REPRESENTATION",
    ShapeRepresentationWithParameters = "SHAPE_REPRESENTATION_WITH_PARAMETERS",
    ShapeRepresentation = "SHAPE_REPRESENTATION",
    Representation = "REPRESENTATION",
    RepresentationRelationshipWithTransformation = "REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION",
    ShapeRepresentationRelationship = "SHAPE_REPRESENTATION_RELATIONSHIP",
    ConstructiveGeometryRepresentationRelationship = "CONSTRUCTIVE_GEOMETRY_REPRESENTATION_RELATIONSHIP",
    RepresentationRelationship = "REPRESENTATION_RELATIONSHIP",
    // Products.
    Product = "PRODUCT",
    ProductDefinitionFormationWithSpecifiedSource = "PRODUCT_DEFINITION_FORMATION_WITH_SPECIFIED_SOURCE",
    ProductDefinitionFormation = "PRODUCT_DEFINITION_FORMATION",
    ProductDefinitionWithAssociatedDocuments = "PRODUCT_DEFINITION_WITH_ASSOCIATED_DOCUMENTS",
    ProductDefinition = "PRODUCT_DEFINITION",
    ProductDefinitionShape = "PRODUCT_DEFINITION_SHAPE",
    PropertyDefinition = "PROPERTY_DEFINITION",
    ShapeDefinitionRepresentation = "SHAPE_DEFINITION_REPRESENTATION",
    PropertyDefinitionRepresentation = "PROPERTY_DEFINITION_REPRESENTATION",
    NextAssemblyUsageOccurrence = "NEXT_ASSEMBLY_USAGE_OCCURRENCE",
    AssemblyComponentUsage = "ASSEMBLY_COMPONENT_USAGE",
    ContextDependentShapeRepresentation = "CONTEXT_DEPENDENT_SHAPE_REPRESENTATION",
    // Units.
    GlobalUnitAssignedContext = "GLOBAL_UNIT_ASSIGNED_CONTEXT",
    ConversionBasedUnit = "CONVERSION_BASED_UNIT",
    SiUnit = "SI_UNIT",
    ContextDependentUnit = "CONTEXT_DEPENDENT_UNIT",
    LengthUnit = "LENGTH_UNIT",
    PlaneAngleUnit = "PLANE_ANGLE_UNIT",
    SolidAngleUnit = "SOLID_ANGLE_UNIT",
    UncertaintyMeasureWithUnit = "UNCERTAINTY_MEASURE_WITH_UNIT",
    LengthMeasureWithUnit = "LENGTH_MEASURE_WITH_UNIT",
    PlaneAngleMeasureWithUnit = "PLANE_ANGLE_MEASURE_WITH_UNIT",
    MeasureWithUnit = "MEASURE_WITH_UNIT",
    // Looks.
    TessellatedAnnotationOccurrence = "TESSELLATED_ANNOTATION_OCCURRENCE",
    AnnotationOccurrence = "ANNOTATION_OCCURRENCE",
    AnnotationCurveOccurrence = "ANNOTATION_CURVE_OCCURRENCE",
    AnnotationPlane = "ANNOTATION_PLANE",
    ContextDependentOverRidingStyledItem = "CONTEXT_DEPENDENT_OVER_RIDING_STYLED_ITEM",
    OverRidingStyledItem = "OVER_RIDING_STYLED_ITEM",
    StyledItem = "STYLED_ITEM",
    PresentationStyleByContext = "PRESENTATION_STYLE_BY_CONTEXT",
    PresentationStyleAssignment = "PRESENTATION_STYLE_ASSIGNMENT",
    SurfaceStyleUsage = "SURFACE_STYLE_USAGE",
    SurfaceSideStyle = "SURFACE_SIDE_STYLE",
    SurfaceStyleFillArea = "SURFACE_STYLE_FILL_AREA",
    SurfaceStyleRenderingWithProperties = "SURFACE_STYLE_RENDERING_WITH_PROPERTIES",
    SurfaceStyleRendering = "SURFACE_STYLE_RENDERING",
    SurfaceStyleTransparent = "SURFACE_STYLE_TRANSPARENT",
    FillAreaStyle = "FILL_AREA_STYLE",
    FillAreaStyleColour = "FILL_AREA_STYLE_COLOUR",
    CurveStyle = "CURVE_STYLE",
    ColourRgb = "COLOUR_RGB",
    DraughtingPreDefinedColour = "DRAUGHTING_PRE_DEFINED_COLOUR",
    PreDefinedColour = "PRE_DEFINED_COLOUR",
    PresentationLayerAssignment = "PRESENTATION_LAYER_ASSIGNMENT",
    Invisibility = "INVISIBILITY",
}

/// Where the attributes of a part of a complex instance stand in the order of the inherited attributes: parts
/// of a lower rank come first. The external mapping writes parts alphabetically, the simple form by inheritance.
pub(crate) fn inheritance_rank(keyword: &str) -> u8 {
    match keyword {
        "REPRESENTATION_ITEM"
        | "NAMED_UNIT"
        | "REPRESENTATION"
        | "REPRESENTATION_CONTEXT"
        | "REPRESENTATION_RELATIONSHIP"
        | "PROPERTY_DEFINITION"
        | "FUNCTIONALLY_DEFINED_TRANSFORMATION" => 0,
        "B_SPLINE_CURVE"
        | "B_SPLINE_SURFACE"
        | "CONIC"
        | "ELEMENTARY_SURFACE"
        | "SWEPT_SURFACE"
        | "MANIFOLD_SOLID_BREP"
        | "STYLED_ITEM"
        | "CONNECTED_FACE_SET"
        | "FACE"
        | "EDGE"
        | "PATH"
        | "LOOP"
        | "COMPOSITE_CURVE"
        | "SURFACE_CURVE"
        | "PCURVE"
        | "PLACEMENT"
        | "TESSELLATED_FACE"
        | "TESSELLATED_SURFACE_SET"
        | "TOROIDAL_SURFACE"
        | "CARTESIAN_TRANSFORMATION_OPERATOR"
        | "GEOMETRIC_SET"
        | "MEASURE_WITH_UNIT"
        | "FACE_BOUND"
        | "MAPPED_ITEM" => 1,
        "FACE_SURFACE" => 2,
        "REPOSITIONED_TESSELLATED_ITEM" => 4,
        _ => 3,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keywords_are_unique() {
        let distinct: std::collections::HashSet<_> = KEYWORDS.iter().map(|(keyword, _)| keyword).collect();
        assert_eq!(distinct.len(), KEYWORDS.len());
    }

    #[test]
    fn keyword_and_kind_name_each_other() {
        for &(keyword, kind) in KEYWORDS {
            assert_eq!(kind.keyword(), keyword);
        }
    }
}
