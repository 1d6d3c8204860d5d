"""Every kind of surface, untrimmed and trimmed, alone."""

from __future__ import annotations

from math import atan2, cos, degrees, pi, radians, sin, sqrt

import numpy as np

from iges.catalogue import iges
from iges.curves import circle_spline
from iges_brep import Brep
from iges_deck import FREE, PART
from iges_model import IgesModel
from plane_curves import Spline, quasi_uniform_knots
from spline_patch import Patch
from surface_figures import (
    Piece,
    extruded,
    frame,
    of_patch,
    of_spline,
    patch_at,
    quarters,
    revolved,
    stacked,
)

SLANTING = (2 / 3, 2 / 3, 1 / 3)
ACROSS = (-1 / sqrt(2), 1 / sqrt(2), 0.0)
PLACE = (10.0, -4.0, 6.0)


def alone(model: IgesModel):
    return model, model.reference()


def closed_alone(model: IgesModel, volume: float):
    """A face that closes on itself: a body to some readers, a sheet to others."""
    reference = model.reference(volume=volume)
    del reference["solids"]
    return model, reference


# Type 114


def bicubic(name: str, u_knots, v_knots, function):
    """A parametric spline surface whose patches are a function's bicubic Hermite interpolation."""
    model = IgesModel(name)
    m, n = len(u_knots) - 1, len(v_knots) - 1
    values = [3, 1, m, n, *u_knots, *v_knots]
    pieces = []
    for i in range(m + 1):
        for j in range(n + 1):
            if i == m or j == n:
                values += [0.0] * 48
                continue
            u0, u1, v0, v1 = u_knots[i], u_knots[i + 1], v_knots[j], v_knots[j + 1]
            patch = []
            for axis in range(3):
                patch.append(hermite(lambda u, v, k=axis: function(u, v)[k], u0, u1, v0, v1))
                # s runs fastest: A B C D, then those times t.
                values += [float(patch[-1][p, q]) for q in range(4) for p in range(4)]
            pieces.append(
                Piece(
                    lambda u, v, c=patch, a=u0, b=v0: stacked(
                        *(np.polynomial.polynomial.polyval2d(u - a, v - b, axis) for axis in c)
                    ),
                    (u0, u1),
                    (v0, v1),
                )
            )
    entity = model.add(114, values)
    model.know_pieces(entity, "bspline", *pieces)
    return alone(model)


def hermite(function, u0, u1, v0, v1) -> np.ndarray:
    """The polynomial of degree 3 by 3 through a grid of four by four points; first index: power of u - u0."""
    us, vs = np.linspace(0.0, u1 - u0, 4), np.linspace(0.0, v1 - v0, 4)
    grid = np.array([[function(u0 + u, v0 + v) for v in vs] for u in us])
    a, b = np.vander(us, increasing=True), np.vander(vs, increasing=True)
    return np.linalg.solve(a, np.linalg.solve(b, grid.T).T)


@iges("surface_114_patches", "a parametric spline surface (114) of two by two bicubic patches with uneven breakpoints")
def spline_surface():
    def function(u, v):
        return 10 * u, 8 * v + u * v / 3, (u - 1.0) ** 2 * (v - 2.0) + 0.3 * u**3

    return bicubic("surface_114_patches", [0.0, 1.0, 2.5], [0.0, 2.0, 3.0], function)


@iges("surface_114_kinked", "a parametric spline surface of two by two patches that meet in creases")
def spline_surface_kinked():
    def function(u, v):
        return 10 * u, 8 * v, 4 * abs(u - 1.0) + 3 * abs(v - 1.0) + 0.5 * u * v

    return bicubic("surface_114_kinked", [0.0, 1.0, 2.0], [0.0, 1.0, 3.0], function)


# Type 118


