"""Files with the small lies that real exporters tell: each with the reference of the shape that is meant.

`sloppy_mm` in the reference says by how much the file's own geometry disagrees with itself.
"""

from __future__ import annotations

import random
from math import cos, pi, sin, sqrt

from catalogue import hand as register
from hand.curves import POLES, at, circle, half_moon, spline_writer
from hand.topology import box_polygons
from part21 import FALSE, TRUE, UNKNOWN, Enum, Ref
from plane_curves import Spline, bezier_knots, quasi_uniform_knots
from prism import Segment, outline_figures, straight
from step_model import ORIGIN, X, Z, FaceFigures, StepModel, plus, polygon_figures, times, unit

BOX = [[0.0, 0.0, 0.0], [30.0, 20.0, 10.0]]
CYLINDER = {"volume": 3000 * pi, "bbox": [[-10.0, -10.0, 0.0], [10.0, 10.0, 30.0]]}


def sloppy(name: str, shows: str):
    return register(name, shows, folder="sloppy")


def box_reference(model: StepModel, sloppy_mm: float = 0.0, **more) -> dict:
    return model.reference(volume=6000.0, bbox=BOX, sloppy_mm=sloppy_mm, **more)


def side_plane(model: StepModel, side) -> Ref:
    _, normal, _ = polygon_figures(side)
    return model.plane(side[0], normal, unit(plus(side[1], times(-1.0, side[0]))))


def side_face(
    model: StepModel, side, loop: Ref, *, same_sense: bool = True, bound: bool = True, surface: Ref | None = None
) -> Ref:
    """A side of the box over any loop, recorded with the figures of the side that is meant."""
    area, _, centroid = polygon_figures(side)
    surface = surface or side_plane(model, side)
    outer = model.add("FACE_OUTER_BOUND", "", loop, TRUE if bound else FALSE)
    face = model.add("ADVANCED_FACE", "", [outer], surface, TRUE if same_sense else FALSE)
    model.faces.append(FaceFigures(face, "plane", area, centroid))
    return face


def finish(model: StepModel, name: str, faces) -> None:
    model.product(name, [model.solid(faces)])


@sloppy("vertices_off_edges", "the vertices stand up to 0.02 mm beside the lines that should meet in them")
def vertices_off_edges():
    model, chance = StepModel(), random.Random(1)
    moved: dict = {}
    edges: dict = {}

    def vertex(p) -> Ref:
        if p not in moved:
            shift = tuple(chance.uniform(-0.02, 0.02) for _ in range(3))
            moved[p] = model.add("VERTEX_POINT", "", model.add("CARTESIAN_POINT", "", plus(p, shift)))
        return moved[p]

    def use(a, b):
        if (b, a) in edges:
            return edges[b, a], False
        edges[a, b] = model.add("EDGE_CURVE", "", vertex(a), vertex(b), model.line(a, b), TRUE)
        return edges[a, b], True

    faces = []
    for side in box_polygons(*BOX):
        faces.append(side_face(model, side, model.loop(*(use(a, b) for a, b in zip(side, side[1:] + side[:1])))))
    finish(model, "vertices_off_edges", faces)
    return model, box_reference(model, 0.02)


@sloppy("edges_off_surfaces", "a cylinder of radius 10 between circles of radius 10.02")
def edges_off_surfaces():
    model = StepModel()
    low, high = model.ring(ORIGIN, Z, X, 10.02), model.ring((0.0, 0.0, 30.0), Z, X, 10.02)
    seam = model.straight((10.02, 0.0, 0.0), (10.02, 0.0, 30.0))[0]
    finish(model, "edges_off_surfaces", cylinder(model, model.loop(low, seam, (high, False), (seam, False)), low, high))
    return model, model.reference(**CYLINDER, sloppy_mm=0.02)


