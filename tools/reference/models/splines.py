"""B-spline and Bézier curves and surfaces of degree 1 to 9, rational and not, and what is swept from them."""

from math import cos, pi, sin, sqrt

import cadquery as cq
from OCP.BRepBuilderAPI import (
    BRepBuilderAPI_GTransform,
    BRepBuilderAPI_MakeFace,
    BRepBuilderAPI_MakeSolid,
    BRepBuilderAPI_Sewing,
)
from OCP.BRepOffsetAPI import BRepOffsetAPI_MakeFilling
from OCP.Geom import Geom_BezierSurface, Geom_BSplineSurface, Geom_OffsetSurface, Geom_RectangularTrimmedSurface
from OCP.GeomAbs import GeomAbs_C0
from OCP.gp import gp_GTrsf, gp_Mat, gp_Pnt, gp_XYZ
from OCP.TColgp import TColgp_Array2OfPnt
from OCP.TColStd import TColStd_Array1OfInteger, TColStd_Array1OfReal, TColStd_Array2OfReal
from OCP.TopoDS import TopoDS

from catalogue import fixture


def grid(points) -> TColgp_Array2OfPnt:
    """Control points, rows along u, columns along v."""
    array = TColgp_Array2OfPnt(1, len(points), 1, len(points[0]))
    for i, row in enumerate(points, 1):
        for j, point in enumerate(row, 1):
            array.SetValue(i, j, gp_Pnt(*map(float, point)))
    return array


def reals(values) -> TColStd_Array1OfReal:
    array = TColStd_Array1OfReal(1, len(values))
    for i, value in enumerate(values, 1):
        array.SetValue(i, float(value))
    return array


def integers(values) -> TColStd_Array1OfInteger:
    array = TColStd_Array1OfInteger(1, len(values))
    for i, value in enumerate(values, 1):
        array.SetValue(i, value)
    return array


def weights(values) -> TColStd_Array2OfReal:
    array = TColStd_Array2OfReal(1, len(values), 1, len(values[0]))
    for i, row in enumerate(values, 1):
        for j, weight in enumerate(row, 1):
            array.SetValue(i, j, float(weight))
    return array


def hills(rows: int, columns: int, size: float = 30.0, height: float = 5.0):
    """Control points over a square, waving in both directions."""
    return [
        [
            (
                size * i / (rows - 1),
                size * j / (columns - 1),
                height * sin(2.1 * i / (rows - 1) * 3 + 0.3) * cos(1.7 * j / (columns - 1) * 3),
            )
            for j in range(columns)
        ]
        for i in range(rows)
    ]


def sheet(surface, tolerance: float = 1e-7) -> cq.Shape:
    """The face over a surface's whole domain."""
    return cq.Shape.cast(BRepBuilderAPI_MakeFace(surface, tolerance).Face())


def clamped(poles: int, degree: int) -> tuple[list[float], list[int]]:
    """Uniform knots, with full multiplicity at both ends."""
    spans = poles - degree
    return [float(k) for k in range(spans + 1)], [degree + 1] + [1] * (spans - 1) + [degree + 1]


def spline_surface(points, u_degree: int, v_degree: int, u_knots=None, v_knots=None, weight=None):
    """A B-spline surface over clamped uniform knots, unless knots are given as (values, multiplicities)."""
    u_values, u_multiplicities = u_knots or clamped(len(points), u_degree)
    v_values, v_multiplicities = v_knots or clamped(len(points[0]), v_degree)
    knots = (
        reals(u_values),
        reals(v_values),
        integers(u_multiplicities),
        integers(v_multiplicities),
        u_degree,
        v_degree,
    )
    if weight is None:
        return Geom_BSplineSurface(grid(points), *knots)
    return Geom_BSplineSurface(grid(points), weights(weight), *knots)


for _degree in range(1, 10):

    @fixture(f"bspline_degree_{_degree}", f"a single B-spline face of degree {_degree} by {max(1, 10 - _degree)}")
    def bspline_of_degree(u_degree: int = _degree):
        v_degree = max(1, 10 - u_degree)
        return sheet(spline_surface(hills(u_degree + 4, v_degree + 3), u_degree, v_degree))


@fixture("bspline_rational", "a rational B-spline face with uneven weights")
def bspline_rational():
    weight = [[1 + 3 * ((i * 5 + j * 3) % 4) for j in range(6)] for i in range(7)]
    return sheet(spline_surface(hills(7, 6), 3, 2, weight=weight))


@fixture("bspline_uneven_knots", "a B-spline face with knots of very different spacing")
def bspline_uneven_knots():
    u = ([0.0, 0.001, 0.5, 0.9, 1.0], [4, 1, 1, 1, 4])
    v = ([-3.0, 0.0, 40.0], [4, 1, 4])
    return sheet(spline_surface(hills(7, 5), 3, 3, u, v))


