"""Every kind of surface that CAD tools at hand do not write."""

from math import acos, atan2, cos, pi, sin, sqrt

import numpy as np

from catalogue import hand
from part21 import FALSE, TRUE, Enum, Ref
from plane_curves import bezier_knots, quasi_uniform_knots, uniform_knots
from spline_patch import Patch, sides_loop, write_surface
from step_model import ORIGIN, X, Z, FaceFigures, StepModel

SURFACES = "MANIFOLD_SURFACE_SHAPE_REPRESENTATION"
BOUNDED = "GEOMETRICALLY_BOUNDED_SURFACE_SHAPE_REPRESENTATION"


def sheet(model: StepModel, name: str, faces) -> None:
    body = model.add("SHELL_BASED_SURFACE_MODEL", "", [model.add("OPEN_SHELL", "", list(faces))])
    model.product(name, [body], representation=SURFACES)


def hills(rows: int, columns: int) -> np.ndarray:
    """Poles over a square, waving."""
    return np.array(
        [
            [
                (30 * i / (rows - 1), 24 * j / (columns - 1), 6 * sin(1.9 * i + 0.3) * cos(1.3 * j))
                for j in range(columns)
            ]
            for i in range(rows)
        ]
    )


def uneven(rows: int, columns: int) -> np.ndarray:
    """Weights between 0.5 and 3."""
    return np.array([[0.5 + 0.5 * ((3 * i + 2 * j) % 6) for j in range(columns)] for i in range(rows)])


FORMS = {
    "WITH_KNOTS": (
        [0.0] * 4 + [0.3, 0.35, 0.8] + [1.0] * 4,
        [-1.0] * 3 + [0.0, 0.0] + [4.0] * 3,
    ),
    "UNIFORM_SURFACE": (uniform_knots(7, 3), uniform_knots(5, 2)),
    "QUASI_UNIFORM_SURFACE": (quasi_uniform_knots(7, 3), quasi_uniform_knots(5, 2)),
    "BEZIER_SURFACE": (bezier_knots(7, 3), bezier_knots(5, 2)),
}

for _form, (_u, _v) in FORMS.items():
    _word = {"WITH_KNOTS": "bspline"}.get(_form, _form.lower().removesuffix("_surface"))
    _full = "B_SPLINE_SURFACE_WITH_KNOTS" if _form == "WITH_KNOTS" else _form

    def spline_sheet(name: str, patch: Patch, form: str):
        model = StepModel()
        area, centroid = patch.figures()
        surface = write_surface(model, patch, form)
        face = model.face(surface, [sides_loop(model, patch)], kind="bspline", area=area, centroid=centroid)
        sheet(model, name, [face])
        return model, model.reference(bbox=patch.box(), closed=False)

    @hand(f"surface_{_word}", f"{_full} of degree 3 by 2")
    def plain(form=_form, u=_u, v=_v, word=_word):
        return spline_sheet(f"surface_{word}", Patch(3, 2, hills(7, 5), u, v), form)

    @hand(f"surface_{_word}_rational", f"the same as a complex instance with RATIONAL_B_SPLINE_SURFACE ({_full})")
    def rational(form=_form, u=_u, v=_v, word=_word):
        return spline_sheet(f"surface_{word}_rational", Patch(3, 2, hills(7, 5), u, v, uneven(7, 5)), form)


@hand("surface_bspline_no_bounds", "a B-spline face without any bound: its whole domain")
def surface_bspline_no_bounds():
    model = StepModel()
    patch = Patch(3, 2, hills(7, 5), quasi_uniform_knots(7, 3), quasi_uniform_knots(5, 2))
    area, centroid = patch.figures()
    sheet(
        model,
        "surface_bspline_no_bounds",
        [model.face(write_surface(model, patch), [], kind="bspline", area=area, centroid=centroid)],
    )
    return model, model.reference(bbox=patch.box(), closed=False)


MAJOR, MINOR = 6.0, 10.0