def cylinder(model: StepModel, loop: Ref, low: Ref, high: Ref) -> list[Ref]:
    wall = model.face(model.cylinder(10.0), [loop], kind="cylinder", area=600 * pi, centroid=(0.0, 0.0, 15.0))
    floor = model.face(
        model.plane(axis=(0.0, 0.0, -1.0)), [model.loop((low, False))], kind="plane", area=100 * pi, centroid=ORIGIN
    )
    lid = model.face(
        model.plane((0.0, 0.0, 30.0)), [model.loop(high)], kind="plane", area=100 * pi, centroid=(0.0, 0.0, 30.0)
    )
    return [wall, floor, lid]


@sloppy("seam_off", "a cylinder whose seam line stands 0.01 mm off the surface and ends 0.01 mm off the circles")
def seam_off():
    model = StepModel()
    low, high = model.ring(ORIGIN, Z, X, 10.0), model.ring((0.0, 0.0, 30.0), Z, X, 10.0)
    line = model.line((10.01, 0.0, 0.01), (10.01, 0.0, 29.99))
    seam = model.edge((10.0, 0.0, 0.0), (10.0, 0.0, 30.0), line)
    finish(model, "seam_off", cylinder(model, model.loop(low, seam, (high, False), (seam, False)), low, high))
    return model, model.reference(**CYLINDER, sloppy_mm=0.0142)


@sloppy("gaps_in_loops", "every edge has vertices of its own; the ends of neighbours are up to 0.01 mm apart")
def gaps_in_loops():
    model, chance = StepModel(), random.Random(2)
    faces = []
    for side in box_polygons(*BOX):
        uses = []
        for a, b in zip(side, side[1:] + side[:1]):
            ends = [plus(p, tuple(chance.uniform(-0.003, 0.003) for _ in range(3))) for p in (a, b)]
            vertices = [model.add("VERTEX_POINT", "", model.add("CARTESIAN_POINT", "", p)) for p in ends]
            uses.append(model.add("EDGE_CURVE", "", *vertices, model.line(*ends), TRUE))
        faces.append(side_face(model, side, model.loop(*uses)))
    finish(model, "gaps_in_loops", faces)
    return model, box_reference(model, 0.01, closed=False)


@sloppy("edges_not_shared", "every face has edges and vertices of its own, at exactly the same places")
def edges_not_shared():
    model = StepModel()
    faces = []
    for side in box_polygons(*BOX):
        vertices = [model.add("VERTEX_POINT", "", model.point(p)) for p in side]
        pairs = zip(vertices, vertices[1:] + vertices[:1], side, side[1:] + side[:1])
        uses = [model.add("EDGE_CURVE", "", v, w, model.line(a, b), TRUE) for v, w, a, b in pairs]
        faces.append(side_face(model, side, model.loop(*uses)))
    finish(model, "edges_not_shared", faces)
    return model, box_reference(model)


@sloppy("edge_sense_wrong_on_lines", "lines whose edges claim to run against them, though they do not")
def edge_sense_wrong_on_lines():
    model = StepModel()
    finish(model, "edge_sense_wrong_on_lines", model.box_faces(*BOX))
    for k, line in enumerate(model.lines):
        if "=EDGE_CURVE(" in line and k % 2:
            model.lines[k] = line.replace(".T.", ".F.")
    return model, box_reference(model)


@sloppy("edge_sense_wrong_on_splines", "B-spline edges with the wrong same_sense: the ends tell the direction")
def edge_sense_wrong_on_splines():
    model = StepModel()
    spline = Spline(3, POLES, quasi_uniform_knots(7, 3))
    arc = Segment(POLES[0], POLES[-1], spline.pieces(), spline_writer(spline, "QUASI_UNIFORM_CURVE"))
    segments = [arc, straight(POLES[-1], POLES[0])]
    area, centroid, box = outline_figures(segments)
    edges = [model.edge((*s.start, 0.0), (*s.end, 0.0), s.curve(model, 0.0), False) for s in segments]
    face = model.face(model.plane(), [model.loop(*edges)], kind="plane", area=area, centroid=(*centroid, 0.0))
    sheet(model, "edge_sense_wrong_on_splines", [face])
    bbox = [[*map(float, box[0]), 0.0], [*map(float, box[1]), 0.0]]
    return model, model.reference(bbox=bbox, closed=False, sloppy_mm=0.0)


