"""Ellipses, parabolas and hyperbolas as edges and as profiles."""

from math import pi, sqrt

import cadquery as cq
from OCP.GC import GC_MakeSegment
from OCP.Geom import Geom_Hyperbola, Geom_Parabola, Geom_TrimmedCurve
from OCP.gp import gp_Ax2, gp_Dir, gp_Pnt

from catalogue import fixture


def half_space(origin, normal) -> cq.Workplane:
    """A large block on the side of a plane that its normal points to."""
    return cq.Workplane(cq.Plane(origin, normal=normal)).rect(200, 200).extrude(100)


def cone() -> cq.Workplane:
    return cq.Workplane(cq.Solid.makeCone(10, 0, 25))


@fixture(
    "cylinder_cut_askew",
    "a cylinder cut askew: a whole ellipse that begins at the seam, which is at neither of its axes",
    closed_form={"area_mm2": 400 * pi + 100 * pi + 100 * pi * sqrt(1 + 0.3**2 + 0.4**2), "volume_mm3": 2000 * pi},
    meshes=False,
)
def cylinder_cut_askew():
    return cq.Workplane().circle(10).extrude(40).cut(half_space((0, 0, 20), (0.3, 0.4, 1)))


@fixture("cone_cut_in_ellipse", "a cone cut askew: an elliptic edge")
def cone_cut_in_ellipse():
    return cone().cut(half_space((0, 0, 12), (0.3, 0, 1)))


@fixture("cone_cut_in_parabola", "a cone cut parallel to its side: a parabolic edge")
def cone_cut_in_parabola():
    return cone().cut(half_space((2, 0, 0), (25, 0, 10)))


@fixture("cone_cut_in_hyperbola", "a cone cut parallel to its axis: a hyperbolic edge")
def cone_cut_in_hyperbola():
    return cone().cut(half_space((4, 0, 0), (1, 0, 0)))


@fixture(
    "cone_cut_through_apex",
    "half a cone: the cut runs through the apex",
    closed_form={"volume_mm3": 2500 * pi / 6, "area_mm2": 50 * pi + 5 * pi * sqrt(725) + 250},
)
def cone_cut_through_apex():
    return cone().cut(half_space((0, 0, 0), (0, 1, 0)))


@fixture("elliptic_cylinder", "an extruded ellipse", closed_form={"volume_mm3": pi * 12 * 5 * 20})
def elliptic_cylinder():
    return cq.Workplane().ellipse(12, 5).extrude(20)


@fixture("elliptic_arc", "a prism over a segment of an ellipse")
def elliptic_arc():
    return cq.Workplane().moveTo(12, 0).ellipseArc(12, 5, 0, 230).close().extrude(8)


def profile(curve, first: float, last: float) -> cq.Workplane:
    """A prism over a conic arc and its chord."""
    start, end = curve.Value(first), curve.Value(last)
    arc = cq.Edge(cq.occ_impl.shapes.BRepBuilderAPI_MakeEdge(Geom_TrimmedCurve(curve, first, last)).Edge())
    chord = cq.Edge(cq.occ_impl.shapes.BRepBuilderAPI_MakeEdge(GC_MakeSegment(end, start).Value()).Edge())
    return cq.Solid.extrudeLinear(cq.Wire.assembleEdges([arc, chord]), [], cq.Vector(0, 0, 10))


AXES = gp_Ax2(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1), gp_Dir(1, 0, 0))


@fixture(
    "parabolic_cylinder",
    "a linear extrusion of a parabola",
    # The chord at u = 9, -9 cuts off a segment of area 2/3 * width * height; x = u^2 / (4 f), f = 3.
    closed_form={"volume_mm3": 10 * 2 / 3 * 18 * 81 / 12},
)
def parabolic_cylinder():
    return profile(Geom_Parabola(AXES, 3.0), -9.0, 9.0)


@fixture("hyperbolic_cylinder", "a linear extrusion of a hyperbola")
def hyperbolic_cylinder():
    return profile(Geom_Hyperbola(AXES, 4.0, 3.0), -1.2, 1.5)


def revolve(curve, first: float, last: float, degrees: float):
    """What a conic arc about the x-axis sweeps out when it turns about it, closed by a disc."""
    start, end = curve.Value(first), curve.Value(last)
    foot = gp_Pnt(end.X(), 0, 0)
    make = cq.occ_impl.shapes.BRepBuilderAPI_MakeEdge
    arc = cq.Edge(make(Geom_TrimmedCurve(curve, first, last)).Edge())
    rim = cq.Edge(make(GC_MakeSegment(end, foot).Value()).Edge())
    axis = cq.Edge(make(GC_MakeSegment(foot, start).Value()).Edge())
    wire = cq.Wire.assembleEdges([arc, rim, axis])
    return cq.Solid.revolve(wire, [], degrees, cq.Vector(0, 0, 0), cq.Vector(1, 0, 0))


@fixture(
    "paraboloid",
    "a revolved parabola: a surface of revolution with a pole on its axis",
    # y = u, x = u^2 / 12, up to u = 9: pi/2 * r^2 * h.
    closed_form={
        "volume_mm3": pi / 2 * 81 * 81 / 12,
        "area_mm2": pi * 81 + 8 * pi * 9 / 3 * ((1 + 81 / 36) ** 1.5 - 1),
    },
)
def paraboloid():
    return revolve(Geom_Parabola(AXES, 3.0), 0.0, 9.0, 360)


@fixture("hyperboloid_of_two_sheets", "a revolved hyperbola that meets the axis", reads_back=False)
def hyperboloid_of_two_sheets():
    return revolve(Geom_Hyperbola(AXES, 4.0, 3.0), 0.0, 1.5, 360)


@fixture("hyperboloid_of_one_sheet", "a revolved hyperbola that keeps off the axis: a cooling tower", reads_back=False)
def hyperboloid_of_one_sheet():
    axes = gp_Ax2(gp_Pnt(0, 0, 0), gp_Dir(0, -1, 0), gp_Dir(1, 0, 0))
    curve = Geom_Hyperbola(axes, 5.0, 8.0)
    make = cq.occ_impl.shapes.BRepBuilderAPI_MakeEdge
    first, last = -1.3, 0.8
    low, high = curve.Value(first), curve.Value(last)
    corners = [high, gp_Pnt(0, 0, high.Z()), gp_Pnt(0, 0, low.Z()), low]
    edges = [cq.Edge(make(Geom_TrimmedCurve(curve, first, last)).Edge())]
    edges += [cq.Edge(make(GC_MakeSegment(a, b).Value()).Edge()) for a, b in zip(corners, corners[1:])]
    return cq.Solid.revolve(cq.Wire.assembleEdges(edges), [], 360, cq.Vector(0, 0, 0), cq.Vector(0, 0, 1))


# The Viviani body's curve is no conic; it belongs here as the classic curve that passes through a sphere's pole.
@fixture(
    "viviani",
    "a sphere cut by the cylinder that touches its axis: a figure of eight",
    closed_form={"volume_mm3": 1000 * (2 * pi / 3 - 8 / 9)},
)
def viviani():
    pillar = cq.Solid.makeCylinder(5, 40, cq.Vector(5, 0, -20), cq.Vector(0, 0, 1))
    return cq.Workplane().sphere(10).intersect(cq.Workplane(pillar))