def degenerate_torus(name: str, outer: bool, bounded: bool):
    """The apple (outer) or the lemon (inner) of a torus whose minor radius is the larger one."""
    model = StepModel()
    surface = model.add("DEGENERATE_TOROIDAL_SURFACE", "", model.axis2(), MAJOR, MINOR, TRUE if outer else FALSE)
    pole = acos(-MAJOR / MINOR)
    height = sqrt(MINOR**2 - MAJOR**2)
    if outer:
        area = 2 * pi * MINOR * (MAJOR * 2 * pole + 2 * MINOR * sin(pole))
        first, last = -pole, pole
    else:
        area = 2 * pi * MINOR * (2 * MINOR * sin(pole) - MAJOR * (2 * pi - 2 * pole))
        first, last = pole, 2 * pi - pole
    nodes, weights = np.polynomial.legendre.leggauss(60)
    v = (first + last) / 2 + (last - first) / 2 * nodes
    volume = abs(
        pi * float(np.sum(weights * (MAJOR + MINOR * np.cos(v)) ** 2 * MINOR * np.cos(v))) * (last - first) / 2
    )
    loops = []
    if bounded:
        # The meridian at u = 0 from pole to pole, there and back.
        low, high = (0.0, 0.0, -height), (0.0, 0.0, height)
        meridian = model.circle((MAJOR, 0.0, 0.0), (0.0, -1.0, 0.0), X, MINOR)
        seam = model.edge(low, high, meridian) if outer else model.edge(high, low, meridian)
        loops = [model.loop((seam, True), (seam, False))]
    # The lemon's parametric normal points to the axis, so its face is turned.
    face = model.face(surface, loops, kind="torus", area=area, centroid=ORIGIN, same_sense=outer)
    model.product(name, [model.solid([face])])
    radius = MAJOR + MINOR if outer else MINOR - MAJOR
    top = MINOR if outer else height
    return model, model.reference(volume=volume, bbox=[[-radius, -radius, -top], [radius, radius, top]])


@hand("surface_degenerate_torus_apple", "DEGENERATE_TOROIDAL_SURFACE, select_outer .T., with a seam from pole to pole")
def apple():
    return degenerate_torus("surface_degenerate_torus_apple", True, True)


@hand("surface_degenerate_torus_lemon", "DEGENERATE_TOROIDAL_SURFACE, select_outer .F., with a seam from pole to pole")
def lemon():
    return degenerate_torus("surface_degenerate_torus_lemon", False, True)


@hand("surface_degenerate_torus_apple_no_bounds", "the apple as a face without bounds")
def apple_no_bounds():
    return degenerate_torus("surface_degenerate_torus_apple_no_bounds", True, False)


@hand("surface_degenerate_torus_lemon_no_bounds", "the lemon as a face without bounds")
def lemon_no_bounds():
    return degenerate_torus("surface_degenerate_torus_lemon_no_bounds", False, False)


@hand("surface_horn_torus", "a torus whose radii are equal: it touches itself in one point")
def horn_torus():
    model = StepModel()
    face = model.face(model.torus(10.0, 10.0), [], kind="torus", area=4 * pi**2 * 100, centroid=ORIGIN)
    model.product("surface_horn_torus", [model.solid([face])])
    return model, model.reference(volume=2 * pi**2 * 1000, bbox=[[-20.0, -20.0, -10.0], [20.0, 20.0, 10.0]])


@hand("surface_offset_plane", "OFFSET_SURFACE over a plane: a plane 4 higher")
def surface_offset_plane():
    model = StepModel()
    surface = model.add("OFFSET_SURFACE", "", model.plane(), 4.0, FALSE)
    corners = [(0.0, 0.0, 4.0), (20.0, 0.0, 4.0), (20.0, 10.0, 4.0), (0.0, 10.0, 4.0)]
    face = model.face(surface, [model.polygon(*corners)], kind="offset", area=200.0, centroid=(10.0, 5.0, 4.0))
    sheet(model, "surface_offset_plane", [face])
    return model, model.reference(bbox=[list(corners[0]), list(corners[2])], closed=False)