def sheet(model: StepModel, name: str, faces) -> None:
    body = model.add("SHELL_BASED_SURFACE_MODEL", "", [model.add("OPEN_SHELL", "", list(faces))])
    model.product(name, [body], representation="MANIFOLD_SURFACE_SHAPE_REPRESENTATION")


@sloppy("face_sense_wrong", "two sides of a box with the wrong same_sense")
def face_sense_wrong():
    model = StepModel()
    sides = box_polygons(*BOX)
    faces = [side_face(model, side, model.polygon(*side), same_sense=k not in (1, 4)) for k, side in enumerate(sides)]
    finish(model, "face_sense_wrong", faces)
    return model, box_reference(model)


@sloppy("loops_backward", "two sides of a box whose only loop runs the wrong way round")
def loops_backward():
    model = StepModel()
    sides = box_polygons(*BOX)
    faces = [side_face(model, side, model.polygon(*side), bound=k not in (0, 5)) for k, side in enumerate(sides)]
    finish(model, "loops_backward", faces)
    return model, box_reference(model)


@sloppy("holes_backward", "a plate whose holes run the same way round as its rim")
def holes_backward():
    model = StepModel()
    rim = model.polygon(ORIGIN, (30.0, 0.0, 0.0), (30.0, 20.0, 0.0), (0.0, 20.0, 0.0))
    holes = [model.loop(model.ring((x, 10.0, 0.0), Z, X, 3.0)) for x in (8.0, 20.0)]
    area = 600 - 18 * pi
    centre = ((600 * 15 - 9 * pi * 28) / area, 10.0, 0.0)
    sheet(model, "holes_backward", [model.face(model.plane(), [rim, *holes], kind="plane", area=area, centroid=centre)])
    return model, model.reference(bbox=[[0.0] * 3, [30.0, 20.0, 0.0]], closed=False, sloppy_mm=0.0)


@sloppy("outer_bound_on_hole", "FACE_OUTER_BOUND on a hole, FACE_BOUND on the rim")
def outer_bound_on_hole():
    model = StepModel()
    hole = model.loop((model.ring((15.0, 10.0, 0.0), Z, X, 4.0), False))
    rim = model.polygon(ORIGIN, (30.0, 0.0, 0.0), (30.0, 20.0, 0.0), (0.0, 20.0, 0.0))
    face = model.face(model.plane(), [hole, rim], kind="plane", area=600 - 16 * pi, centroid=(15.0, 10.0, 0.0))
    sheet(model, "outer_bound_on_hole", [face])
    return model, model.reference(bbox=[[0.0] * 3, [30.0, 20.0, 0.0]], closed=False, sloppy_mm=0.0)


@sloppy("oriented_edges_all_forward", "every oriented edge says .T.; only the vertices tell which way it is used")
def oriented_edges_all_forward():
    model = StepModel()
    finish(model, "oriented_edges_all_forward", model.box_faces(*BOX))
    model.lines = [line.replace(".F.", ".T.") if "=ORIENTED_EDGE(" in line else line for line in model.lines]
    return model, box_reference(model)


@sloppy("edges_out_of_order", "the edges of each loop are listed in no order")
def edges_out_of_order():
    model, chance = StepModel(), random.Random(3)
    faces = []
    for side in box_polygons(*BOX):
        uses = [model.straight(a, b) for a, b in zip(side, side[1:] + side[:1])]
        chance.shuffle(uses)
        faces.append(side_face(model, side, model.loop(*uses)))
    finish(model, "edges_out_of_order", faces)
    return model, box_reference(model)


