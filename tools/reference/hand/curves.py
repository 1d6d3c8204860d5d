"""Every kind of curve as an edge: in the planes of a prism, and as the base of its wall."""

from math import pi, sqrt

import numpy as np

from catalogue import hand
from part21 import FALSE, TRUE, UNKNOWN, Enum, Ref, Typed
from plane_curves import (
    Piece,
    Spline,
    bezier_knots,
    ellipse_pieces,
    hyperbola_piece,
    line_piece,
    parabola_piece,
    quasi_uniform_knots,
    uniform_knots,
)
from prism import Segment, prism, sheet, straight
from step_model import ORIGIN, X, Z, StepModel

UNSPECIFIED = Enum("UNSPECIFIED")
PARAMETER, CARTESIAN = Enum("PARAMETER"), Enum("CARTESIAN")


def at(value: float) -> Typed:
    return Typed("PARAMETER_VALUE", float(value))


def half_moon(name: str, curve, *, radius: float = 10.0, forward: bool = True, build=prism):
    """A half disc above its diameter, the arc written by `curve(model, z)`."""
    model = StepModel()
    arc = Segment((radius, 0.0), (-radius, 0.0), ellipse_pieces((0, 0), radius, radius, 0.0, pi), curve, forward)
    segments = [arc, straight((-radius, 0.0), (radius, 0.0))]
    return model, build(model, name, segments, 8.0) if build is prism else build(model, name, segments)


def circle(model: StepModel, z: float, radius: float = 10.0) -> Ref:
    return model.circle((0.0, 0.0, z), Z, X, radius)


@hand("curve_circle", "a half disc: an arc given by a whole circle and two vertices")
def curve_circle():
    return half_moon("curve_circle", circle)


@hand("curve_circle_reversed", "the arc's edge runs against its circle (same_sense .F.)")
def curve_circle_reversed():
    def clockwise(model, z):
        return model.circle((0.0, 0.0, z), (0.0, 0.0, -1.0), X, 10.0)

    return half_moon("curve_circle_reversed", clockwise, forward=False)


@hand("curve_trimmed_by_parameter", "TRIMMED_CURVE over a circle, trimmed by parameters")
def curve_trimmed_by_parameter():
    def trimmed(model, z):
        return model.add("TRIMMED_CURVE", "", circle(model, z), [at(0.0)], [at(pi)], TRUE, PARAMETER)

    return half_moon("curve_trimmed_by_parameter", trimmed)


@hand("curve_trimmed_by_point", "TRIMMED_CURVE over a circle, trimmed by points, with parameters beside them")
def curve_trimmed_by_point():
    def trimmed(model, z):
        start, end = model.point((10.0, 0.0, z)), model.point((-10.0, 0.0, z))
        return model.add("TRIMMED_CURVE", "", circle(model, z), [start, at(0.0)], [end, at(pi)], TRUE, CARTESIAN)

    return half_moon("curve_trimmed_by_point", trimmed)


@hand("curve_trimmed_backward", "TRIMMED_CURVE with sense_agreement .F.: it runs from 0 down to -pi, the lower half")
def curve_trimmed_backward():
    # The circle turns about -z, so that its parameter falls where the outline advances.
    def trimmed(model, z):
        base = model.circle((0.0, 0.0, z), (0.0, 0.0, -1.0), X, 10.0)
        return model.add("TRIMMED_CURVE", "", base, [at(2 * pi)], [at(pi)], FALSE, PARAMETER)

    return half_moon("curve_trimmed_backward", trimmed)


@hand("curve_trimmed_in_degrees", "TRIMMED_CURVE whose parameters are degrees, for that is the file's unit")
def curve_trimmed_in_degrees():
    model = StepModel()
    context = model.context(angle=model.degree())
    model._cache["context"] = context

    def trimmed(model, z):
        return model.add("TRIMMED_CURVE", "", circle(model, z), [at(0.0)], [at(180.0)], TRUE, PARAMETER)

    arc = Segment((10.0, 0.0), (-10.0, 0.0), ellipse_pieces((0, 0), 10.0, 10.0, 0.0, pi), trimmed)
    return model, prism(model, "curve_trimmed_in_degrees", [arc, straight((-10.0, 0.0), (10.0, 0.0))], 8.0)