@hand("surface_offset_cylinder", "OFFSET_SURFACE over a cylinder, inward: a cylinder of radius 7")
def surface_offset_cylinder():
    model = StepModel()
    surface = model.add("OFFSET_SURFACE", "", model.cylinder(10.0), -3.0, FALSE)
    low, high = model.ring(ORIGIN, Z, X, 7.0), model.ring((0.0, 0.0, 12.0), Z, X, 7.0)
    seam = model.straight((7.0, 0.0, 0.0), (7.0, 0.0, 12.0))[0]
    loop = model.loop(low, (seam, True), (high, False), (seam, False))
    face = model.face(surface, [loop], kind="offset", area=2 * pi * 7 * 12, centroid=(0.0, 0.0, 6.0))
    sheet(model, "surface_offset_cylinder", [face])
    return model, model.reference(bbox=[[-7.0, -7.0, 0.0], [7.0, 7.0, 12.0]], closed=False)


@hand("surface_offset_bspline", "OFFSET_SURFACE over a B-spline, without bounds")
def surface_offset_bspline():
    model = StepModel()
    patch = Patch(3, 3, hills(5, 5) * np.array([1, 1, 0.5]), quasi_uniform_knots(5, 3), quasi_uniform_knots(5, 3))
    surface = model.add("OFFSET_SURFACE", "", write_surface(model, patch), 1.5, FALSE)
    area, centroid = patch.figures(1.5)
    sheet(model, "surface_offset_bspline", [model.face(surface, [], kind="offset", area=area, centroid=centroid)])
    return model, model.reference(bbox=patch.box(1.5), closed=False)


def trimmed_line(model: StepModel, a, b) -> Ref:
    return model.add("TRIMMED_CURVE", "", model.line(a, b), [model.point(a)], [model.point(b)], TRUE, Enum("CARTESIAN"))


@hand("surface_of_revolution_line", "SURFACE_OF_REVOLUTION over a slanting line: a cone")
def surface_of_revolution_line():
    model = StepModel()
    surface = model.add(
        "SURFACE_OF_REVOLUTION", "", model.line((10.0, 0.0, 0.0), (4.0, 0.0, 20.0)), model.axis1(ORIGIN, Z)
    )
    low, high = model.ring(ORIGIN, Z, X, 10.0), model.ring((0.0, 0.0, 20.0), Z, X, 4.0)
    seam = model.straight((10.0, 0.0, 0.0), (4.0, 0.0, 20.0))[0]
    area = pi * 14 * sqrt(436)
    centroid = (0.0, 0.0, 20 * 18 / 42)
    wall = model.face(
        surface,
        [model.loop(low, (seam, True), (high, False), (seam, False))],
        kind="revolution",
        area=area,
        centroid=centroid,
    )
    floor = model.face(
        model.plane(axis=(0.0, 0.0, -1.0)), [model.loop((low, False))], kind="plane", area=100 * pi, centroid=ORIGIN
    )
    lid = model.face(
        model.plane((0.0, 0.0, 20.0)), [model.loop(high)], kind="plane", area=16 * pi, centroid=(0.0, 0.0, 20.0)
    )
    model.product("surface_of_revolution_line", [model.solid([wall, floor, lid])])
    return model, model.reference(volume=pi * 20 * 156 / 3, bbox=[[-10.0, -10.0, 0.0], [10.0, 10.0, 20.0]])