@iges("surface_118_form_1", "a ruled surface (118 form 1) between a line and an arc, first points joined (DIRFLG 0)")
def ruled():
    model = IgesModel("surface_118_form_1")
    line = model.line((10.0, 0.0, 0.0), (0.0, 10.0, 0.0))
    arc = model.arc((0.0, 0.0), (14.0, 0.0), (0.0, 14.0), 12.0)
    entity = model.add(118, [line, arc, 0, 0], form=1)

    def at(t, s):
        a = stacked(10 - 10 * t, 10 * t, 0.0)
        b = stacked(14 * np.cos(t * pi / 2), 14 * np.sin(t * pi / 2), 12.0)
        return (1 - s)[..., None] * a + s[..., None] * b

    model.know_pieces(entity, "ruled", Piece(at, (0.0, 1.0), (0.0, 1.0)))
    return alone(model)


@iges("surface_118_reversed", "a ruled surface whose second curve is used backward (DIRFLG 1)")
def ruled_reversed():
    model = IgesModel("surface_118_reversed")
    line = model.line((0.0, 10.0, 0.0), (10.0, 0.0, 0.0))
    arc = model.arc((0.0, 0.0), (14.0, 0.0), (0.0, 14.0), 12.0)
    entity = model.add(118, [line, arc, 1, 1], form=1)

    def at(t, s):
        a = stacked(10 - 10 * t, 10 * t, 0.0)
        b = stacked(14 * np.cos(t * pi / 2), 14 * np.sin(t * pi / 2), 12.0)
        return (1 - s)[..., None] * a + s[..., None] * b

    model.know_pieces(entity, "ruled", Piece(at, (0.0, 1.0), (0.0, 1.0)))
    return alone(model)


@iges("surface_118_form_0", "a ruled surface of equal arc length (form 0) between two circles: a frustum")
def ruled_by_length():
    model = IgesModel("surface_118_form_0")
    low, high = model.circle((0.0, 0.0), 10.0), model.circle((0.0, 0.0), 6.0, 12.0)
    entity = model.add(118, [low, high, 0, 1], form=0)
    wall = revolved(lambda t: (10 - 4 * t, 12 * t), (0.0, 1.0), 0.0, 2 * pi)
    model.know_pieces(entity, "ruled", wall)
    return alone(model)


@iges("surface_118_splines", "a ruled surface (form 1) between two B-splines of different degrees and domains")
def ruled_splines():
    model = IgesModel("surface_118_splines")
    first = Spline(3, [(0.0, 0.0), (6.0, 5.0), (14.0, -5.0), (20.0, 0.0)], [2.0] * 4 + [5.0] * 4)
    second = Spline(2, [(0.0, 3.0), (10.0, 12.0), (22.0, 3.0)], [0.0] * 3 + [1.0] * 3)
    lifted = Spline(2, [(x, y, 9.0) for x, y in second.poles], second.knots)
    entity = model.add(118, [model.spline(first), model.spline(lifted), 0, 0], form=1)
    a, b = of_spline(first), of_spline(lifted)

    def at(t, s):
        return (1 - s)[..., None] * stacked(*a(2 + 3 * t)) + s[..., None] * stacked(*b(t))

    model.know_pieces(entity, "ruled", Piece(at, (0.0, 1.0), (0.0, 1.0)))
    return alone(model)


# Type 120


def revolution(model: IgesModel, generatrix: int, first: float, last: float, **options) -> int:
    """A surface of revolution about the slanting axis."""
    end = tuple(p + a for p, a in zip(PLACE, SLANTING))
    return model.add(120, [model.line(PLACE, end), generatrix, first, last], **options)


AXES = frame(SLANTING, ACROSS)


def on_axes(radius: float, height: float) -> tuple:
    """The point at angle zero about the slanting axis."""
    return tuple(float(c) for c in AXES @ (radius, 0.0, height) + np.array(PLACE))


def turned(profile, breaks, first: float, last: float) -> Piece:
    return revolved(profile, breaks, first, last, PLACE, SLANTING, ACROSS)


@iges("surface_120_cylinder_part", "a surface of revolution (120) of a line over 200 degrees: a part of a cylinder")
def part_cylinder():
    model = IgesModel("surface_120_cylinder_part")
    generatrix = model.line(on_axes(8.0, -3.0), on_axes(8.0, 9.0))
    first, last = 0.5, 0.5 + radians(200)
    entity = revolution(model, generatrix, first, last)
    model.know_pieces(entity, "cylinder", turned(lambda t: (8.0 + 0 * t, t), (-3.0, 9.0), first, last))
    return alone(model)