@sloppy(
    "zero_length_edges",
    "loops with edges of length zero: between two vertices at one place, and from a vertex to itself",
)
def zero_length_edges():
    model = StepModel()
    faces = []
    for k, side in enumerate(box_polygons(*BOX)):
        uses: list = [model.straight(a, b) for a, b in zip(side, side[1:] + side[:1])]
        if k == 5:
            twin = model.add("VERTEX_POINT", "", model.point(side[0]))
            nowhere = model.add("LINE", "", model.point(side[0]), model.vector(X, 1.0))
            there = model.add("EDGE_CURVE", "", model.vertex(side[0]), twin, nowhere, TRUE)
            back = model.add("EDGE_CURVE", "", twin, model.vertex(side[0]), nowhere, TRUE)
            uses = [there, back, *uses]
        if k == 4:
            zero = model.add("LINE", "", model.point(side[0]), model.vector(X, 0.0))
            uses.append(model.add("EDGE_CURVE", "", model.vertex(side[0]), model.vertex(side[0]), zero, TRUE))
        faces.append(side_face(model, side, model.loop(*uses)))
    finish(model, "zero_length_edges", faces)
    return model, box_reference(model)


@sloppy("tiny_edges", "a rim with edges of 1e-6 mm between its long ones")
def tiny_edges():
    model = StepModel()
    tiny = 1e-6
    points = [
        (0.0, 0.0, 0.0),
        (30.0, 0.0, 0.0),
        (30.0, tiny, 0.0),
        (30.0, 20.0, 0.0),
        (30.0 - tiny, 20.0, 0.0),
        (0.0, 20.0, 0.0),
    ]
    sheet(model, "tiny_edges", [model.polygon_face(*points)])
    return model, model.reference(bbox=[[0.0] * 3, [30.0, 20.0, 0.0]], closed=False, sloppy_mm=0.0)


@sloppy("duplicate_points", "poly loops and a polyline with repeated points")
def duplicate_points():
    model = StepModel()
    faces = []
    for side in box_polygons(*BOX):
        doubled = [p for p in side for _ in range(2)] + [side[0]]
        poly = model.add("POLY_LOOP", "", [model.point(p) for p in doubled])
        area, _, centroid = polygon_figures(side)
        face = model.add(
            "FACE_SURFACE", "", [model.add("FACE_OUTER_BOUND", "", poly, TRUE)], side_plane(model, side), TRUE
        )
        model.faces.append(FaceFigures(face, "plane", area, centroid))
        faces.append(face)
    brep = model.add("FACETED_BREP", "", model.add("CLOSED_SHELL", "", faces))
    model.product("duplicate_points", [brep], representation="FACETED_BREP_SHAPE_REPRESENTATION")
    return model, box_reference(model)


@sloppy("spur_in_loop", "a loop with an edge that runs inward and back again")
def spur_in_loop():
    model = StepModel()
    faces = []
    for k, side in enumerate(box_polygons(*BOX)):
        uses: list = [model.straight(a, b) for a, b in zip(side, side[1:] + side[:1])]
        if k == 5:
            spur = model.straight(side[0], (10.0, 8.0, 10.0))[0]
            uses += [(spur, True), (spur, False)]
        faces.append(side_face(model, side, model.loop(*uses)))
    finish(model, "spur_in_loop", faces)
    return model, box_reference(model)


@sloppy("hole_touches_rim", "a square hole one corner of which is a corner of the rim")
def hole_touches_rim():
    model = StepModel()
    rim = model.polygon(ORIGIN, (30.0, 0.0, 0.0), (30.0, 20.0, 0.0), (0.0, 20.0, 0.0))
    hole = model.polygon(ORIGIN, (5.0, 8.0, 0.0), (10.0, 10.0, 0.0), (8.0, 5.0, 0.0))
    inner, _, at = polygon_figures([ORIGIN, (8.0, 5.0, 0.0), (10.0, 10.0, 0.0), (5.0, 8.0, 0.0)])
    area = 600 - inner
    centre = times(1 / area, plus(times(600.0, (15.0, 10.0, 0.0)), times(-inner, at)))
    sheet(model, "hole_touches_rim", [model.face(model.plane(), [rim, hole], kind="plane", area=area, centroid=centre)])
    return model, model.reference(bbox=[[0.0] * 3, [30.0, 20.0, 0.0]], closed=False, sloppy_mm=0.0)


