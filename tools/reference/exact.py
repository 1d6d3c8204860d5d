"""Exact figures of a shape: integrals over its surfaces, never over triangles."""

from __future__ import annotations

from OCP.Bnd import Bnd_Box
from OCP.BRep import BRep_Tool
from OCP.BRepAdaptor import BRepAdaptor_Surface
from OCP.BRepBndLib import BRepBndLib
from OCP.BRepCheck import BRepCheck_Analyzer
from OCP.BRepGProp import BRepGProp
from OCP.GProp import GProp_GProps
from OCP.TopAbs import (
    TopAbs_EDGE,
    TopAbs_FACE,
    TopAbs_SHELL,
    TopAbs_SOLID,
    TopAbs_VERTEX,
)
from OCP.TopExp import TopExp_Explorer
from OCP.TopoDS import TopoDS, TopoDS_Shape

#: Two ways of integrating a face must agree this well (relative) before either is believed.
AGREEMENT = 1e-4

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
    return SURFACE_NAMES[BRepAdaptor_Surface(TopoDS.Face_s(face)).GetType().name]


def face_area(face: TopoDS_Shape) -> tuple[float, list[float], float]:
    """Area, centroid, and the relative difference between two ways of integrating."""
    face = TopoDS.Face_s(face)
    fixed, adaptive = GProp_GProps(), GProp_GProps()
    BRepGProp.SurfaceProperties_s(face, fixed, False, False)
    BRepGProp.SurfaceProperties_s(face, adaptive, 1e-10, False)
    area = adaptive.Mass()
    doubt = abs(area - fixed.Mass()) / max(abs(area), 1e-300)
    centre = adaptive.CentreOfMass()
    return area, [centre.X(), centre.Y(), centre.Z()], doubt


def volume(shape: TopoDS_Shape) -> float | None:
    """Volume of the solids, voids taken off; None where there is no solid."""
    solids = subshapes(shape, TopAbs_SOLID)
    if not solids:
        return None
    total = 0.0
    for solid in solids:
        properties = GProp_GProps()
        BRepGProp.VolumeProperties_s(solid, properties, 1e-10, False, False)
        total += properties.Mass()
    return total


def bounding_box(shape: TopoDS_Shape) -> list[list[float]] | None:
    """Box around the exact surfaces and curves; None for an empty shape. Take it before any tessellation."""
    box = Bnd_Box()
    BRepBndLib.AddOptimal_s(shape, box, False, False)
    if box.IsVoid():
        return None
    box.SetGap(0.0)
    x0, y0, z0, x1, y1, z1 = box.Get()
    return [[x0, y0, z0], [x1, y1, z1]]


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