@fixture("bspline_creased", "a B-spline face of degree 1 by 3: a crease at every knot", deflection=0.02, angular=3.0)
def bspline_creased():
    points = [[(10 * i, 10 * j, 6.0 * (i % 2)) for j in range(4)] for i in range(5)]
    return sheet(spline_surface(points, 1, 3))


@fixture("bspline_periodic", "a tube over a periodic B-spline: closed in u without a double row of poles")
def bspline_periodic():
    points = [
        [
            ((8 + 2 * cos(4 * pi * i / 8)) * cos(2 * pi * i / 8), (8 - sin(j)) * sin(2 * pi * i / 8), 5.0 * j)
            for j in range(6)
        ]
        for i in range(8)
    ]
    surface = Geom_BSplineSurface(
        grid(points),
        reals(range(9)),
        reals([0, 1, 2, 3]),
        integers([1] * 9),
        integers([4, 1, 1, 4]),
        3,
        3,
        True,
        False,
    )
    return sheet(surface)


@fixture("bspline_collapsed_side", "a B-spline face one side of which is a single point")
def bspline_collapsed_side():
    points = [[(3.0 * j * cos(i / 4), 3.0 * j * sin(i / 4), 0.25 * j * j) for j in range(5)] for i in range(6)]
    return sheet(spline_surface(points, 3, 3))


@fixture("bezier_patch", "a Bézier face of degree 3 by 5")
def bezier_patch():
    return sheet(Geom_BezierSurface(grid(hills(4, 6))))


@fixture("bezier_rational_octant", "an eighth of a sphere as a rational Bézier face", closed_form={"area_mm2": 50 * pi})
def bezier_rational_octant():
    r = 10.0
    points = [
        [(r, 0, 0), (r, 0, r), (0, 0, r)],
        [(r, r, 0), (r, r, r), (0, 0, r)],
        [(0, r, 0), (0, r, r), (0, 0, r)],
    ]
    h = sqrt(0.5)
    weight = [[1, h, 1], [h, 0.5, h], [1, h, 1]]
    return sheet(Geom_BezierSurface(grid(points), weights(weight)))


@fixture("bezier_degree_9", "a Bézier face of degree 9 by 9")
def bezier_degree_9():
    return sheet(Geom_BezierSurface(grid(hills(10, 10))))


def stretched(shape: cq.Shape, x: float, y: float, z: float) -> cq.Shape:
    """The shape scaled unevenly, which makes every surface a B-spline."""
    trsf = gp_GTrsf(gp_Mat(x, 0, 0, 0, y, 0, 0, 0, z), gp_XYZ(0, 0, 0))
    return cq.Shape.cast(BRepBuilderAPI_GTransform(shape.wrapped, trsf, True).Shape())


@fixture(
    "ellipsoid",
    "a sphere stretched to half axes 10, 20, 5: a rational B-spline with two collapsed sides and a seam",
    closed_form={"volume_mm3": 4 / 3 * pi * 1000},
)
def ellipsoid():
    return stretched(cq.Workplane().sphere(10).val(), 1, 2, 0.5)


@fixture(
    "torus_as_nurbs",
    "a stretched torus: a rational B-spline closed in both directions",
    closed_form={"volume_mm3": 2 * pi * pi * 20 * 25 * 1.5},
)
def torus_as_nurbs():
    return stretched(cq.Solid.makeTorus(20, 5), 1.5, 1, 1)


def wavy_profile() -> cq.Workplane:
    points = [(0, 0), (8, 5), (16, -2), (24, 6), (32, 0)]
    return cq.Workplane().spline(points, includeCurrent=False).lineTo(32, -12).lineTo(0, -12).close()


@fixture("spline_extruded", "a surface of linear extrusion over a spline")
def spline_extruded():
    return wavy_profile().extrude(15)


@fixture("spline_extruded_slanting", "a surface of linear extrusion not at right angles to its profile")
def spline_extruded_slanting():
    wire = wavy_profile().wires().val()
    return cq.Solid.extrudeLinear(wire, [], cq.Vector(4, 3, 15))


@fixture("spline_closed_extruded", "a closed spline extruded: one periodic face with a seam")
def spline_closed_extruded():
    points = [(10, 0), (4, 6), (-8, 7), (-6, -5), (3, -9)]
    return cq.Workplane().spline(points, periodic=True).close().extrude(12)


@fixture("spline_revolved", "a surface of revolution over a spline that keeps off the axis")
def spline_revolved():
    wire = (
        cq.Workplane("XZ")
        .moveTo(6, 0)
        .spline([(10, 8), (7, 16), (11, 24)], includeCurrent=True)
        .lineTo(0, 24)
        .lineTo(0, 0)
        .close()
    )
    return wire.revolve(360, (0, 0, 0), (0, 1, 0))


@fixture("spline_revolved_to_axis", "a surface of revolution over a spline that meets the axis at both ends")
def spline_revolved_to_axis():
    wire = cq.Workplane("XZ").moveTo(0, 0).spline([(7, 6), (4, 14), (0, 20)], includeCurrent=True).close()
    return wire.revolve(360, (0, 0, 0), (0, 1, 0))