@iges("surface_120_cone", "a whole turn of a line that slants towards the axis and meets it: a cone")
def cone():
    model = IgesModel("surface_120_cone")
    entity = revolution(model, model.line(on_axes(8.0, 0.0), on_axes(0.0, 12.0)), 0.0, 2 * pi)
    model.know_pieces(entity, "cone", turned(lambda t: (8 - 8 * t, 12 * t), (0.0, 1.0), 0.0, 2 * pi))
    return alone(model)


@iges("surface_120_cone_part", "a part of a cone over 100 degrees, from an angle that is not zero")
def cone_part():
    model = IgesModel("surface_120_cone_part")
    first, last = -0.6, -0.6 + radians(100)
    entity = revolution(model, model.line(on_axes(5.0, 2.0), on_axes(11.0, 8.0)), first, last)
    model.know_pieces(entity, "cone", turned(lambda t: (5 + 6 * t, 2 + 6 * t), (0.0, 1.0), first, last))
    return alone(model)


@iges("surface_120_disk", "a whole turn of a line at right angles to the axis: a washer")
def disk_of_revolution():
    model = IgesModel("surface_120_disk")
    entity = revolution(model, model.line(on_axes(3.0, 2.0), on_axes(11.0, 2.0)), 0.0, 2 * pi)
    model.know_pieces(entity, "plane", turned(lambda t: (t, 2.0 + 0 * t), (3.0, 11.0), 0.0, 2 * pi))
    return alone(model)


@iges("surface_120_six_digits", "a whole turn that ends at 6.28318: a cylinder that closes")
def six_digits():
    model = IgesModel("surface_120_six_digits")
    entity = revolution(model, model.line(on_axes(8.0, -3.0), on_axes(8.0, 9.0)), 0.0, 6.28318)
    model.know_pieces(entity, "cylinder", turned(lambda t: (8.0 + 0 * t, t), (-3.0, 9.0), 0.0, 2 * pi))
    return alone(model)


def meridian(model: IgesModel, centre, radius: float, first: float, last: float) -> int:
    """A circular arc in the half plane at angle zero about the slanting axis; angles from the radius to the axis."""
    # The arc's x is the radius, its y the axis, so that its z is radius x axis.
    x, y = AXES[:, 0], AXES[:, 2]
    rows = np.column_stack([x, y, np.cross(x, y), np.array(PLACE)])
    ends = [(centre[0] + radius * cos(a), centre[1] + radius * sin(a)) for a in (first, last)]
    return model.arc(centre, *ends, transformation=model.matrix(rows))


def meridian_conic(model: IgesModel, form: int, coefficients, start, end) -> int:
    """A conic in the half plane at angle zero about the slanting axis; x is the radius, y the height."""
    x, y = AXES[:, 0], AXES[:, 2]
    rows = np.column_stack([x, y, np.cross(x, y), np.array(PLACE)])
    values = [*map(float, coefficients), 0.0, *map(float, start), *map(float, end)]
    return model.add(104, values, form=form, status=PART, transformation=model.matrix(rows))


@iges("surface_120_parabola", "a whole turn of a parabola from its vertex on the axis: a paraboloid")
def paraboloid():
    model = IgesModel("surface_120_parabola")
    curve = meridian_conic(model, 3, (1, 0, 0, 0, -12, 0), (0, 0), (9, 6.75))
    entity = revolution(model, curve, 0.0, 2 * pi)
    model.know_pieces(entity, "revolution", turned(lambda t: (t, t * t / 12), (0.0, 9.0), 0.0, 2 * pi))
    return alone(model)


@iges("surface_120_ellipse", "a quarter of an ellipse from the axis outward, a whole turn: half an ellipsoid")
def half_ellipsoid():
    model = IgesModel("surface_120_ellipse")
    curve = meridian_conic(model, 1, (1 / 100, 0, 1 / 36, 0, 0, -1), (10, 0), (0, 6))
    entity = revolution(model, curve, 0.0, 2 * pi)
    profile = lambda t: (10 * np.cos(t), 6 * np.sin(t))  # noqa: E731
    model.know_pieces(entity, "revolution", turned(profile, (0.0, pi / 2), 0.0, 2 * pi))
    return alone(model)