@sloppy("closed_shell_declared_open", "a whole box whose shell is called open, in a surface model")
def closed_shell_declared_open():
    model = StepModel()
    sheet(model, "closed_shell_declared_open", model.box_faces(*BOX))
    return model, model.reference(bbox=BOX, closed=False, sloppy_mm=0.0)


@sloppy("open_shell_declared_closed", "a solid whose closed shell lacks a face")
def open_shell_declared_closed():
    model = StepModel()
    finish(model, "open_shell_declared_closed", model.box_faces(*BOX, 5))
    return model, model.reference(bbox=BOX, closed=False, solids=1, sloppy_mm=0.0)


@sloppy("face_twice_in_shell", "a shell that lists one of its faces twice")
def face_twice_in_shell():
    model = StepModel()
    faces = model.box_faces(*BOX)
    finish(model, "face_twice_in_shell", [*faces, faces[2]])
    return model, box_reference(model)


@sloppy("directions_not_normal", "directions of length 2 and 0.5, reference directions neither perpendicular nor given")
def directions_not_normal():
    model = StepModel()
    faces = []
    for k, side in enumerate(box_polygons(*BOX)):
        _, normal, _ = polygon_figures(side)
        along = unit(plus(side[1], times(-1.0, side[0])))
        x = model.add("DIRECTION", "", plus(times(0.5, along), times(0.3, normal))) if k % 2 else None
        axis = model.add("DIRECTION", "", times(2.0, normal))
        plane = model.add("PLANE", "", model.add("AXIS2_PLACEMENT_3D", "", model.point(side[0]), axis, x))
        faces.append(side_face(model, side, model.polygon(*side), surface=plane))
    finish(model, "directions_not_normal", faces)
    return model, box_reference(model)


@sloppy("reference_direction_parallel", "placements whose reference direction is parallel to their axis, or zero")
def reference_direction_parallel():
    model = StepModel()
    faces = []
    for k, side in enumerate(box_polygons(*BOX)):
        _, normal, _ = polygon_figures(side)
        x = model.add("DIRECTION", "", normal if k % 2 else (0.0, 0.0, 0.0))
        placement = model.add("AXIS2_PLACEMENT_3D", "", model.point(side[0]), model.direction(normal), x)
        faces.append(side_face(model, side, model.polygon(*side), surface=model.add("PLANE", "", placement)))
    finish(model, "reference_direction_parallel", faces)
    return model, box_reference(model)


@sloppy("degrees_for_radians", "a cone whose half angle is 45 although radians are declared")
def degrees_for_radians():
    model = StepModel()
    low, high = model.ring(ORIGIN, Z, X, 10.0), model.ring((0.0, 0.0, 6.0), Z, X, 16.0)
    seam = model.straight((10.0, 0.0, 0.0), (16.0, 0.0, 6.0))[0]
    wall = model.face(
        model.cone(10.0, 45.0),
        [model.loop(low, (seam, True), (high, False), (seam, False))],
        kind="cone",
        area=pi * 26 * 6 * sqrt(2),
        centroid=(0.0, 0.0, 6 * (10 + 2 * 16) / (3 * 26)),
    )
    floor = model.face(
        model.plane(axis=(0.0, 0.0, -1.0)), [model.loop((low, False))], kind="plane", area=100 * pi, centroid=ORIGIN
    )
    lid = model.face(
        model.plane((0.0, 0.0, 6.0)), [model.loop(high)], kind="plane", area=256 * pi, centroid=(0.0, 0.0, 6.0)
    )
    finish(model, "degrees_for_radians", [wall, floor, lid])
    box = [[-16.0, -16.0, 0.0], [16.0, 16.0, 6.0]]
    return model, model.reference(volume=pi * 6 * (100 + 160 + 256) / 3, bbox=box, sloppy_mm=0.0)