@hand("curve_ellipse", "an arc of an ellipse")
def curve_ellipse():
    model = StepModel()
    arc = Segment(
        (12.0, 0.0),
        (-12.0, 0.0),
        ellipse_pieces((0, 0), 12.0, 5.0, 0.0, pi),
        lambda model, z: model.add("ELLIPSE", "", model.axis2((0.0, 0.0, z)), 12.0, 5.0),
    )
    return model, prism(model, "curve_ellipse", [arc, straight((-12.0, 0.0), (12.0, 0.0))], 8.0)


@hand("curve_parabola", "an arc of a parabola: x = f t^2, y = 2 f t")
def curve_parabola():
    model = StepModel()
    arc = Segment(
        (12.0, -12.0),
        (12.0, 12.0),
        [parabola_piece(3.0, -2.0, 2.0)],
        lambda model, z: model.add("PARABOLA", "", model.axis2((0.0, 0.0, z)), 3.0),
        forward=True,
    )
    # The inside of the parabola lies to the right of the direction of growing t.
    arc = Segment(arc.end, arc.start, [parabola_piece(3.0, 2.0, -2.0)], arc.curve, forward=False)
    return model, prism(model, "curve_parabola", [arc, straight((12.0, -12.0), (12.0, 12.0))], 8.0)


@hand("curve_hyperbola", "an arc of a hyperbola: x = a cosh t, y = b sinh t")
def curve_hyperbola():
    model = StepModel()
    t = 1.25
    top = (4.0 * float(np.cosh(t)), 3.0 * float(np.sinh(t)))
    bottom = (top[0], -top[1])
    arc = Segment(
        top,
        bottom,
        [hyperbola_piece(4.0, 3.0, t, -t)],
        lambda model, z: model.add("HYPERBOLA", "", model.axis2((0.0, 0.0, z)), 4.0, 3.0),
        forward=False,
    )
    return model, prism(model, "curve_hyperbola", [arc, straight(bottom, top)], 8.0)


ZIGZAG = [(20.0, 0.0), (16.0, 9.0), (10.0, 4.0), (5.0, 12.0), (0.0, 0.0)]


def polyline(points):
    return lambda model, z: model.add("POLYLINE", "", [model.point((*p, z)) for p in points])


@hand("curve_polyline", "an edge that is a POLYLINE of four spans, in a plane")
def curve_polyline():
    model = StepModel()
    pieces = [line_piece(a, b) for a, b in zip(ZIGZAG, ZIGZAG[1:])]
    edge = Segment(ZIGZAG[0], ZIGZAG[-1], pieces, polyline(ZIGZAG))
    return model, sheet(model, "curve_polyline", [edge, straight((0.0, 0.0), (20.0, 0.0))])


@hand("curve_polyline_extruded", "a prism over a POLYLINE: its wall is one surface with creases")
def curve_polyline_extruded():
    model = StepModel()
    pieces = [line_piece(a, b) for a, b in zip(ZIGZAG, ZIGZAG[1:])]
    edge = Segment(ZIGZAG[0], ZIGZAG[-1], pieces, polyline(ZIGZAG))
    return model, prism(model, "curve_polyline_extruded", [edge, straight((0.0, 0.0), (20.0, 0.0))], 6.0)


@hand("curve_polyline_closed", "a face within one closed POLYLINE edge")
def curve_polyline_closed():
    model = StepModel()
    points = [*ZIGZAG[:-1], (2.0, -3.0), ZIGZAG[0]]
    pieces = [line_piece(a, b) for a, b in zip(points, points[1:])]
    return model, sheet(model, "curve_polyline_closed", [Segment(points[0], points[0], pieces, polyline(points))])


def composite(model: StepModel, z: float) -> Ref:
    """Line, arc and line; the arc's own curve runs backward."""
    line = lambda a, b: model.add(  # noqa: E731
        "TRIMMED_CURVE",
        "",
        model.line((*a, z), (*b, z)),
        [model.point((*a, z))],
        [model.point((*b, z))],
        TRUE,
        CARTESIAN,
    )
    arc = model.add(
        "TRIMMED_CURVE",
        "",
        model.circle((0.0, 5.0, z), (0.0, 0.0, -1.0), X, 10.0),
        [at(pi)],
        [at(2 * pi)],
        TRUE,
        PARAMETER,
    )
    segment = lambda curve, sense: model.add(  # noqa: E731
        "COMPOSITE_CURVE_SEGMENT", Enum("CONTINUOUS"), Enum("T" if sense else "F"), curve
    )
    segments = [
        segment(line((10.0, 0.0), (10.0, 5.0)), True),
        segment(arc, False),
        segment(line((-10.0, 5.0), (-10.0, 0.0)), True),
    ]
    return model.add("COMPOSITE_CURVE", "", segments, FALSE)


