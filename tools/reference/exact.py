"""Exact figures of a shape: integrals over its surfaces, never over triangles."""

from __future__ import annotations

import math

from OCP.Bnd import Bnd_Box
from OCP.BRep import BRep_Tool
from OCP.BRepAdaptor import BRepAdaptor_Surface
from OCP.BRepBndLib import BRepBndLib
from OCP.BRepBuilderAPI import BRepBuilderAPI_Copy
from OCP.BRepCheck import BRepCheck_Analyzer
from OCP.BRepGProp import BRepGProp
from OCP.BRepMesh import BRepMesh_IncrementalMesh
from OCP.GProp import GProp_GProps
from OCP.TopAbs import (
    TopAbs_EDGE,
    TopAbs_FACE,
    TopAbs_SHELL,
    TopAbs_SOLID,
    TopAbs_VERTEX,
)
from OCP.TopExp import TopExp_Explorer
from OCP.TopLoc import TopLoc_Location
from OCP.TopoDS import TopoDS, TopoDS_Shape

from integral import integrate

#: Surfaces whose boxes OpenCASCADE gets right.
ELEMENTARY = ("plane", "cylinder", "cone", "sphere", "torus", "facets")
#: A box that is larger than a fine mesh's by more than this part of its size is not believed.
BOX_DOUBT = 1e-3

#: What kinds of surface are called in the references.
SURFACE_NAMES = {
    "GeomAbs_Plane": "plane",
    "GeomAbs_Cylinder": "cylinder",
    "GeomAbs_Cone": "cone",
    "GeomAbs_Sphere": "sphere",
    "GeomAbs_Torus": "torus",
    "GeomAbs_BezierSurface": "bezier",
    "GeomAbs_BSplineSurface": "bspline",
    "GeomAbs_SurfaceOfRevolution": "revolution",
    "GeomAbs_SurfaceOfExtrusion": "extrusion",
    "GeomAbs_OffsetSurface": "offset",
    "GeomAbs_OtherSurface": "other",
}


def subshapes(shape: TopoDS_Shape, kind, avoid=None) -> list[TopoDS_Shape]:
    """Every use of a sub-shape of this kind, shared ones as often as they are used."""
    explorer = TopExp_Explorer(shape, kind, avoid) if avoid is not None else TopExp_Explorer(shape, kind)
    found = []
    while explorer.More():
        found.append(explorer.Current())
        explorer.Next()
    return found


def faces(shape: TopoDS_Shape) -> list[TopoDS_Shape]:
    """Every use of a face."""
    return subshapes(shape, TopAbs_FACE)


def free_edges(shape: TopoDS_Shape) -> list[TopoDS_Shape]:
    """The edges that bound no face."""
    return subshapes(shape, TopAbs_EDGE, TopAbs_FACE)


def surface_kind(face: TopoDS_Shape) -> str:
    """The kind of a face's surface."""
    if BRep_Tool.Surface_s(TopoDS.Face_s(face)) is None:
        return "facets"
    return SURFACE_NAMES[BRepAdaptor_Surface(TopoDS.Face_s(face)).GetType().name]


def volume(shape: TopoDS_Shape) -> float | None:
    """Volume of the solids, voids taken off; None where there is no solid."""
    solids = subshapes(shape, TopAbs_SOLID)
    if not solids:
        return None
    return sum(integrate(face).flux_mm3 for solid in solids for face in faces(solid))


def bounding_box(shape: TopoDS_Shape) -> list[list[float]] | None:
    """Box around the faces, or around the curves where there is no face; None for an empty shape.

    Take it before any tessellation.
    """
    corners = [c for part in faces(shape) or [shape] if (c := part_box(part)) is not None]
    if not corners:
        return None
    return [[min(c[0][k] for c in corners) for k in range(3)], [max(c[1][k] for c in corners) for k in range(3)]]


def part_box(part: TopoDS_Shape) -> list[list[float]] | None:
    """Box of a face or of curves."""
    box = Bnd_Box()
    BRepBndLib.AddOptimal_s(part, box, False, False)
    if box.IsVoid():
        return None
    if part.ShapeType() == TopAbs_FACE and surface_kind(part) not in ELEMENTARY:
        meshed = meshed_box(part, math.sqrt(box.SquareExtent()))
        # On some trimmed splines the box above is that of the control points.
        if math.sqrt(meshed.SquareExtent()) < (1 - BOX_DOUBT) * math.sqrt(box.SquareExtent()):
            box = meshed
    box.SetGap(0.0)
    x0, y0, z0, x1, y1, z1 = box.Get()
    return [[x0, y0, z0], [x1, y1, z1]]


def meshed_box(face: TopoDS_Shape, size: float) -> Bnd_Box:
    """Box of a fine tessellation of a copy of the face."""
    copy = BRepBuilderAPI_Copy(face, True, False).Shape()
    BRepMesh_IncrementalMesh(copy, 1e-5 * size, False, 0.1, False)
    location = TopLoc_Location()
    mesh = BRep_Tool.Triangulation_s(TopoDS.Face_s(copy), location)
    box = Bnd_Box()
    for k in range(1, mesh.NbNodes() + 1):
        box.Add(mesh.Node(k).Transformed(location.Transformation()))
    return box


def is_closed(shape: TopoDS_Shape) -> bool:
    """Whether the shape is valid closed solids and nothing else (no sheet, no free curve or point)."""
    return (
        bool(subshapes(shape, TopAbs_SOLID))
        and not subshapes(shape, TopAbs_FACE, TopAbs_SOLID)
        and not free_edges(shape)
        and not subshapes(shape, TopAbs_VERTEX, TopAbs_EDGE)
        and all(BRep_Tool.IsClosed_s(shell) for shell in subshapes(shape, TopAbs_SHELL))
        and BRepCheck_Analyzer(shape).IsValid()
    )


def curve_length(edge: TopoDS_Shape) -> float:
    """Length of an edge."""
    properties = GProp_GProps()
    BRepGProp.LinearProperties_s(edge, properties, False, False)
    return properties.Mass()