@iges("surface_120_hyperbola", "a part of a hyperbola that keeps off the axis, 5/6 of a turn: a cooling tower")
def cooling_tower():
    model = IgesModel("surface_120_hyperbola")
    low, high = -1.0, 0.6
    # The curve has no direction of its own but from start to end.
    ends = [(5 * np.cosh(t), 8 * np.sinh(t)) for t in (low, high)]
    curve = meridian_conic(model, 2, (1 / 25, 0, -1 / 64, 0, 0, -1), *ends)
    entity = revolution(model, curve, 0.0, 5 / 3 * pi)
    profile = lambda t: (5 * np.cosh(t), 8 * np.sinh(t))  # noqa: E731
    model.know_pieces(entity, "revolution", turned(profile, (low, high), 0.0, 5 / 3 * pi))
    return alone(model)


@iges("surface_120_torus_part", "a surface of revolution of an arc that keeps off the axis, 3/4 of a turn")
def torus_part():
    model = IgesModel("surface_120_torus_part")
    entity = revolution(model, meridian(model, (15.0, 0.0), 5.0, -1.0, 2.5), 0.0, 1.5 * pi)
    profile = lambda t: (15 + 5 * np.cos(t), 5 * np.sin(t))  # noqa: E731
    model.know_pieces(entity, "torus", turned(profile, (-1.0, 0.75, 2.5), 0.0, 1.5 * pi))
    return alone(model)


@iges("surface_120_sphere", "half a circle turned about its diameter: a whole sphere without any boundary")
def sphere():
    model = IgesModel("surface_120_sphere")
    entity = revolution(model, meridian(model, (0.0, 0.0), 9.0, -pi / 2, pi / 2), 0.0, 2 * pi)
    profile = lambda t: (9 * np.cos(t), 9 * np.sin(t))  # noqa: E731
    model.know_pieces(entity, "sphere", turned(profile, (-pi / 2, 0.0, pi / 2), 0.0, 2 * pi))
    return closed_alone(model, 972 * pi)


@iges("surface_120_spline", "a surface of revolution of a B-spline, half a turn")
def spline_turned():
    model = IgesModel("surface_120_spline")
    profile = Spline(3, [(6.0, 0.0), (12.0, 4.0), (2.0, 9.0), (8.0, 15.0), (9.0, 18.0)], quasi_uniform_knots(5, 3))
    poles = [on_axes(*pole) for pole in profile.poles]
    entity = revolution(model, model.spline(Spline(3, poles, profile.knots)), 0.0, pi)
    curve = of_spline(profile)
    model.know_pieces(entity, "revolution", turned(lambda t: curve(t)[:2], profile.breaks(), 0.0, pi))
    return alone(model)


# Type 122


@iges("surface_122_spline", "a tabulated cylinder (122) of a B-spline, not at right angles to it")
def tabulated():
    model = IgesModel("surface_122_spline")
    spline = Spline(3, [(0.0, 0.0), (6.0, 8.0), (14.0, -8.0), (20.0, 0.0)], [0.0] * 4 + [1.0] * 4)
    entity = model.add(122, [model.spline(spline), 5.0, 3.0, 12.0])
    model.know_pieces(entity, "extrusion", extruded(of_spline(spline), (0.0, 1.0), (5.0, 3.0, 12.0)))
    return alone(model)


@iges("surface_122_circle", "a tabulated cylinder of a whole circle: a tube")
def tube():
    model = IgesModel("surface_122_circle")
    entity = model.add(122, [model.circle((3.0, 4.0), 6.0, 2.0), 9.0, 4.0, 17.0])
    wall = Piece(lambda t, z: stacked(3 + 6 * np.cos(t), 4 + 6 * np.sin(t), z), quarters(0.0, 2 * pi), (2.0, 17.0))
    model.know_pieces(entity, "cylinder", wall)
    return alone(model)