@hand(
    "surface_of_revolution_skew_line", "SURFACE_OF_REVOLUTION over a line askew to the axis: a hyperboloid of one sheet"
)
def surface_of_revolution_skew_line():
    # The line (6, t, t): radius squared 36 + z^2 for z from -8 to 8.
    model = StepModel()
    surface = model.add(
        "SURFACE_OF_REVOLUTION", "", model.line((6.0, -8.0, -8.0), (6.0, 8.0, 8.0)), model.axis1(ORIGIN, Z)
    )
    x_low, x_high = (0.6, -0.8, 0.0), (0.6, 0.8, 0.0)
    low = model.ring((0.0, 0.0, -8.0), Z, x_low, 10.0)
    high = model.ring((0.0, 0.0, 8.0), Z, x_high, 10.0)
    seam = model.straight((6.0, -8.0, -8.0), (6.0, 8.0, 8.0))[0]
    # 2 pi integral of sqrt(36 + 2 z^2).
    k = sqrt(2) * 8
    area = 2 * pi * (8 * sqrt(36 + 128) + 36 / sqrt(2) * np.arcsinh(k / 6))
    wall = model.face(
        surface,
        [model.loop(low, (seam, True), (high, False), (seam, False))],
        kind="revolution",
        area=float(area),
        centroid=ORIGIN,
    )
    floor = model.face(
        model.plane((0.0, 0.0, -8.0), (0.0, 0.0, -1.0)),
        [model.loop((low, False))],
        kind="plane",
        area=100 * pi,
        centroid=(0.0, 0.0, -8.0),
    )
    lid = model.face(
        model.plane((0.0, 0.0, 8.0)), [model.loop(high)], kind="plane", area=100 * pi, centroid=(0.0, 0.0, 8.0)
    )
    model.product("surface_of_revolution_skew_line", [model.solid([wall, floor, lid])])
    volume = pi * (36 * 16 + 2 * 512 / 3)
    return model, model.reference(volume=volume, bbox=[[-10.0, -10.0, -8.0], [10.0, 10.0, 8.0]])


@hand("surface_of_revolution_circle", "SURFACE_OF_REVOLUTION over a circle: a torus without bounds")
def surface_of_revolution_circle():
    model = StepModel()
    circle = model.circle((20.0, 0.0, 0.0), (0.0, -1.0, 0.0), X, 5.0)
    surface = model.add("SURFACE_OF_REVOLUTION", "", circle, model.axis1(ORIGIN, Z))
    face = model.face(surface, [], kind="revolution", area=400 * pi**2, centroid=ORIGIN)
    model.product("surface_of_revolution_circle", [model.solid([face])])
    return model, model.reference(volume=1000 * pi**2, bbox=[[-25.0, -25.0, -5.0], [25.0, 25.0, 5.0]])


@hand("surface_of_revolution_half_circle", "SURFACE_OF_REVOLUTION over a half circle that meets the axis: a sphere")
def surface_of_revolution_half_circle():
    model = StepModel()
    half = model.add(
        "TRIMMED_CURVE",
        "",
        model.circle(ORIGIN, (0.0, -1.0, 0.0), X, 10.0),
        [model.point((0.0, 0.0, -10.0))],
        [model.point((0.0, 0.0, 10.0))],
        TRUE,
        Enum("CARTESIAN"),
    )
    surface = model.add("SURFACE_OF_REVOLUTION", "", half, model.axis1(ORIGIN, Z))
    face = model.face(surface, [], kind="revolution", area=400 * pi, centroid=ORIGIN)
    model.product("surface_of_revolution_half_circle", [model.solid([face])])
    return model, model.reference(volume=4000 * pi / 3, bbox=[[-10.0] * 3, [10.0] * 3])