def composite_segment(curve) -> list[Segment]:
    pieces = [line_piece((10, 0), (10, 5)), *ellipse_pieces((0, 5), 10, 10, 0.0, pi), line_piece((-10, 5), (-10, 0))]
    return [Segment((10.0, 0.0), (-10.0, 0.0), pieces, curve), straight((-10.0, 0.0), (10.0, 0.0))]


@hand("curve_composite", "an edge that is a COMPOSITE_CURVE of line, reversed arc, line")
def curve_composite():
    model = StepModel()
    return model, sheet(model, "curve_composite", composite_segment(composite))


@hand("curve_composite_extruded", "a wall over a COMPOSITE_CURVE")
def curve_composite_extruded():
    model = StepModel()
    return model, prism(model, "curve_composite_extruded", composite_segment(composite), 6.0)


@hand("curve_offset", "OFFSET_CURVE_3D over a circle: again a circle")
def curve_offset():
    # ISO 10303-42: the offset is along ref_direction x tangent, here outward.
    def outer(model, z):
        return model.add("OFFSET_CURVE_3D", "", circle(model, z, 7.0), 3.0, FALSE, model.direction((0.0, 0.0, -1.0)))

    return half_moon("curve_offset", outer)


def ellipse_offset(a: float, b: float, distance: float, first: float, last: float) -> list[Piece]:
    """Parallel to an ellipse, on its outer side."""

    def point(t):
        speed = np.sqrt((a * np.sin(t)) ** 2 + (b * np.cos(t)) ** 2)
        return a * np.cos(t) + distance * b * np.cos(t) / speed, b * np.sin(t) + distance * a * np.sin(t) / speed

    bounds = np.linspace(first, last, 17)
    return [Piece(point, float(p), float(q)) for p, q in zip(bounds, bounds[1:])]


@hand("curve_offset_ellipse", "OFFSET_CURVE_3D over an ellipse: no conic any more")
def curve_offset_ellipse():
    model = StepModel()

    def outer(model, z):
        base = model.add("ELLIPSE", "", model.axis2((0.0, 0.0, z)), 12.0, 5.0)
        return model.add("OFFSET_CURVE_3D", "", base, 2.0, FALSE, model.direction((0.0, 0.0, -1.0)))

    arc = Segment((14.0, 0.0), (-14.0, 0.0), ellipse_offset(12.0, 5.0, 2.0, 0.0, pi), outer)
    return model, prism(model, "curve_offset_ellipse", [arc, straight((-14.0, 0.0), (14.0, 0.0))], 8.0)


POLES = [(20.0, 0.0), (22.0, 9.0), (14.0, 14.0), (9.0, 6.0), (3.0, 13.0), (-2.0, 7.0), (0.0, 0.0)]
WEIGHTS = [1.0, 2.0, 0.5, 1.0, 3.0, 1.5, 1.0]


def multiplicities(knots) -> tuple[list[int], list[float]]:
    values = sorted(set(knots))
    return [knots.count(value) for value in values], values


def spline_writer(spline: Spline, form: str):
    """Writes a B-spline at height z in one of its forms: the subtype's name, or WITH_KNOTS."""

    def write(model: StepModel, z: float) -> Ref:
        poles = [model.point((*map(float, p), z)) for p in spline.poles]
        counts, values = multiplicities(spline.knots)
        base = (spline.degree, poles, UNSPECIFIED, FALSE, UNKNOWN)
        if spline.weights is None:
            if form == "WITH_KNOTS":
                return model.add("B_SPLINE_CURVE_WITH_KNOTS", "", *base, counts, values, UNSPECIFIED)
            return model.add(form, "", *base)
        parts: dict = {"BOUNDED_CURVE": (), "B_SPLINE_CURVE": base}
        if form == "WITH_KNOTS":
            parts["B_SPLINE_CURVE_WITH_KNOTS"] = (counts, values, UNSPECIFIED)
        else:
            parts[form] = ()
        parts |= {"CURVE": (), "GEOMETRIC_REPRESENTATION_ITEM": (), "RATIONAL_B_SPLINE_CURVE": (spline.weights,)}
        parts["REPRESENTATION_ITEM"] = ("",)
        return model.add_complex(**dict(sorted(parts.items())))

    return write