@iges("surface_122_composite", "a tabulated cylinder of a composite curve: a bent sheet with a crease")
def tabulated_composite():
    model = IgesModel("surface_122_composite")
    parts = [
        model.line((0.0, 0.0, 0.0), (10.0, 0.0, 0.0)),
        model.arc((10.0, 6.0), (10.0, 0.0), (16.0, 6.0)),
        model.line((16.0, 6.0, 0.0), (20.0, 10.0, 0.0)),
    ]
    entity = model.add(122, [model.composite(parts), 0.0, 0.0, 8.0])
    pieces = [
        extruded(lambda t: (10 * t, 0 * t, 0 * t), (0.0, 1.0), (0.0, 0.0, 8.0)),
        extruded(lambda t: (10 + 6 * np.sin(t), 6 - 6 * np.cos(t), 0 * t), (0.0, pi / 2), (0.0, 0.0, 8.0)),
        extruded(lambda t: (16 + 4 * t, 6 + 4 * t, 0 * t), (0.0, 1.0), (0.0, 0.0, 8.0)),
    ]
    model.know_pieces(entity, "extrusion", *pieces)
    return alone(model)


# Type 128


def hill(degree_u: int = 3, degree_v: int = 2, weights=None) -> Patch:
    rows, columns = degree_u + 3, degree_v + 2
    poles = [
        [(30.0 * i / (rows - 1), 20.0 * j / (columns - 1), 4.0 * sin(1.3 * i) * cos(0.9 * j)) for j in range(columns)]
        for i in range(rows)
    ]
    return Patch(
        degree_u,
        degree_v,
        poles,
        quasi_uniform_knots(rows, degree_u),
        quasi_uniform_knots(columns, degree_v),
        weights,
    )


@iges("surface_128_polynomial", "a polynomial B-spline surface (128) of degree 3 by 2, untrimmed")
def polynomial():
    model = IgesModel("surface_128_polynomial")
    patch = hill()
    model.know_pieces(model.patch(patch), "bspline", of_patch(patch))
    return alone(model)


@iges("surface_128_rational", "a rational B-spline surface of degree 2 by 3 with uneven weights, untrimmed")
def rational():
    model = IgesModel("surface_128_rational")
    weights = [[1.0 + 0.7 * ((2 * i + 3 * j) % 4) for j in range(5)] for i in range(5)]
    patch = hill(2, 3, weights)
    model.know_pieces(model.patch(patch), "bspline", of_patch(patch))
    return alone(model)


@iges("surface_128_part_of_domain", "a B-spline surface of which U0 to V1 take only a part")
def part_of_domain():
    model = IgesModel("surface_128_part_of_domain")
    patch = hill()
    part = ((0.5, 2.25), (0.25, 1.5))
    piece = Piece(patch_at(patch), (0.5, 1.0, 2.0, 2.25), (0.25, 1.0, 1.5))
    model.know_pieces(model.patch(patch, part=part), "bspline", piece)
    return alone(model)


def tube_patch(radius: float, height: float) -> Patch:
    """A cylinder about z as a rational B-spline, closed in u."""
    ring = circle_spline(radius)
    poles = [[(x, y, z) for z in (0.0, height)] for x, y in ring.poles]
    weights = [[w, w] for w in ring.weights]
    return Patch(2, 1, poles, ring.knots, [0.0, 0.0, 1.0, 1.0], weights)


@iges("surface_128_closed", "a tube as a rational B-spline surface that is closed in u, untrimmed")
def closed_patch():
    model = IgesModel("surface_128_closed")
    entity = model.patch(tube_patch(10.0, 25.0), closed=(True, False))
    model.know(entity, "bspline", 500 * pi, (0.0, 0.0, 12.5), [[-10.0, -10.0, 0.0], [10.0, 10.0, 25.0]])
    return alone(model)


def torus_patch(major: float, minor: float) -> Patch:
    """A torus about z as a rational B-spline, closed in both directions."""
    around, across = circle_spline(1.0), circle_spline(minor)
    poles = [[(x * (major + r), y * (major + r), z) for r, z in across.poles] for x, y in around.poles]
    weights = [[a * b for b in across.weights] for a in around.weights]
    return Patch(2, 2, poles, around.knots, across.knots, weights)