@hand("surface_of_extrusion_long_vector", "SURFACE_OF_LINEAR_EXTRUSION along a slanting vector whose length is not one")
def surface_of_extrusion_long_vector():
    model = StepModel()
    circle = model.circle(ORIGIN, Z, X, 5.0)
    surface = model.add(
        "SURFACE_OF_LINEAR_EXTRUSION", "", circle, model.add("VECTOR", "", model.direction((3.0, 0.0, 4.0)), 2.5)
    )
    shift = (9.0, 0.0, 12.0)
    low, high = model.ring(ORIGIN, Z, X, 5.0), model.ring(shift, Z, X, 5.0)
    seam = model.straight((5.0, 0.0, 0.0), (14.0, 0.0, 12.0))[0]
    # The element is |tangent x direction| = 15 * 5 * sqrt(1 - (0.6 sin t)^2) per radian.
    t = (np.arange(4096) + 0.5) * 2 * pi / 4096
    element = 75 * np.sqrt(1 - (0.6 * np.sin(t)) ** 2)
    area = float(element.mean() * 2 * pi)
    wall = model.face(
        surface,
        [model.loop(low, (seam, True), (high, False), (seam, False))],
        kind="extrusion",
        area=area,
        centroid=(4.5, 0.0, 6.0),
    )
    floor = model.face(
        model.plane(axis=(0.0, 0.0, -1.0)), [model.loop((low, False))], kind="plane", area=25 * pi, centroid=ORIGIN
    )
    lid = model.face(model.plane(shift), [model.loop(high)], kind="plane", area=25 * pi, centroid=shift)
    model.product("surface_of_extrusion_long_vector", [model.solid([wall, floor, lid])])
    return model, model.reference(volume=300 * pi, bbox=[[-5.0, -5.0, 0.0], [14.0, 5.0, 12.0]])


def bounded_product(model: StepModel, name: str, surfaces) -> None:
    model.product(name, [model.add("GEOMETRIC_SET", "", list(surfaces))], representation=BOUNDED)


@hand(
    "surface_rectangular_trimmed",
    "RECTANGULAR_TRIMMED_SURFACE over cylinder, sphere and torus, one with u against the surface",
)
def surface_rectangular_trimmed():
    model = StepModel()
    trim = lambda basis, u, v, us, vs: model.add(  # noqa: E731
        "RECTANGULAR_TRIMMED_SURFACE", "", basis, *map(float, (*u, *v)), TRUE if us else FALSE, TRUE if vs else FALSE
    )
    # Over the seam: from 5.5 on past the full turn to 1.
    tube = trim(model.cylinder(10.0), (5.5, 1.0), (2.0, 12.0), True, True)
    angle = 1.0 + 2 * pi - 5.5
    middle = (5.5 + 1.0 + 2 * pi) / 2
    at = 10 * sin(angle / 2) / (angle / 2)
    model.faces.append(FaceFigures(tube, "cylinder", 10 * angle * 10, (at * cos(middle), at * sin(middle), 7.0)))
    # u falls from 1.5 to 0.5.
    ball = trim(model.sphere(10.0, (40.0, 0.0, 0.0)), (1.5, 0.5), (0.0, pi / 2), False, True)
    model.faces.append(FaceFigures(ball, "sphere", 100.0, None))
    ring = trim(model.torus(20.0, 5.0, (0.0, 60.0, 0.0)), (0.0, pi), (-pi / 2, pi / 2), True, True)
    model.faces.append(FaceFigures(ring, "torus", 5 * pi * (20 * pi + 10), None))
    bounded_product(model, "surface_rectangular_trimmed", [tube, ball, ring])
    box = [[-25.0, 10 * sin(5.5), -5.0], [40 + 10 * cos(0.5), 85.0, 12.0]]
    return model, model.reference(bbox=box, closed=False)


@hand("surface_rectangular_trimmed_degrees", "RECTANGULAR_TRIMMED_SURFACE whose bounds are degrees")
def surface_rectangular_trimmed_degrees():
    model = StepModel()
    context = model.context(angle=model.degree())
    patch = model.add("RECTANGULAR_TRIMMED_SURFACE", "", model.cylinder(10.0), 0.0, 90.0, 0.0, 12.0, TRUE, TRUE)
    model.faces.append(FaceFigures(patch, "cylinder", 5 * pi * 12, (20 / pi, 20 / pi, 6.0)))
    model.product(
        "surface_rectangular_trimmed_degrees",
        [model.add("GEOMETRIC_SET", "", [patch])],
        representation=BOUNDED,
        context=context,
    )
    return model, model.reference(bbox=[[0.0] * 3, [10.0, 10.0, 12.0]], closed=False)