@sloppy(
    "degrees_for_radians_trim",
    "arcs trimmed at parameters 0 and 180 although radians are declared; the vertices are right",
)
def degrees_for_radians_trim():
    def trimmed(model, z):
        return model.add("TRIMMED_CURVE", "", circle(model, z), [at(0.0)], [at(180.0)], TRUE, Enum("PARAMETER"))

    model, figures = half_moon("degrees_for_radians_trim", trimmed)
    return model, {**figures, "sloppy_mm": 0.0}


@sloppy("uncertainty_huge", "the file states an uncertainty of 50 mm for a box of 30 mm")
def uncertainty_huge():
    model = StepModel()
    model.product("uncertainty_huge", [model.box(*BOX)], context=model.context(uncertainty=50.0))
    return model, box_reference(model)


@sloppy("uncertainty_zero", "the file states an uncertainty of zero; its vertices are rounded to 1e-4 mm")
def uncertainty_zero():
    model = StepModel()
    # A prism over a pentagon whose planes are exact and whose points are rounded.
    exact = [(10 * cos(2 * pi * k / 5), 10 * sin(2 * pi * k / 5)) for k in range(5)]
    low = [(round(x, 4), round(y, 4), 0.0) for x, y in exact]
    high = [(x, y, 12.0) for x, y, _ in low]
    faces = [model.polygon_face(*low[::-1]), model.polygon_face(*high)]
    for k in range(5):
        a, b = exact[k], exact[(k + 1) % 5]
        normal = unit((b[1] - a[1], a[0] - b[0], 0.0))
        plane = model.plane((*a, 0.0), normal, unit((b[0] - a[0], b[1] - a[1], 0.0)))
        side = [low[k], low[(k + 1) % 5], high[(k + 1) % 5], high[k]]
        area, _, centroid = polygon_figures(side)
        faces.append(model.face(plane, [model.polygon(*side)], kind="plane", area=area, centroid=centroid))
    model.product("uncertainty_zero", [model.solid(faces)], context=model.context(uncertainty=0.0))
    area = polygon_figures(low)[0]
    box = [[min(p[i] for p in low) for i in (0, 1)] + [0.0], [max(p[i] for p in low) for i in (0, 1)] + [12.0]]
    return model, model.reference(volume=12 * area, bbox=box, sloppy_mm=1e-4)


def flat_spline(name: str, u_counts, u_knots, v_counts=(4, 4), v_knots=(0.0, 1.0), rows: int = 5):
    """A flat cubic B-spline sheet with given knots; what is meant is the rectangle of its corners."""
    model = StepModel()
    poles = [[(10.0 * i, 8.0 * j, 0.0) for j in range(4)] for i in range(rows)]
    refs = [[model.point(p) for p in row] for row in poles]
    kind = Enum("UNSPECIFIED")
    surface = model.add(
        "B_SPLINE_SURFACE_WITH_KNOTS", "", 3, 3, refs, kind, FALSE, FALSE, UNKNOWN,
        list(u_counts), list(v_counts), [float(k) for k in u_knots], list(v_knots), kind,
    )  # fmt: skip
    x, y = 10.0 * (rows - 1), 24.0
    loop = model.polygon(ORIGIN, (x, 0.0, 0.0), (x, y, 0.0), (0.0, y, 0.0))
    sheet(model, name, [model.face(surface, [loop], kind="bspline", area=x * y, centroid=(x / 2, y / 2, 0.0))])
    return model, model.reference(bbox=[[0.0] * 3, [x, y, 0.0]], closed=False, sloppy_mm=0.0)


@sloppy("knots_zero_length", "the same knot value listed twice, each with its own multiplicity")
def knots_zero_length():
    return flat_spline("knots_zero_length", (4, 1, 1, 4), (0.0, 0.5, 0.5, 1.0), rows=6)


@sloppy("knots_nearly_equal", "knots 1e-13 apart that are meant to be one")
def knots_nearly_equal():
    return flat_spline("knots_nearly_equal", (4, 1, 1, 4), (0.0, 0.5, 0.5 + 1e-13, 1.0), rows=6)