@iges("surface_128_torus", "a torus as a rational B-spline surface that is closed in u and v: a body without boundary")
def torus_of_splines():
    model = IgesModel("surface_128_torus")
    entity = model.patch(torus_patch(15.0, 4.0), closed=(True, True))
    model.know(entity, "bspline", 4 * pi**2 * 60, (0.0, 0.0, 0.0), [[-19.0, -19.0, -4.0], [19.0, 19.0, 4.0]])
    return closed_alone(model, 2 * pi**2 * 15 * 16)


@iges("surface_128_sphere", "a sphere as a rational B-spline surface: closed in u, collapsed to poles in v")
def sphere_of_splines():
    model = IgesModel("surface_128_sphere")
    around, w = circle_spline(1.0), sqrt(0.5)
    half = [(0.0, -8.0, 1.0), (8.0, -8.0, w), (8.0, 0.0, 1.0), (8.0, 8.0, w), (0.0, 8.0, 1.0)]
    poles = [[(x * r, y * r, z) for r, z, _ in half] for x, y in around.poles]
    weights = [[a * b for _, _, b in half] for a in around.weights]
    patch = Patch(2, 2, poles, around.knots, [0.0] * 3 + [0.5] * 2 + [1.0] * 3, weights)
    entity = model.patch(patch, closed=(True, False))
    model.know(entity, "bspline", 256 * pi, (0.0, 0.0, 0.0), [[-8.0] * 3, [8.0] * 3])
    return closed_alone(model, 2048 / 3 * pi)


# Type 140


@iges("surface_140_of_plane", "an offset surface (140) of a flat B-spline surface")
def offset_of_plane():
    model = IgesModel("surface_140_of_plane")
    base = model.bilinear((0.0, 0.0, 2.0), (20.0, 0.0, 0.0), (0.0, 10.0, 0.0), status=PART)
    entity = model.add(140, [0.0, 0.0, 1.0, 3.0, base])
    model.know(entity, "plane", 200.0, (10.0, 5.0, 5.0), [[0.0, 0.0, 5.0], [20.0, 10.0, 5.0]])
    return alone(model)


@iges("surface_140_of_cylinder", "an offset surface outside a part of a cylinder of revolution")
def offset_of_cylinder():
    model = IgesModel("surface_140_of_cylinder")
    axis = model.line((0.0, 0.0, 0.0), (0.0, 0.0, 1.0))
    generatrix = model.line((10.0, 0.0, 0.0), (10.0, 0.0, 20.0))
    base = model.add(120, [axis, generatrix, 0.0, 1.4], status=PART)
    # The offset is to the side that the indicator shows.
    entity = model.add(140, [cos(0.7), sin(0.7), 0.0, 2.0, base])
    model.know_pieces(entity, "cylinder", revolved(lambda t: (12.0 + 0 * t, t), (0.0, 20.0), 0.0, 1.4))
    return alone(model)


@iges("surface_140_of_spline", "an offset surface at a distance of -1.5 of a B-spline surface")
def offset_of_spline():
    model = IgesModel("surface_140_of_spline")
    poles = [[(10.0 * i, 8.0 * j, 1.2 * (i - 1.5) ** 2 - 0.8 * (j - 1.0) ** 2) for j in range(3)] for i in range(4)]
    patch = Patch(3, 2, poles, [0.0] * 4 + [1.0] * 4, [0.0] * 3 + [1.0] * 3)
    normal = patch.normals([0.0], [0.0])[0, 0]
    normal = normal / np.linalg.norm(normal)
    entity = model.add(140, [*map(float, normal), -1.5, model.patch(patch, status=PART)])
    area, centroid = patch.figures(-1.5)
    model.know(entity, "offset", area, centroid, patch.box(-1.5))
    return alone(model)


# Types 190 to 198


def in_plane(model: IgesModel, radius: float, height: float) -> int:
    """A circle about the slanting axis."""
    rows = np.column_stack([AXES, np.array(PLACE) + height * AXES[:, 2]])
    return model.circle((0.0, 0.0), radius, transformation=model.matrix(rows))