@fixture("spline_revolved_partly", "a surface of revolution over a spline, 100 degrees")
def spline_revolved_partly():
    wire = (
        cq.Workplane("XZ")
        .moveTo(6, 0)
        .spline([(10, 8), (7, 16), (11, 24)], includeCurrent=True)
        .lineTo(3, 24)
        .lineTo(3, 0)
        .close()
    )
    return wire.revolve(100, (0, 0, 0), (0, 1, 0))


@fixture(
    "elliptic_ring",
    "a revolved ellipse that keeps off the axis: a surface of revolution closed in both directions",
    closed_form={"volume_mm3": 2 * pi * 20 * pi * 6 * 3},
)
def elliptic_ring():
    edge = cq.Edge.makeEllipse(6, 3, cq.Vector(20, 0, 0), cq.Vector(0, -1, 0), cq.Vector(1, 0, 0))
    return cq.Solid.revolve(cq.Wire.assembleEdges([edge]), [], 360, cq.Vector(0, 0, 0), cq.Vector(0, 0, 1))


@fixture("offset_surface", "an offset surface over a B-spline")
def offset_surface():
    return sheet(Geom_OffsetSurface(spline_surface(hills(6, 6), 3, 3), 1.5))


@fixture("offset_surface_inward", "an offset surface at a negative distance over a rational Bézier patch")
def offset_surface_inward():
    return sheet(Geom_OffsetSurface(Geom_BezierSurface(grid(hills(4, 4)), weights([[1, 2, 2, 1]] * 4)), -1.0))


@fixture("trimmed_surface", "a face over part of a B-spline's domain")
def trimmed_surface():
    surface = spline_surface(hills(6, 6), 3, 3)
    return sheet(Geom_RectangularTrimmedSurface(surface, 0.4, 2.3, 0.7, 2.9, True, True))


@fixture("filled_surface", "a surface filled into four curved edges")
def filled_surface():
    corners = [cq.Vector(0, 0, 0), cq.Vector(30, 0, 4), cq.Vector(30, 25, -2), cq.Vector(0, 25, 5)]
    bulges = [cq.Vector(15, -2, 3), cq.Vector(31, 12, 0), cq.Vector(14, 26, 3), cq.Vector(-1, 12, 1)]
    filling = BRepOffsetAPI_MakeFilling()
    for i in range(4):
        edge = cq.Edge.makeThreePointArc(corners[i], bulges[i], corners[(i + 1) % 4])
        filling.Add(edge.wrapped, GeomAbs_C0)
    filling.Build()
    return cq.Shape.cast(TopoDS.Face_s(filling.Shape()))


@fixture("spline_hill", "a block under a B-spline: six faces sewn to a solid")
def spline_hill():
    top = sheet(spline_surface(hills(6, 6), 3, 3))
    block = cq.Workplane().box(30, 30, 20, centered=False).translate((0, 0, -20)).val()
    walls = []
    for edge in top.Edges():
        start, end = edge.startPoint(), edge.endPoint()
        low_start, low_end = cq.Vector(start.x, start.y, -20), cq.Vector(end.x, end.y, -20)
        outline = [
            edge,
            cq.Edge.makeLine(end, low_end),
            cq.Edge.makeLine(low_end, low_start),
            cq.Edge.makeLine(low_start, start),
        ]
        walls.append(cq.Face.makeFromWires(cq.Wire.assembleEdges(outline)))
    sewing = BRepBuilderAPI_Sewing(1e-6)
    for face in [top, *walls, *[f for f in block.Faces() if f.Center().z < -19.9]]:
        sewing.Add(face.wrapped)
    sewing.Perform()
    solid = BRepBuilderAPI_MakeSolid(TopoDS.Shell_s(sewing.SewedShape())).Solid()
    return cq.Solid(solid).fix()


@fixture("spline_hill_drilled", "a B-spline face with a hole")
def spline_hill_drilled():
    return cq.Workplane(spline_hill()).cut(cq.Workplane().center(12, 17).circle(4).extrude(80, both=True))


@fixture("spline_edge_on_plane", "a plane trimmed by splines of degree 2 to 6")
def spline_edge_on_plane():
    edges = []
    corners = [cq.Vector(0, 0), cq.Vector(30, 0), cq.Vector(34, 20), cq.Vector(15, 30), cq.Vector(-5, 18)]
    for i, degree in enumerate(range(2, 7)):
        start, end = corners[i], corners[(i + 1) % 5]
        side = (end - start).cross(cq.Vector(0, 0, 1)).normalized()
        inner = [start + (end - start) * (k / degree) + side * (3.0 if k % 2 else -1.5) for k in range(1, degree)]
        edges.append(cq.Edge.makeBezier([start, *inner, end]))
    return cq.Solid.extrudeLinear(cq.Wire.assembleEdges(edges), [], cq.Vector(0, 0, 5))
