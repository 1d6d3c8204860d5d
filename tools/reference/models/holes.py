"""Holes in curved faces, and loops that meet seams and poles."""

from math import cos, pi, sin

import cadquery as cq

from catalogue import fixture


def drill(radius: float, length: float, origin=(0, 0, 0), direction=(1, 0, 0)) -> cq.Workplane:
    """A long cylinder about a line through `origin`, to be cut away."""
    start = cq.Vector(origin) - cq.Vector(direction).normalized() * (length / 2)
    return cq.Workplane(cq.Solid.makeCylinder(radius, length, start, cq.Vector(direction)))


def whole_torus() -> cq.Workplane:
    return cq.Workplane(cq.Solid.makeTorus(20, 5))


@fixture(
    "sphere_with_hole_off_axis",
    "a sphere drilled in a slanting direction: two inner loops away from seam and poles",
    closed_form={"volume_mm3": 4 / 3 * pi * (100 - 9) ** 1.5},
)
def sphere_with_hole_off_axis():
    return cq.Workplane().sphere(10).cut(drill(3, 40, direction=(-1, -0.3, 0.4)))


@fixture(
    "sphere_with_hole_through_poles",
    "a napkin ring: both poles drilled away, loops that wrap once round",
    closed_form={"volume_mm3": 4 / 3 * pi * 8**3, "area_mm2": 2 * pi * 10 * 16 + 2 * pi * 6 * 16},
)
def sphere_with_hole_through_poles():
    return cq.Workplane().sphere(10).cut(drill(6, 40, direction=(0, 0, 1)))


@fixture("sphere_with_hole_beside_pole", "a sphere drilled so that one pole lies inside the hole, off its centre")
def sphere_with_hole_beside_pole():
    return cq.Workplane().sphere(10).cut(drill(3, 40, (1.3, 0.7, 0), (0, 0, 1)))


@fixture("sphere_with_hole_touching_pole", "a sphere drilled so that the hole's edge runs through both poles")
def sphere_with_hole_touching_pole():
    return cq.Workplane().sphere(10).cut(drill(3, 40, (-3, 0, 0), (0, 0, 1)))


@fixture(
    "sphere_with_hole_across_seam",
    "a sphere drilled where its seam is",
    closed_form={"volume_mm3": 4 / 3 * pi * (100 - 9) ** 1.5},
)
def sphere_with_hole_across_seam():
    return cq.Workplane().sphere(10).cut(drill(3, 40, direction=(1, 0, 0)))


@fixture("sphere_with_pinholes", "a sphere with five small blind holes, inner loops of few segments")
def sphere_with_pinholes():
    body = cq.Workplane().sphere(10)
    for x, y, z in [(-1, 0.2, 0.1), (-0.5, 1, 0.6), (0.3, -1, -0.2), (-0.4, -0.3, 1), (-0.5, 0.5, -0.7)]:
        tip = cq.Vector(x, y, z).normalized() * 10
        body = body.cut(drill(0.4, 4, tip.toTuple(), (x, y, z)))
    return body


@fixture("torus_with_hole", "a torus drilled through its tube: inner loops on a surface closed in both directions")
def torus_with_hole():
    # The cut leaves the outer loop the wrong way round; fix() turns it.
    return whole_torus().cut(drill(2, 20, (-20, 0, 0), (0.2, 0.1, 1))).val().fix()


@fixture("torus_with_hole_on_both_seams", "a torus drilled where its two seams cross")
def torus_with_hole_on_both_seams():
    return whole_torus().cut(drill(1.5, 12, (25, 0, 0), (1, 0, 0)))


def pocket(at, tilt_deg: float = 40) -> cq.Shape:
    """A small block about a point, askew to all axes."""
    return cq.Workplane().box(9, 8, 7).val().rotate((0, 0, 0), (1, 2, 3), tilt_deg).translate(cq.Vector(*at))


def thick_torus() -> cq.Workplane:
    return cq.Workplane(cq.Solid.makeTorus(20, 8))


@fixture(
    "torus_with_pocket_on_seam",
    "a torus with a pocket across its outer seam, away from the other: the seam's sides, in pieces, are part of the loop",
    meshes=False,
)
def torus_with_pocket_on_seam():
    return thick_torus().cut(cq.Workplane(pocket((28 * cos(2), 28 * sin(2), 0))))


@fixture("torus_with_pockets_on_seams", "a torus with pockets across either seam", meshes=False)
def torus_with_pockets_on_seams():
    outer, inner = pocket((28 * cos(2), 28 * sin(2), 0)), pocket((20, 0, 8))
    return thick_torus().cut(cq.Workplane(outer)).cut(cq.Workplane(inner))