for _form in (0, 1):
    _x = ACROSS if _form else None
    _with = "with a reference direction" if _form else "without a reference direction"

    @iges(f"surface_190_form_{_form}", f"a plane surface (190 form {_form}), {_with}, with a round boundary and hole")
    def plane(form=_form, x=_x):
        model = IgesModel(f"surface_190_form_{form}")
        surface = model.elementary(190, PLACE, axis=SLANTING, x=x)
        face = model.trimmed(surface, in_plane(model, 10.0, 0.0), [in_plane(model, 4.0, 0.0)])
        model.know_pieces(face, "plane", turned(lambda t: (t, 0 * t), (4.0, 10.0), 0.0, 2 * pi))
        return alone(model)

    @iges(
        f"surface_192_form_{_form}",
        f"a right circular cylindrical surface (192 form {_form}), {_with}, between two circles",
    )
    def cylindrical(form=_form, x=_x):
        return between_circles(192, form, x, (8.0,), (8.0, -2.0), (8.0, 13.0), "cylinder")

    @iges(
        f"surface_194_form_{_form}",
        f"a right circular conical surface (194 form {_form}), {_with}, between two circles",
    )
    def conical(form=_form, x=_x):
        angle = degrees(atan2(3.0, 4.0))
        return between_circles(194, form, x, (6.0, angle), (4.5, -2.0), (12.0, 8.0), "cone")

    @iges(f"surface_196_form_{_form}", f"a spherical surface (196 form {_form}), {_with}: a cap above a circle")
    def spherical(form=_form, x=_x):
        model = IgesModel(f"surface_196_form_{form}")
        axes = {"axis": SLANTING, "x": x} if form else {}
        surface = model.elementary(196, PLACE, 10.0, **axes)
        brep = Brep(model)
        start = on_axes(8.0, 6.0)
        rim = brep.edge(in_plane(model, 8.0, 6.0), start, start)
        face = brep.face(surface, [brep.loop((rim, True))])
        brep.shell([face], form=2, status=FREE)
        cap = turned(lambda t: (10 * np.sin(t), 10 * np.cos(t)), (0.0, atan2(8.0, 6.0)), 0.0, 2 * pi)
        model.know_pieces(face, "sphere", cap)
        return alone(model)

    @iges(
        f"surface_198_form_{_form}",
        f"a toroidal surface (198 form {_form}), {_with}: its outer half between two circles",
    )
    def toroidal(form=_form, x=_x):
        model = IgesModel(f"surface_198_form_{form}")
        surface = model.elementary(198, PLACE, 15.0, 5.0, axis=SLANTING, x=x)
        brep = Brep(model)
        low, high = on_axes(15.0, -5.0), on_axes(15.0, 5.0)
        below = brep.edge(in_plane(model, 15.0, -5.0), low, low)
        above = brep.edge(in_plane(model, 15.0, 5.0), high, high)
        seam = brep.edge(meridian(model, (15.0, 0.0), 5.0, -pi / 2, pi / 2), low, high)
        loop = brep.loop((below, True), (seam, True), (above, False), (seam, False))
        face = brep.face(surface, [loop])
        brep.shell([face], form=2, status=FREE)
        half = turned(lambda t: (15 + 5 * np.cos(t), 5 * np.sin(t)), (-pi / 2, 0.0, pi / 2), 0.0, 2 * pi)
        model.know_pieces(face, "torus", half)
        return alone(model)


def between_circles(kind: int, form: int, x, values, low, high, what: str):
    """A face of an open shell between two circles (radius, height), with a seam."""
    model = IgesModel(f"surface_{kind}_form_{form}")
    surface = model.elementary(kind, PLACE, *values, axis=SLANTING, x=x)
    brep = Brep(model)
    a, b = on_axes(*low), on_axes(*high)
    below = brep.edge(in_plane(model, *low), a, a)
    above = brep.edge(in_plane(model, *high), b, b)
    seam, forward = brep.straight(a, b)
    loop = brep.loop((below, True), (seam, forward), (above, False), (seam, not forward))
    face = brep.face(surface, [loop])
    brep.shell([face], form=2, status=FREE)
    profile = lambda t: (low[0] + t * (high[0] - low[0]), low[1] + t * (high[1] - low[1]))  # noqa: E731
    model.know_pieces(face, what, turned(profile, (0.0, 1.0), 0.0, 2 * pi))
    return alone(model)