@sloppy("multiplicity_short_at_ends", "end multiplicities of degree instead of degree + 1, as some writers count")
def multiplicity_short_at_ends():
    return flat_spline("multiplicity_short_at_ends", (3, 1, 3), (0.0, 0.5, 1.0), rows=5)


@sloppy("spline_pole_repeated", "a B-spline edge with three equal poles at an end: its derivative vanishes there")
def spline_pole_repeated():
    model = StepModel()
    poles = [(20.0, 0.0), (20.0, 0.0), (20.0, 0.0), (10.0, 14.0), (0.0, 10.0), (0.0, 0.0), (0.0, 0.0)]
    spline = Spline(3, poles, bezier_knots(7, 3))
    arc = Segment((20.0, 0.0), (0.0, 0.0), spline.pieces(), spline_writer(spline, "WITH_KNOTS"))
    segments = [arc, straight((0.0, 0.0), (20.0, 0.0))]
    area, centroid, box = outline_figures(segments)
    edges = [model.edge((*s.start, 0.0), (*s.end, 0.0), s.curve(model, 0.0)) for s in segments]
    face = model.face(model.plane(), [model.loop(*edges)], kind="plane", area=area, centroid=(*centroid, 0.0))
    sheet(model, "spline_pole_repeated", [face])
    bbox = [[*map(float, box[0]), 0.0], [*map(float, box[1]), 0.0]]
    return model, model.reference(bbox=bbox, closed=False, sloppy_mm=0.0)


@sloppy("vertex_loop_beside_real_loops", "a plane face with a stray vertex loop inside it")
def vertex_loop_beside_real_loops():
    model = StepModel()
    rim = model.polygon(ORIGIN, (30.0, 0.0, 0.0), (30.0, 20.0, 0.0), (0.0, 20.0, 0.0))
    stray = model.vertex_loop((10.0, 10.0, 0.0))
    sheet(
        model,
        "vertex_loop_beside_real_loops",
        [model.face(model.plane(), [rim, stray], kind="plane", area=600.0, centroid=(15.0, 10.0, 0.0))],
    )
    return model, model.reference(bbox=[[0.0] * 3, [30.0, 20.0, 0.0]], closed=False, sloppy_mm=0.0)


@sloppy("circle_vertex_off", "whole circles whose vertex stands 0.01 mm outside them, at an odd angle")
def circle_vertex_off():
    model = StepModel()
    edges = []
    for z in (0.0, 30.0):
        point = (10.01 * cos(2.0), 10.01 * sin(2.0), z)
        edges.append(model.edge(point, point, model.circle((0.0, 0.0, z), Z, X, 10.0)))
    low, high = edges
    wall = model.face(
        model.cylinder(10.0),
        [model.loop(low), model.loop((high, False))],
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
    finish(model, "circle_vertex_off", [wall, floor, lid])
    return model, model.reference(**CYLINDER, sloppy_mm=0.01)


@sloppy("plane_side_points_off", "a face of eight points that lie up to 0.005 mm off its plane")
def plane_side_points_off():
    model, chance = StepModel(), random.Random(4)
    points = [(10 * cos(k * pi / 4), 10 * sin(k * pi / 4), chance.uniform(-0.005, 0.005)) for k in range(8)]
    area = 200 * sqrt(2)
    face = model.face(model.plane(), [model.polygon(*points)], kind="plane", area=area, centroid=ORIGIN)
    sheet(model, "plane_side_points_off", [face])
    return model, model.reference(bbox=[[-10.0, -10.0, 0.0], [10.0, 10.0, 0.0]], closed=False, sloppy_mm=0.005)


@sloppy("orphan_solid", "a solid that no product and no representation refers to, beside nothing else")
def orphan_solid():
    model = StepModel()
    model.box(*BOX)
    return model, box_reference(model)


@sloppy("representation_without_product", "a shape representation that no product points to")
def representation_without_product():
    model = StepModel()
    model.add("ADVANCED_BREP_SHAPE_REPRESENTATION", "lonely", [model.box(*BOX)], model.default_context())
    return model, box_reference(model)