def spline_prism(name: str, spline: Spline, form: str):
    """A prism over a spline and the line between its ends."""
    model = StepModel()
    low, high = spline.domain()
    start, end = (tuple(map(float, spline.point(t)[:2])) for t in (low, high))
    arc = Segment(start, end, spline.pieces(), spline_writer(spline, form))
    return model, prism(model, name, [arc, straight(end, start)], 5.0)


KNOTS = {
    "WITH_KNOTS": (3, [0.0] * 4 + [0.2, 0.25, 0.9] + [1.0] * 4),
    "UNIFORM_CURVE": (3, uniform_knots(7, 3)),
    "QUASI_UNIFORM_CURVE": (3, quasi_uniform_knots(7, 3)),
    "BEZIER_CURVE": (3, bezier_knots(7, 3)),
}

for _form, (_degree, _knots) in KNOTS.items():
    _word = {"WITH_KNOTS": "bspline"}.get(_form, _form.lower().removesuffix("_curve"))

    @hand(f"curve_{_word}", f"{'B_SPLINE_CURVE_WITH_KNOTS' if _form == 'WITH_KNOTS' else _form} as an edge")
    def plain(form=_form, degree=_degree, knots=_knots, word=_word):
        return spline_prism(f"curve_{word}", Spline(degree, POLES, knots), form)

    @hand(f"curve_{_word}_rational", f"the same as a complex instance with RATIONAL_B_SPLINE_CURVE ({_form})")
    def rational(form=_form, degree=_degree, knots=_knots, word=_word):
        return spline_prism(f"curve_{word}_rational", Spline(degree, POLES, knots, WEIGHTS), form)


@hand("curve_bezier_degree_6", "a BEZIER_CURVE of one span and degree 6")
def curve_bezier_degree_6():
    return spline_prism("curve_bezier_degree_6", Spline(6, POLES, bezier_knots(7, 6)), "BEZIER_CURVE")


@hand("curve_bspline_closed", "an outline that is one closed B-spline edge")
def curve_bspline_closed():
    model = StepModel()
    poles = [*POLES, (8.0, -6.0), POLES[0]]
    spline = Spline(3, poles, quasi_uniform_knots(9, 3))
    edge = Segment(POLES[0], POLES[0], spline.pieces(), spline_writer(spline, "WITH_KNOTS"))
    return model, sheet(model, "curve_bspline_closed", [edge])


@hand("curve_bspline_part", "an edge over a part of its B-spline: the vertices lie inside the curve")
def curve_bspline_part():
    model = StepModel()
    spline = Spline(3, POLES, quasi_uniform_knots(7, 3))
    first, last = 0.6, 3.3
    start, end = (tuple(map(float, spline.point(t)[:2])) for t in (first, last))
    breaks = [first, *(k for k in spline.breaks() if first < k < last), last]
    whole = spline.pieces()[0].at
    pieces = [Piece(whole, a, b) for a, b in zip(breaks, breaks[1:])]
    arc = Segment(start, end, pieces, spline_writer(spline, "QUASI_UNIFORM_CURVE"))
    # Straight back, the outline would cross itself.
    below = [end, (end[0], -5.0), (start[0], -5.0), start]
    sides = [straight(a, b) for a, b in zip(below, below[1:])]
    return model, prism(model, "curve_bspline_part", [arc, *sides], 5.0)


def cylinder_faces(model: StepModel, rim, seam=None):
    """A cylinder of radius 10 and height 30 whose circles are written by `rim(surface, circle, z)`."""
    wall_surface = model.cylinder(10.0)
    edges = []
    for z in (0.0, 30.0):
        curve = rim(wall_surface, circle(model, z), z)
        edges.append(model.edge((10.0, 0.0, z), (10.0, 0.0, z), curve))
    line = model.line((10.0, 0.0, 0.0), (10.0, 0.0, 30.0))
    up = model.edge((10.0, 0.0, 0.0), (10.0, 0.0, 30.0), seam(wall_surface, line) if seam else line)
    low, high = edges
    wall = model.face(
        wall_surface,
        [model.loop(low, up, (high, False), (up, False))],
        kind="cylinder",
        area=600 * pi,
        centroid=(0.0, 0.0, 15.0),
    )
    floor = model.face(
        model.plane(axis=(0.0, 0.0, -1.0)), [model.loop((low, False))], kind="plane", area=100 * pi, centroid=ORIGIN
    )
    lid = model.face(
        model.plane((0.0, 0.0, 30.0)), [model.loop(high)], kind="plane", area=100 * pi, centroid=(0.0, 0.0, 30.0)
    )
    return [wall, floor, lid]


