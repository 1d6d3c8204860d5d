"""Every kind of curve, as the boundary of plane faces and as the directrix of walls."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, cosh, hypot, pi, sin, sinh, sqrt
from typing import Callable

import numpy as np

from iges.catalogue import iges
from iges_deck import PART
from iges_model import IgesModel, shift
from plane_curves import (
    Piece,
    Spline,
    ellipse_pieces,
    line_piece,
    quasi_uniform_knots,
    uniform_knots,
)
from prism import outline_figures

HEIGHT = 5.0


@dataclass
class Segment:
    """A part of an outline, run so that the inside is to the left."""

    pieces: list[Piece]
    #: Writes the curve at height z.
    curve: Callable[[IgesModel, float], int]


def straight(start, end) -> Segment:
    return Segment([line_piece(start, end)], lambda model, z: model.line((*start, z), (*end, z)))


def outline(model: IgesModel, segments, z: float) -> int:
    """The curves as one boundary."""
    curves = [segment.curve(model, z) for segment in segments]
    return curves[0] if len(curves) == 1 else model.composite(curves)


def flat_face(model: IgesModel, segments, z: float, how: str = "144") -> None:
    """A plane face within the outline: trimmed (144), a bounded plane (108) or a bounded surface (143)."""
    area, centroid, box = outline_figures(segments)
    boundary = outline(model, segments, z)
    if how == "108":
        face = model.add(108, [0.0, 0.0, 1.0, z, boundary, 0.0, 0.0, z, 0.0], form=1)
    elif how == "143":
        face = model.bounded(model.flat((0.0, 0.0, z)), [[(boundary, 1, [])]])
    else:
        face = model.trimmed(model.plane((0.0, 0.0, z)), boundary)
    model.know(face, "plane", area, (*centroid, z), [[*box[0], z], [*box[1], z]])


def wall(model: IgesModel, segment: Segment, height: float) -> None:
    """A tabulated cylinder over one segment, untrimmed."""
    start = segment.pieces[0].at(np.array(segment.pieces[0].first))
    face = model.add(122, [segment.curve(model, 0.0), float(start[0]), float(start[1]), height])
    length = sum(piece.length() for piece in segment.pieces)
    x, y = sum(piece.length_moments() for piece in segment.pieces) / length
    boxes = np.array([piece.box() for piece in segment.pieces])
    low, high = boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0)
    box = [[*low, 0.0], [*high, height]]
    model.know(face, "extrusion", length * height, (float(x), float(y), height / 2), box)


def prism(name: str, segments, how: str = "144", height: float = HEIGHT):
    """Floor, lid and walls over an outline: faces that close."""
    model = IgesModel(name)
    flat_face(model, segments, 0.0, how)
    flat_face(model, segments, height, how)
    for segment in segments:
        wall(model, segment, height)
    return model, model.reference(volume=outline_figures(segments)[0] * height)


def sheet(name: str, segments, how: str = "144"):
    """One plane face."""
    model = IgesModel(name)
    flat_face(model, segments, 0.0, how)
    return model, model.reference()


@iges("curve_100_circle", "a whole circle (100, start and end the same) as the only boundary and directrix")
def circle():
    full = Segment(ellipse_pieces((5.0, 3.0), 8.0, 8.0, 0.0, 2 * pi), lambda model, z: model.circle((5.0, 3.0), 8.0, z))
    return prism("curve_100_circle", [full])


@iges("curve_100_arcs", "circular arcs of 240 and 90 degrees with lines; a concave arc runs clockwise by its matrix")
def arcs():
    def convex(model: IgesModel, z: float) -> int:
        return model.arc((0.0, 0.0), (10.0, 0.0), (-10.0, 0.0), z)

    def concave(model: IgesModel, z: float) -> int:
        # Half a turn about y: x and z change their signs.
        turn = model.matrix(((-1.0, 0.0, 0.0, 0.0), (0.0, 1.0, 0.0, 0.0), (0.0, 0.0, -1.0, 0.0)))
        return model.arc((0.0, 0.0), (4.0, 0.0), (-4.0, 0.0), -z, transformation=turn)

    segments = [
        Segment(ellipse_pieces((0.0, 0.0), 10.0, 10.0, 0.0, pi), convex),
        straight((-10.0, 0.0), (-4.0, 0.0)),
        Segment(ellipse_pieces((0.0, 0.0), 4.0, 4.0, pi, 0.0), concave),
        straight((4.0, 0.0), (10.0, 0.0)),
    ]
    return prism("curve_100_arcs", segments, "108")


@iges("curve_100_large_arc", "an arc of 300 degrees closed by a line, as a bounded surface")
def large_arc():
    a, b = pi / 3, 2 * pi
    start, end = (6 * cos(a), 6 * sin(a)), (6.0, 0.0)
    arc = Segment(ellipse_pieces((0.0, 0.0), 6.0, 6.0, a, b), lambda model, z: model.arc((0.0, 0.0), start, end, z))
    return prism("curve_100_large_arc", [arc, straight(end, start)], "143")


def conic(form: int, coefficients, start, end):
    return lambda model, z: model.add(
        104, [*map(float, coefficients), z, *map(float, start), *map(float, end)], form=form, status=PART
    )


@iges("curve_104_ellipse", "a whole ellipse, type 104 form 1")
def ellipse():
    full = Segment(
        ellipse_pieces((0.0, 0.0), 12.0, 5.0, 0.0, 2 * pi),
        conic(1, (1 / 144, 0, 1 / 25, 0, 0, -1), (12, 0), (12, 0)),
    )
    return prism("curve_104_ellipse", [full])


@iges("curve_104_ellipse_arc", "three quarters of an ellipse and two lines")
def ellipse_arc():
    arc = Segment(
        ellipse_pieces((0.0, 0.0), 12.0, 5.0, 0.0, 1.5 * pi),
        conic(1, (25, 0, 144, 0, 0, -3600), (12, 0), (0, -5)),
    )
    return prism("curve_104_ellipse_arc", [arc, straight((0.0, -5.0), (0.0, 0.0)), straight((0.0, 0.0), (12.0, 0.0))])


@iges("curve_104_ellipse_tilted", "half an ellipse whose axes are turned by 30 degrees: a conic with a B term")
def ellipse_tilted():
    c, s = cos(pi / 6), sin(pi / 6)
    a, b = 12.0, 5.0
    coefficients = (
        c * c / a**2 + s * s / b**2,
        2 * c * s * (1 / a**2 - 1 / b**2),
        s * s / a**2 + c * c / b**2,
        0,
        0,
        -1,
    )
    at = lambda t: (a * c * np.cos(t) - b * s * np.sin(t), a * s * np.cos(t) + b * c * np.sin(t))  # noqa: E731
    start, end = (a * c, a * s), (-a * c, -a * s)
    arc = Segment([Piece(at, 0.0, pi / 2), Piece(at, pi / 2, pi)], conic(1, coefficients, start, end))
    return prism("curve_104_ellipse_tilted", [arc, straight(end, start)])


@iges("curve_104_ellipse_off_centre", "a whole ellipse about a point that is not the origin: D and E terms")
def ellipse_off_centre():
    x0, y0, a, b = 20.0, -4.0, 6.0, 9.0
    coefficients = (
        1 / a**2,
        0,
        1 / b**2,
        -2 * x0 / a**2,
        -2 * y0 / b**2,
        x0**2 / a**2 + y0**2 / b**2 - 1,
    )
    full = Segment(ellipse_pieces((x0, y0), a, b, 0.0, 2 * pi), conic(1, coefficients, (x0 + a, y0), (x0 + a, y0)))
    return prism("curve_104_ellipse_off_centre", [full])


@iges(
    "curve_104_ellipse_in_space", "an ellipse turned and moved by a transformation as the rim of a slanting plane face"
)
def ellipse_in_space():
    model = IgesModel("curve_104_ellipse_in_space")
    c, s = cos(0.6), sin(0.6)
    rows = ((1.0, 0.0, 0.0, 5.0), (0.0, c, -s, 6.0), (0.0, s, c, 7.0))
    rim = model.add(
        104,
        [1 / 64, 0.0, 1 / 9, 0.0, 0.0, -1.0, 2.0, 8.0, 0.0, 8.0, 0.0],
        form=1,
        status=PART,
        transformation=model.matrix(rows),
    )
    centre = (5.0, 6.0 - 2 * s, 7.0 + 2 * c)
    face = model.trimmed(model.plane(centre, (0.0, -s, c)), rim)
    box = [[centre[k] + sign * (8.0, 3 * c, 3 * s)[k] for k in range(3)] for sign in (-1, 1)]
    model.know(face, "plane", 24 * pi, centre, box)
    return model, model.reference()


@iges("curve_104_hyperbola", "a hyperbola, type 104 form 2, closed by a chord")
def hyperbola():
    a, b, t = 4.0, 3.0, 1.4
    arc = Segment(
        [
            Piece(lambda s: (a * np.cosh(s), b * np.sinh(s)), t, 0.0),
            Piece(lambda s: (a * np.cosh(s), b * np.sinh(s)), 0.0, -t),
        ],
        conic(2, (1 / a**2, 0, -1 / b**2, 0, 0, -1), (a * cosh(t), b * sinh(t)), (a * cosh(t), -b * sinh(t))),
    )
    low, high = (a * cosh(t), -b * sinh(t)), (a * cosh(t), b * sinh(t))
    return prism("curve_104_hyperbola", [arc, straight(low, high)])


@iges("curve_104_hyperbola_upward", "the branch of a hyperbola that opens along y")
def hyperbola_upward():
    a, b, t = 4.0, 3.0, 1.4
    at = lambda s: (b * np.sinh(s), a * np.cosh(s))  # noqa: E731
    left, right = (-b * sinh(t), a * cosh(t)), (b * sinh(t), a * cosh(t))
    arc = Segment([Piece(at, -t, 0.0), Piece(at, 0.0, t)], conic(2, (-1 / b**2, 0, 1 / a**2, 0, 0, -1), left, right))
    return prism("curve_104_hyperbola_upward", [arc, straight(right, left)])


@iges("curve_104_parabola", "a parabola, type 104 form 3, closed by a chord")
def parabola():
    # y = x^2 / 16.
    arc = Segment([Piece(lambda t: (t, t * t / 16), -12.0, 8.0)], conic(3, (1, 0, 0, 0, -16, 0), (-12, 9), (8, 4)))
    return prism("curve_104_parabola", [arc, straight((8.0, 4.0), (-12.0, 9.0))])


@iges("curve_104_parabola_sideways", "a parabola that opens along -x")
def parabola_sideways():
    # x = -y^2 / 12.
    arc = Segment([Piece(lambda t: (-t * t / 12, t), -6.0, 6.0)], conic(3, (0, 0, 1, 12, 0, 0), (-3, -6), (-3, 6)))
    return prism("curve_104_parabola_sideways", [arc, straight((-3.0, 6.0), (-3.0, -6.0))])


def copious(form: int, points):
    """Type 106; form 11 and 63 in a plane, 12 in space, 13 with vectors."""

    def write(model: IgesModel, z: float) -> int:
        if form in (11, 63):
            values = [1, len(points), z, *(float(c) for point in points for c in point)]
        else:
            tail = (0.0, 0.0, 1.0) if form == 13 else ()
            values = [form - 10, len(points), *(float(c) for point in points for c in (*point, z, *tail))]
        return model.add(106, values, form=form, status=PART)

    return write


HOOK = [(0.0, 0.0), (20.0, 0.0), (20.0, 12.0), (14.0, 12.0), (14.0, 5.0), (0.0, 5.0)]


def sides(points) -> list[Piece]:
    return [line_piece(a, b) for a, b in zip(points, points[1:])]


for _form, _what in (
    (11, "a plane polyline that comes back to its start"),
    (12, "a polyline in space that comes back to its start"),
    (13, "a polyline in space with a vector at each point"),
    (63, "a simple closed plane curve"),
):

    @iges(f"curve_106_form_{_form}", f"{_what}, type 106 form {_form}, as boundary")
    def copious_boundary(form=_form):
        points = [*HOOK, HOOK[0]]
        return sheet(f"curve_106_form_{form}", [Segment(sides(points), copious(form, points))])


@iges("curve_106_in_composite", "a polyline (106 form 12) composed with an arc")
def copious_in_composite():
    points = [(10.0, 0.0), (12.0, -8.0), (-3.0, -9.0), (-10.0, 0.0)][::-1]
    arc = Segment(
        ellipse_pieces((0.0, 0.0), 10.0, 10.0, 0.0, pi),
        lambda model, z: model.arc((0.0, 0.0), (10.0, 0.0), (-10.0, 0.0), z),
    )
    return sheet("curve_106_in_composite", [arc, Segment(sides(points), copious(12, points))], "108")


@iges("curve_112_spline", "a parametric spline curve (112) of three cubic segments, in the plane and lifted by ZT")
def parametric_spline():
    knots = [0.0, 1.0, 3.0, 4.5]
    points = [(20.0, 0.0), (22.0, 12.0), (6.0, 14.0), (0.0, 0.0)]
    slopes = [(3.0, 8.0), (-4.0, 6.0), (-7.0, -3.0), (1.0, -9.0)]
    segments = []
    for k in range(3):
        h = knots[k + 1] - knots[k]
        rows = []
        for axis in range(2):
            p, q, m, n = points[k][axis], points[k + 1][axis], slopes[k][axis], slopes[k + 1][axis]
            rows.append((p, m, (3 * (q - p) / h - 2 * m - n) / h, (2 * (p - q) / h + m + n) / h**2))
        segments.append(rows)

    def piece(rows, h: float) -> Piece:
        at = lambda t: tuple(a + t * (b + t * (c + t * d)) for a, b, c, d in rows)  # noqa: E731
        return Piece(at, 0.0, h)

    def write(model: IgesModel, z: float) -> int:
        values = [3, 1, 3, 3, *knots]
        for rows in segments:
            values += [*rows[0], *rows[1], z, 0.0, 0.0, 0.0]
        last, h = segments[-1], knots[3] - knots[2]
        for a, b, c, d in last:
            # Value, first derivative, half the second, a sixth of the third at the end.
            values += [a + h * (b + h * (c + h * d)), b + h * (2 * c + 3 * h * d), c + 3 * h * d, d]
        return model.add(112, [*values, z, 0.0, 0.0, 0.0], status=PART)

    pieces = [piece(rows, b - a) for rows, a, b in zip(segments, knots, knots[1:])]
    return prism("curve_112_spline", [straight((0.0, 0.0), (20.0, 0.0)), Segment(pieces, write)])


def spline_segment(spline: Spline, part=None, **options) -> Segment:
    """A B-spline or a part of it; its poles have two coordinates."""
    low, high = part or spline.domain()
    breaks = [low, *(b for b in spline.breaks() if low < b < high), high]
    at = spline.pieces()[0].at

    def write(model: IgesModel, z: float) -> int:
        lifted = Spline(spline.degree, [(*pole, z) for pole in spline.poles], spline.knots, spline.weights)
        return model.spline(lifted, part=part, **options)

    return Segment([Piece(at, a, b) for a, b in zip(breaks, breaks[1:])], write)


@iges("curve_126_degrees", "an outline of five B-splines (126) of degree 1, 2, 3, 4 and 5")
def spline_degrees():
    corners = [(20 * cos(2 * pi * k / 5), 20 * sin(2 * pi * k / 5)) for k in range(5)]
    segments = []
    for degree in range(1, 6):
        a, b = np.array(corners[degree - 1]), np.array(corners[degree % 5])
        out = np.array([(b - a)[1], -(b - a)[0]]) / hypot(*(b - a))
        count = degree + 3
        poles = [
            tuple(
                float(c) for c in a + k / (count - 1) * (b - a) + out * (2.5 if 0 < k < count - 1 else 0.0) * (-1) ** k
            )
            for k in range(count)
        ]
        segments.append(spline_segment(Spline(degree, poles, quasi_uniform_knots(count, degree))))
    return prism("curve_126_degrees", segments)


def circle_spline(radius: float) -> Spline:
    w = sqrt(0.5)
    ring = [(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1), (1, 0)]
    knots = [0.0] * 3 + [0.25] * 2 + [0.5] * 2 + [0.75] * 2 + [1.0] * 3
    return Spline(2, [(radius * x, radius * y) for x, y in ring], knots, [1.0, w] * 4 + [1.0])


@iges("curve_126_rational_circle", "a whole circle as one rational B-spline of nine poles, closed")
def rational_circle():
    return prism("curve_126_rational_circle", [spline_segment(circle_spline(9.0), closed=True)])


@iges("curve_126_rational_weights", "a rational B-spline of degree 3 with uneven weights")
def rational_weights():
    poles = [(20.0, 0.0), (26.0, 10.0), (10.0, 22.0), (3.0, 6.0), (-6.0, 8.0), (0.0, 0.0)]
    spline = Spline(3, poles, [0.0] * 4 + [1.0, 1.5] + [4.0] * 4, [1.0, 0.4, 3.0, 1.2, 0.7, 2.0])
    return prism("curve_126_rational_weights", [straight((0.0, 0.0), (20.0, 0.0)), spline_segment(spline)])


@iges("curve_126_part_of_domain", "B-splines of which only a part of the knots' range is used (V0 and V1 within)")
def part_of_domain():
    poles = [(24.0, -6.0), (28.0, 8.0), (14.0, 18.0), (6.0, 4.0), (-4.0, 12.0), (-8.0, -3.0), (3.0, -9.0)]
    spline = Spline(3, poles, quasi_uniform_knots(7, 3))
    first = spline_segment(spline, (0.6, 3.25))
    ends = [tuple(map(float, spline.point(t))) for t in (3.25, 0.6)]
    return prism("curve_126_part_of_domain", [first, straight(*ends)], "108")


@iges(
    "curve_126_closed_uniform", "a closed cubic B-spline over uniform knots: its first and last knots are not repeated"
)
def closed_uniform():
    ring = [(12 * cos(2 * pi * k / 7) * (1.0 + 0.25 * (k % 2)), 9 * sin(2 * pi * k / 7)) for k in range(7)]
    spline = Spline(3, [*ring, *ring[:3]], uniform_knots(10, 3))
    return prism("curve_126_closed_uniform", [spline_segment(spline, closed=True, periodic=True)])


@iges("curve_126_crease", "a B-spline of degree 2 with a double knot: a corner within one edge")
def crease():
    poles = [(20.0, 0.0), (22.0, 9.0), (12.0, 10.0), (10.0, 4.0), (0.0, 0.0)]
    spline = Spline(2, poles, [0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 2.0])
    return prism("curve_126_crease", [straight((0.0, 0.0), (20.0, 0.0)), spline_segment(spline)])


def offset(base: Callable[[IgesModel, float], int], distance: float, first: float, last: float):
    """Type 130 at a constant distance, about z."""

    def write(model: IgesModel, z: float) -> int:
        curve = base(model, z)
        values = [curve, 1, 0, 0, 0, distance, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, first, last]
        return model.add(130, values, status=PART)

    return write


@iges("curve_130_of_circle", "a circle of radius 7 as the offset (130) by 3 of one of radius 10")
def offset_circle():
    base = lambda model, z: model.circle((2.0, 1.0), 10.0, z)  # noqa: E731
    full = Segment(ellipse_pieces((2.0, 1.0), 7.0, 7.0, 0.0, 2 * pi), offset(base, 3.0, 0.0, 2 * pi))
    return prism("curve_130_of_circle", [full])


@iges("curve_130_of_lines_and_arc", "offsets of two lines and an arc, outward by a negative distance")
def offset_lines():
    # A half disk of radius 10 above y = 0 is grown by 2 on its curved side and below.
    arc_base = lambda model, z: model.arc((0.0, 0.0), (10.0, 0.0), (-10.0, 0.0), z)  # noqa: E731
    line_base = lambda model, z: model.line((-12.0, 0.0, z), (12.0, 0.0, z))  # noqa: E731
    segments = [
        Segment(ellipse_pieces((0.0, 0.0), 12.0, 12.0, 0.0, pi), offset(arc_base, -2.0, 0.0, pi)),
        straight((-12.0, 0.0), (-12.0, -2.0)),
        Segment([line_piece((-12.0, -2.0), (12.0, -2.0))], offset(line_base, -2.0, 0.0, 1.0)),
        straight((12.0, -2.0), (12.0, 0.0)),
    ]
    return prism("curve_130_of_lines_and_arc", segments)


@iges(
    "curve_102_matrix_on_composite",
    "a composite curve that has a transformation of its own, around parts that have theirs",
)
def matrix_on_composite():
    model = IgesModel("curve_102_matrix_on_composite")
    turn = ((0.0, -1.0, 0.0, 5.0), (1.0, 0.0, 0.0, 0.0), (0.0, 0.0, 1.0, 4.0))
    lines = [
        model.line((0.0, 0.0, 0.0), (20.0, 0.0, 0.0)),
        model.line((20.0, 0.0, 0.0), (20.0, 10.0, 0.0)),
        # These two stand elsewhere and are moved here first.
        model.line((0.0, 0.0, 0.0), (-20.0, 0.0, 0.0), transformation=model.matrix(shift(20, 10, 0))),
        model.line((20.0, 0.0, 0.0), (20.0, -10.0, 0.0), transformation=model.matrix(shift(-20, 10, 0))),
    ]
    boundary = model.composite(lines, transformation=model.matrix(turn))
    face = model.trimmed(model.plane((0.0, 0.0, 4.0)), boundary)
    model.know(face, "plane", 200.0, (0.0, 10.0, 4.0), [[-5.0, 0.0, 4.0], [5.0, 20.0, 4.0]])
    return model, model.reference()