@fixture("torus_half_of_tube", "a torus cut at its equator: loops that wrap round the long way")
def torus_half_of_tube():
    return whole_torus().cut(cq.Workplane().box(80, 80, 40).translate((0, 0, 20)))


@fixture("cylinder_with_cross_hole", "a cylinder drilled crosswise: intersection curves away from the seam")
def cylinder_with_cross_hole():
    return cq.Workplane().circle(10).extrude(30).cut(drill(4, 60, (0, 0, 15), (0, 1, 0)))


@fixture("cylinder_with_hole_across_seam", "a cylinder drilled where its seam is: the seam edge falls in two")
def cylinder_with_hole_across_seam():
    return cq.Workplane().circle(10).extrude(30).cut(drill(4, 60, (0, 0, 15), (1, 0, 0)))


@fixture("cylinder_with_slot_through_seam", "a slot that takes all of the cylinder's seam away")
def cylinder_with_slot_through_seam():
    return cq.Workplane().circle(10).extrude(30).cut(cq.Workplane().box(20, 3, 80).translate((10, 0, 0)))


@fixture("cylinder_with_wrapping_cut", "a cylinder cut askew at both ends: ellipses that wrap round it")
def cylinder_with_wrapping_cut():
    body = cq.Workplane().circle(10).extrude(40)
    top = cq.Workplane(cq.Plane((0, 0, 30), (1, 0, 0.4), (-0.4, 0, 1))).rect(80, 80).extrude(40)
    low = cq.Workplane(cq.Plane((0, 0, 10), (0, 1, 0.3), (0, 0.3, -1))).rect(80, 80).extrude(40)
    return body.cut(top).cut(low)


@fixture(
    "steinmetz",
    "what two cylinders of one radius have in common: four lunes that meet in two points",
    closed_form={"area_mm2": 1600.0, "volume_mm3": 16000 / 3},
)
def steinmetz():
    return drill(10, 60, direction=(1, 0, 0)).intersect(drill(10, 60, direction=(0, 1, 0)))


@fixture("pipe_tee", "two hollow pipes that meet: saddle curves inside and outside")
def pipe_tee():
    outer = drill(10, 60).union(drill(7, 40, (0, 0, 20), (0, 0, 1)))
    return outer.cut(drill(8, 80)).cut(drill(5.5, 41, (0, 0, 20.5), (0, 0, 1)))


@fixture("cone_with_hole", "a cone drilled crosswise near its apex")
def cone_with_hole():
    return cq.Workplane(cq.Solid.makeCone(10, 0, 25)).cut(drill(1.5, 40, (0, 0, 16), (1, 0.3, 0)))


@fixture("cone_apex_drilled_away", "a cone whose apex is drilled away off its axis")
def cone_apex_drilled_away():
    return cq.Workplane(cq.Solid.makeCone(10, 0, 25)).cut(drill(2, 60, (0.7, 0.3, 0), (0, 0, 1)))


@fixture(
    "plate_perforated",
    "a plane with twenty-eight inner loops",
    closed_form={"volume_mm3": (80 * 48 - 28 * pi * 9) * 2},
)
def plate_perforated():
    return cq.Workplane().box(80, 48, 2).faces(">Z").workplane().rarray(11, 11, 7, 4).hole(6)


@fixture(
    "plate_with_touching_hole",
    "a hole whose circle comes within 1 µm of the plate's rim",
    closed_form={"volume_mm3": (600 - 25 * pi) * 4},
)
def plate_with_touching_hole():
    return cq.Workplane().rect(30, 20).extrude(4).cut(drill(5, 20, (9.999, 0, 0), (0, 0, 1)))


@fixture(
    "ring",
    "a washer: planes whose only inner loop is a circle about the same centre",
    closed_form={"area_mm2": 2 * pi * (100 - 36) + 2 * pi * 3 * 16, "volume_mm3": 3 * pi * (100 - 36)},
)
def ring():
    return cq.Workplane().circle(10).circle(6).extrude(3)


@fixture(
    "sphere_in_plate",
    "a ball seat: half a sphere as a pocket",
    closed_form={"volume_mm3": 40 * 40 * 20 - 2000 * pi / 3},
)
def sphere_in_plate():
    return cq.Workplane().box(40, 40, 20).translate((0, 0, -10)).cut(cq.Workplane().sphere(10))


@fixture(
    "lens",
    "what two spheres have in common: two caps that share one circle",
    closed_form={"volume_mm3": 2 * pi * 16 * (30 - 4) / 3, "area_mm2": 2 * 2 * pi * 10 * 4},
)
def lens():
    return cq.Workplane().sphere(10).translate((0, 0, 6)).intersect(cq.Workplane().sphere(10).translate((0, 0, -6)))
