"""Faces that come one by one: what closes must become a body."""

from __future__ import annotations

from math import cos, pi, sin

from iges.catalogue import iges
from iges_brep import outward
from iges_deck import PART
from iges_model import IgesModel, around, box_sides
from plane_curves import Spline
from step_model import cross, plus, times

BOX = ((0.0, 0.0, 0.0), (30.0, 20.0, 10.0))
AREA, VOLUME = 2200.0, 6000.0


def loose_box(model: IgesModel, low=BOX[0], high=BOX[1], sides=range(6), **options) -> list[int]:
    """The sides of a box as trimmed surfaces."""
    polygons = box_sides(low, high)
    return [model.polygon(*polygons[k], **options) for k in sides]


@iges("loose_box", "a box of six trimmed planes that share nothing")
def box():
    model = IgesModel("loose_box")
    loose_box(model)
    return model, model.reference(volume=VOLUME)


@iges("loose_box_inches", "a box of six trimmed planes, in inches")
def box_inches():
    model = IgesModel("loose_box_inches", unit=1, unit_name="INCH")
    loose_box(model, (0.0, 0.0, 0.0), (3.0, 2.0, 1.0))
    return model, model.reference(volume=6.0, scale=25.4)


@iges("loose_box_turned_faces", "a box whose trimmed planes have normals and boundaries of either sense")
def box_turned_faces():
    model = IgesModel("loose_box_turned_faces")
    for k, polygon in enumerate(box_sides(*BOX)):
        points = polygon[::-1] if k % 2 else polygon
        normal = outward(polygon)
        surface = model.plane(polygon[0], normal if k % 3 else times(-1, normal))
        model.polygon(*points, surface=surface)
    return model, model.reference(volume=VOLUME)


@iges("loose_box_bounded_planes", "a box of six planes of type 108 form 1, each with its own boundary")
def box_bounded_planes():
    model = IgesModel("loose_box_bounded_planes")
    for polygon in box_sides(*BOX):
        normal = outward(polygon)
        distance = sum(n * c for n, c in zip(normal, polygon[0]))
        boundary = model.polyline(*polygon)
        plane = model.add(108, [*normal, distance, boundary, *polygon[0], 0.0], form=1)
        width, height = sorted(b - a for a, b in zip(*around([polygon])))[1:]
        centroid = times(0.25, plus(*polygon))
        model.know(plane, "plane", width * height, centroid, around([polygon]))
    return model, model.reference(volume=VOLUME)


@iges("loose_box_bounded_surfaces", "a box of six bounded surfaces, type 143 over type 141 with four lines each")
def box_bounded_surfaces():
    model = IgesModel("loose_box_bounded_surfaces")

    for polygon in box_sides(*BOX):
        normal = outward(polygon)
        lines = [(model.line(a, b), 1, []) for a, b in zip(polygon, (*polygon[1:], polygon[0]))]
        entity = model.bounded(model.flat(polygon[0], normal), [lines])
        width, height = sorted(b - a for a, b in zip(*around([polygon])))[1:]
        model.know(entity, "plane", width * height, times(0.25, plus(*polygon)), around([polygon]))
    return model, model.reference(volume=VOLUME)


@iges("loose_box_untrimmed_patches", "a box of six untrimmed B-spline surfaces of degree 1")
def box_untrimmed_patches():
    model = IgesModel("loose_box_untrimmed_patches")
    for a, b, c, d in box_sides(*BOX):
        u, v = plus(b, times(-1, a)), plus(d, times(-1, a))
        entity = model.bilinear(a, u, v)
        size = sum(x * x for x in cross(u, v)) ** 0.5
        model.know(entity, "bspline", size, times(0.25, plus(a, b, c, d)), around([(a, b, c, d)]))
    return model, model.reference(volume=VOLUME)


@iges("loose_box_spline_boundaries", "a box whose sides are each bounded by one spline of degree 1 with four corners")
def box_spline_boundaries():
    model = IgesModel("loose_box_spline_boundaries")
    for k, polygon in enumerate(box_sides(*BOX)):
        # Each starts at another of its corners.
        points = [*polygon[k % 4 :], *polygon[: k % 4]]
        points.append(points[0])
        boundary = model.spline(Spline(1, points, [0, 0, 1, 2, 3, 4, 4]), closed=True)
        face = model.trimmed(model.plane(polygon[0], outward(polygon)), boundary)
        width, height = sorted(b - a for a, b in zip(*around([polygon])))[1:]
        model.know(face, "plane", width * height, times(0.25, plus(*polygon)), around([polygon]))
    return model, model.reference(volume=VOLUME)