@hand("surface_rectangular_trimmed_face", "an ADVANCED_FACE on a RECTANGULAR_TRIMMED_SURFACE")
def surface_rectangular_trimmed_face():
    model = StepModel()
    basis = model.cylinder(10.0)
    surface = model.add("RECTANGULAR_TRIMMED_SURFACE", "", basis, 0.0, pi / 2, 0.0, 12.0, TRUE, TRUE)
    a, b = (10.0, 0.0), (0.0, 10.0)
    arcs = [model.edge((*a, z), (*b, z), model.circle((0.0, 0.0, z), Z, X, 10.0)) for z in (0.0, 12.0)]
    right = model.straight((*b, 0.0), (*b, 12.0))[0]
    left = model.straight((*a, 0.0), (*a, 12.0))[0]
    loop = model.loop(arcs[0], right, (arcs[1], False), (left, False))
    face = model.face(surface, [loop], kind="cylinder", area=60 * pi, centroid=(20 / pi, 20 / pi, 6.0))
    sheet(model, "surface_rectangular_trimmed_face", [face])
    return model, model.reference(bbox=[[0.0] * 3, [10.0, 10.0, 12.0]], closed=False)


def boundary(model: StepModel, keyword: str, curves) -> Ref:
    """A boundary curve over pcurves, each used forward."""
    segments = [model.add("COMPOSITE_CURVE_SEGMENT", Enum("CONTINUOUS"), TRUE, curve) for curve in curves]
    return model.add(keyword, "", segments, FALSE)


def segment_2d(model: StepModel, surface: Ref, a, b) -> Ref:
    """A trimmed line in the surface's parameters."""
    line = model.line_2d(a, b)
    trimmed = model.add("TRIMMED_CURVE", "", line, [model.point(a)], [model.point(b)], TRUE, Enum("CARTESIAN"))
    return model.pcurve(surface, trimmed)


@hand(
    "surface_curve_bounded",
    "CURVE_BOUNDED_SURFACE: a plane with OUTER_BOUNDARY_CURVE and a round BOUNDARY_CURVE as a hole",
)
def surface_curve_bounded():
    model = StepModel()
    plane = model.plane((0.0, 0.0, 3.0))
    corners = [(0.0, 0.0), (20.0, 0.0), (20.0, 12.0), (0.0, 12.0)]
    sides = [segment_2d(model, plane, a, b) for a, b in zip(corners, corners[1:] + corners[:1])]
    outer = boundary(model, "OUTER_BOUNDARY_CURVE", sides)
    circle = model.add("CIRCLE", "", model.axis2_2d((8.0, 6.0)), 4.0)
    hole = boundary(model, "BOUNDARY_CURVE", [model.pcurve(plane, circle)])
    surface = model.add("CURVE_BOUNDED_SURFACE", "", plane, [outer, hole], FALSE)
    area = 240 - 16 * pi
    model.faces.append(FaceFigures(surface, "plane", area, ((2400 - 128 * pi) / area, 6.0, 3.0)))
    bounded_product(model, "surface_curve_bounded", [surface])
    return model, model.reference(bbox=[[0.0, 0.0, 3.0], [20.0, 12.0, 3.0]], closed=False)


@hand(
    "surface_curve_bounded_implicit", "CURVE_BOUNDED_SURFACE with implicit_outer: a whole B-spline domain with a hole"
)
def surface_curve_bounded_implicit():
    model = StepModel()
    poles = np.array([[(10.0 * i, 10.0 * j, 0.0) for j in range(4)] for i in range(4)])
    patch = Patch(3, 3, poles, bezier_knots(4, 3), bezier_knots(4, 3))
    basis = write_surface(model, patch)
    # The surface is the plane x = 30 u, y = 30 v; the hole's radius is 0.2 in parameters, 6 mm in space.
    hole = model.add("CIRCLE", "", model.axis2_2d((0.5, 0.5)), 0.2)
    curve = boundary(model, "BOUNDARY_CURVE", [model.pcurve(basis, hole)])
    surface = model.add("CURVE_BOUNDED_SURFACE", "", basis, [curve], TRUE)
    model.faces.append(FaceFigures(surface, "bspline", 900 - 36 * pi, (15.0, 15.0, 0.0)))
    bounded_product(model, "surface_curve_bounded_implicit", [surface])
    return model, model.reference(bbox=[[0.0] * 3, [30.0, 30.0, 0.0]], closed=False)