CYLINDER = {"volume": 3000 * pi, "bbox": [[-10.0, -10.0, 0.0], [10.0, 10.0, 30.0]]}


@hand("curve_surface_and_seam", "SURFACE_CURVE with one pcurve, SEAM_CURVE with two")
def curve_surface_and_seam():
    model = StepModel()

    def rim(surface, curve, z):
        pcurve = model.pcurve(surface, model.line_2d((0.0, z), (2 * pi, z)))
        return model.add("SURFACE_CURVE", "", curve, [pcurve], Enum("PCURVE_S1"))

    def seam(surface, line):
        sides = [model.pcurve(surface, model.line_2d((u, 0.0), (u, 30.0))) for u in (0.0, 2 * pi)]
        return model.add("SEAM_CURVE", "", line, sides, Enum("CURVE_3D"))

    model.product("curve_surface_and_seam", [model.solid(cylinder_faces(model, rim, seam))])
    return model, model.reference(**CYLINDER)


@hand("curve_intersection", "INTERSECTION_CURVE that names its two surfaces instead of pcurves")
def curve_intersection():
    model = StepModel()

    def rim(surface, curve, z):
        return model.add("INTERSECTION_CURVE", "", curve, [surface, model.plane((0.0, 0.0, z))], Enum("CURVE_3D"))

    model.product("curve_intersection", [model.solid(cylinder_faces(model, rim))])
    return model, model.reference(**CYLINDER)


@hand("curve_pcurve_only", "edges whose only geometry is a PCURVE on the cylinder")
def curve_pcurve_only():
    model = StepModel()

    def rim(surface, _, z):
        return model.pcurve(surface, model.line_2d((0.0, z), (2 * pi, z)))

    model.product("curve_pcurve_only", [model.solid(cylinder_faces(model, rim, lambda s, _: rim_up(model, s)))])
    return model, model.reference(**CYLINDER)


def rim_up(model: StepModel, surface: Ref) -> Ref:
    return model.pcurve(surface, model.line_2d((0.0, 0.0), (0.0, 30.0)))


@hand("curve_wrong_pcurve", "SURFACE_CURVEs whose pcurves lie elsewhere: the curve in space is what counts")
def curve_wrong_pcurve():
    model = StepModel()

    def rim(surface, curve, z):
        pcurve = model.pcurve(surface, model.line_2d((0.3, z + 2.0), (5.0, z - 3.0)))
        return model.add("SURFACE_CURVE", "", curve, [pcurve], Enum("CURVE_3D"))

    model.product("curve_wrong_pcurve", [model.solid(cylinder_faces(model, rim))])
    return model, model.reference(**CYLINDER)


@hand("curve_long_line_vector", "lines whose vectors are not of length one, circles about tilted axes")
def curve_long_line_vector():
    model = StepModel()
    points = [(0.0, 0.0, 0.0), (30.0, 0.0, 0.0), (30.0, 20.0, 0.0), (0.0, 20.0, 0.0)]
    edges = []
    for a, b in zip(points, points[1:] + points[:1]):
        vector = model.add("VECTOR", "", model.direction(tuple(5 * (q - p) for p, q in zip(a, b))), 0.02)
        edges.append(model.edge(a, b, model.add("LINE", "", model.point(a), vector)))
    hole = model.circle((15.0, 10.0, 0.0), (0.0, 0.0, 3.0), (2.0, 1.0, 0.0), 4.0)
    start = (15.0 + 8 / sqrt(5), 10.0 + 4 / sqrt(5), 0.0)
    ring = model.edge(start, start, hole)
    face = model.face(
        model.plane(),
        [model.loop(*edges), model.loop((ring, False))],
        kind="plane",
        area=600 - 16 * pi,
        centroid=(15.0, 10.0, 0.0),
    )
    body = model.add("SHELL_BASED_SURFACE_MODEL", "", [model.add("OPEN_SHELL", "", [face])])
    model.product("curve_long_line_vector", [body], representation="MANIFOLD_SURFACE_SHAPE_REPRESENTATION")
    return model, model.reference(bbox=[[0.0] * 3, [30.0, 20.0, 0.0]], closed=False)