@iges("loose_box_split_top", "a box whose top is two faces: one long edge meets two short ones")
def box_split_top():
    model = IgesModel("loose_box_split_top")
    loose_box(model, sides=range(5))
    model.polygon((0.0, 0.0, 10.0), (12.0, 0.0, 10.0), (12.0, 20.0, 10.0), (0.0, 20.0, 10.0))
    model.polygon((12.0, 0.0, 10.0), (30.0, 0.0, 10.0), (30.0, 20.0, 10.0), (12.0, 20.0, 10.0))
    return model, model.reference(volume=VOLUME)


@iges("loose_box_gaps", "a box whose sides stand 0.005 mm apart")
def box_gaps():
    model = IgesModel("loose_box_gaps")
    for k, polygon in enumerate(box_sides(*BOX)):
        away = [0.0, 0.0, 0.0]
        away[k // 2] = {1: 0.005, 3: -0.005}.get(k, 0.0)
        model.polygon(*(plus(point, away) for point in polygon))
    return model, {**model.reference(volume=VOLUME), "sloppy_mm": 0.005}


@iges("loose_box_open", "a box that lacks its top: a sheet of five faces")
def box_open():
    model = IgesModel("loose_box_open")
    loose_box(model, sides=range(5))
    return model, model.reference()


@iges("loose_boxes_two", "two boxes apart from each other, their faces mixed")
def boxes_two():
    model = IgesModel("loose_boxes_two")
    for k in range(6):
        loose_box(model, sides=[k])
        loose_box(model, (50.0, 0.0, 0.0), (60.0, 10.0, 10.0), sides=[k])
    return model, model.reference(volume=7000.0, solids=2)


@iges("loose_boxes_touching", "two boxes that touch along one edge, where four faces meet")
def boxes_touching():
    model = IgesModel("loose_boxes_touching")
    loose_box(model, (0.0, 0.0, 0.0), (10.0, 10.0, 10.0))
    loose_box(model, (10.0, 10.0, 0.0), (20.0, 20.0, 10.0))
    reference = model.reference(volume=2000.0, solids=2)
    # One body with an edge of four faces is as right as two.
    del reference["solids"]
    return model, reference


@iges(
    "loose_box_with_hole", "a box with a square hole right through: inner boundaries above and below, four walls inside"
)
def box_with_hole():
    model = IgesModel("loose_box_with_hole")
    loose_box(model, sides=range(4))
    hole = [(10.0, 5.0), (20.0, 5.0), (20.0, 15.0), (10.0, 15.0)]
    for z in (0.0, 10.0):
        rim = [(0.0, 0.0, z), (30.0, 0.0, z), (30.0, 20.0, z), (0.0, 20.0, z)]
        outer, inner = model.polyline(*rim), model.polyline(*((x, y, z) for x, y in hole))
        face = model.trimmed(model.plane(rim[0]), outer, [inner])
        model.know(face, "plane", 500.0, (15.0, 10.0, z), around([rim]))
    for (x0, y0), (x1, y1) in zip(hole, hole[1:] + hole[:1]):
        model.polygon((x0, y0, 0.0), (x0, y0, 10.0), (x1, y1, 10.0), (x1, y1, 0.0))
    return model, model.reference(volume=5000.0)


def cylinder_wall(model: IgesModel, radius: float, height: float, halves: int, surface: int) -> int:
    """The wall of a cylinder about z as one face: circles below and above in `halves` arcs, and the seam twice."""

    def ring(z: float, backward: bool) -> list[int]:
        angles = [2 * pi * k / halves for k in range(halves + 1)]
        at = [(round(radius * cos(a), 12), round(radius * sin(a), 12)) for a in angles]
        at[-1] = at[0]
        arcs = []
        for a, b in zip(at, at[1:]):
            if backward:
                # Half a turn about x: the arc runs the other way round.
                turn = model.matrix(((1.0, 0.0, 0.0, 0.0), (0.0, -1.0, 0.0, 0.0), (0.0, 0.0, -1.0, 0.0)))
                flipped = ((b[0], -b[1]), (a[0], -a[1]))
                arcs.insert(0, model.arc((0.0, 0.0), *flipped, -z, transformation=turn))
            else:
                arcs.append(model.arc((0.0, 0.0), a, b, z))
        return arcs

    up = model.line((radius, 0.0, 0.0), (radius, 0.0, height))
    down = model.line((radius, 0.0, height), (radius, 0.0, 0.0))
    boundary = model.composite([*ring(0.0, False), up, *ring(height, True), down])
    face = model.trimmed(surface, boundary)
    box = [[-radius, -radius, 0.0], [radius, radius, height]]
    return model.know(face, "cylinder", 2 * pi * radius * height, (0.0, 0.0, height / 2), box)


def cap(model: IgesModel, radius: float, z: float, boundary: int) -> int:
    face = model.trimmed(model.plane((0.0, 0.0, z)), boundary)
    return model.know(face, "plane", pi * radius**2, (0.0, 0.0, z), [[-radius, -radius, z], [radius, radius, z]])


def revolved_line(model: IgesModel, radius: float, height: float, **options) -> int:
    """A cylinder about z as type 120."""
    axis = model.line((0.0, 0.0, 0.0), (0.0, 0.0, 1.0))
    generatrix = model.line((radius, 0.0, 0.0), (radius, 0.0, height))
    return model.add(120, [axis, generatrix, 0.0, 2 * pi], **{"status": PART, **options})


@iges(
    "loose_cylinder_seam_halves", "a cylinder: the wall's circles are halves, each cap's is one: corners meet no corner"
)
def cylinder_seam_halves():
    model = IgesModel("loose_cylinder_seam_halves")
    cylinder_wall(model, 10.0, 30.0, 2, revolved_line(model, 10.0, 30.0))
    for z in (0.0, 30.0):
        cap(model, 10.0, z, model.circle((0.0, 0.0), 10.0, z))
    return model, model.reference(volume=3000 * pi)


@iges(
    "loose_cylinder_caps_thirds",
    "a cylinder: the wall's circles are halves, each cap's are thirds that start elsewhere",
)
def cylinder_caps_thirds():
    model = IgesModel("loose_cylinder_caps_thirds")
    cylinder_wall(model, 10.0, 30.0, 2, revolved_line(model, 10.0, 30.0))
    for z in (0.0, 30.0):
        at = [(10 * cos(0.4 + 2 * pi * k / 3), 10 * sin(0.4 + 2 * pi * k / 3)) for k in range(3)]
        arcs = [model.arc((0.0, 0.0), a, b, z) for a, b in zip(at, at[1:] + at[:1])]
        cap(model, 10.0, z, model.composite(arcs))
    return model, model.reference(volume=3000 * pi)


@iges("loose_cylinder_untrimmed_wall", "a cylinder: an untrimmed whole turn of type 120 between two round planes")
def cylinder_untrimmed_wall():
    model = IgesModel("loose_cylinder_untrimmed_wall")
    wall = revolved_line(model, 10.0, 30.0, status="00000000")
    model.know(wall, "cylinder", 600 * pi, (0.0, 0.0, 15.0), [[-10.0, -10.0, 0.0], [10.0, 10.0, 30.0]])
    for z in (0.0, 30.0):
        cap(model, 10.0, z, model.circle((0.0, 0.0), 10.0, z))
    return model, model.reference(volume=3000 * pi)


@iges("loose_cylinder_two_walls", "a cylinder: two half walls untrimmed, whole circles as caps")
def cylinder_two_walls():
    model = IgesModel("loose_cylinder_two_walls")
    for k in range(2):
        axis = model.line((0.0, 0.0, 0.0), (0.0, 0.0, 1.0))
        generatrix = model.line((10.0, 0.0, 0.0), (10.0, 0.0, 30.0))
        wall = model.add(120, [axis, generatrix, k * pi, (k + 1) * pi])
        side = -1.0 if k else 1.0
        box = around([[(-10.0, 0.0, 0.0), (10.0, 10.0 * side, 30.0)]])
        model.know(wall, "cylinder", 300 * pi, (0.0, side * 20 / pi, 15.0), box)
    for z in (0.0, 30.0):
        cap(model, 10.0, z, model.circle((0.0, 0.0), 10.0, z))
    return model, model.reference(volume=3000 * pi)