@hand(
    "surface_curve_bounded_cylinder",
    "CURVE_BOUNDED_SURFACE on a cylinder with COMPOSITE_CURVE_ON_SURFACE and SURFACE_CURVEs inside",
)
def surface_curve_bounded_cylinder():
    model = StepModel()
    basis = model.cylinder(10.0)
    a, b = (10.0, 0.0), (0.0, 10.0)

    def arc(z: float, forward: bool) -> Ref:
        circle = model.circle((0.0, 0.0, z), Z, X, 10.0)
        ends = [[model.point((*a, z))], [model.point((*b, z))]]
        trimmed = model.add("TRIMMED_CURVE", "", circle, *ends, TRUE, Enum("CARTESIAN"))
        flat = segment_2d(model, basis, (0.0, z), (pi / 2, z))
        return model.add("SURFACE_CURVE", "", trimmed, [flat], Enum("CURVE_3D"))

    def side(point, z0: float, z1: float) -> Ref:
        u = atan2(point[1], point[0])
        flat = segment_2d(model, basis, (u, z0), (u, z1))
        return model.add("SURFACE_CURVE", "", trimmed_line(model, (*point, z0), (*point, z1)), [flat], Enum("CURVE_3D"))

    piece = lambda curve, sense: model.add("COMPOSITE_CURVE_SEGMENT", Enum("CONTINUOUS"), sense, curve)  # noqa: E731
    # The upper two parts are a composite of their own, run backward.
    back = model.add(
        "COMPOSITE_CURVE_ON_SURFACE", "", [piece(side(a, 0.0, 12.0), TRUE), piece(arc(12.0, True), TRUE)], FALSE
    )
    outline = [piece(arc(0.0, True), TRUE), piece(side(b, 0.0, 12.0), TRUE), piece(back, FALSE)]
    outer = model.add("OUTER_BOUNDARY_CURVE", "", outline, FALSE)
    surface = model.add("CURVE_BOUNDED_SURFACE", "", basis, [outer], FALSE)
    model.faces.append(FaceFigures(surface, "cylinder", 60 * pi, (20 / pi, 20 / pi, 6.0)))
    bounded_product(model, "surface_curve_bounded_cylinder", [surface])
    return model, model.reference(bbox=[[0.0] * 3, [10.0, 10.0, 12.0]], closed=False)


@hand("surface_rectangular_composite", "RECTANGULAR_COMPOSITE_SURFACE of two by two patches, one of them turned")
def surface_rectangular_composite():
    model = StepModel()

    def patch(x: float, y: float, turned: bool) -> Ref:
        origin = (x, y, 0.0)
        plane = (
            model.plane(origin) if not turned else model.plane((x + 10.0, y, 0.0), (0.0, 0.0, -1.0), (-1.0, 0.0, 0.0))
        )
        basis = model.add("RECTANGULAR_TRIMMED_SURFACE", "", plane, 0.0, 10.0, 0.0, 8.0, TRUE, TRUE)
        model.faces.append(FaceFigures(basis, "plane", 80.0, (x + 5.0, y + 4.0, 0.0)))
        continuous = Enum("CONTINUOUS")
        return model.add("SURFACE_PATCH", basis, continuous, continuous, FALSE if turned else TRUE, TRUE)

    rows = [[patch(0.0, 0.0, False), patch(0.0, 8.0, False)], [patch(10.0, 0.0, True), patch(10.0, 8.0, False)]]
    surface = model.add("RECTANGULAR_COMPOSITE_SURFACE", "", rows)
    bounded_product(model, "surface_rectangular_composite", [surface])
    return model, model.reference(bbox=[[0.0] * 3, [20.0, 16.0, 0.0]], closed=False)
