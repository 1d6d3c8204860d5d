"""Solids of the elementary surfaces, whole and cut: closed forms throughout."""

from math import pi, sqrt

import cadquery as cq
from OCP.BRepPrimAPI import BRepPrimAPI_MakeSphere, BRepPrimAPI_MakeTorus

from catalogue import fixture


@fixture("box", "six planes", closed_form={"area_mm2": 2200.0, "volume_mm3": 6000.0})
def box():
    return cq.Workplane().box(30, 20, 10)


@fixture(
    "plate_with_hole",
    "a plane with an inner loop; a whole cylinder seen from inside",
    closed_form={"area_mm2": 2 * (1200 - 36 * pi) + 2 * 5 * 70 + 60 * pi, "volume_mm3": 5 * (1200 - 36 * pi)},
)
def plate_with_hole():
    return cq.Workplane().box(40, 30, 5).faces(">Z").workplane().hole(12)


@fixture(
    "cylinder",
    "a whole cylinder with its seam",
    closed_form={"area_mm2": 2 * pi * 10 * 30 + 2 * pi * 100, "volume_mm3": 3000 * pi},
)
def cylinder():
    return cq.Workplane().circle(10).extrude(30)


@fixture(
    "cylinder_partial",
    "a cylinder over 250 degrees: no seam, angles past half a turn",
    closed_form={"volume_mm3": 3000 * pi * 250 / 360},
)
def cylinder_partial():
    return cq.Solid.makeCylinder(10, 30, angleDegrees=250)


@fixture(
    "cone_with_apex",
    "a cone up to its apex: a degenerate edge",
    closed_form={"area_mm2": pi * 100 + pi * 10 * sqrt(100 + 625), "volume_mm3": 2500 * pi / 3},
)
def cone_with_apex():
    return cq.Solid.makeCone(10, 0, 25)


@fixture(
    "cone_partial_with_apex",
    "a third of a cone up to its apex, where two straight edges meet",
    closed_form={"volume_mm3": 2500 * pi / 9},
)
def cone_partial_with_apex():
    return cq.Solid.makeCone(10, 0, 25, angleDegrees=120)


@fixture(
    "frustum",
    "a cone cut off below its apex",
    closed_form={
        "area_mm2": pi * (100 + 16) + pi * 14 * sqrt(36 + 400),
        "volume_mm3": pi * 20 * (100 + 40 + 16) / 3,
    },
)
def frustum():
    return cq.Solid.makeCone(10, 4, 20)


@fixture("frustum_widening", "a cone whose radius grows along its axis")
def frustum_widening():
    return cq.Solid.makeCone(4, 10, 20)


@fixture("cone_needle", "a cone of one degree: a long apex", closed_form={"volume_mm3": pi * 0.25 * 30 / 3})
def cone_needle():
    return cq.Solid.makeCone(0.5, 0, 30)


@fixture(
    "double_cone",
    "two cones on either side of one apex, as two solids that touch in a point",
    closed_form={"volume_mm3": 2 * pi * 100 * 20 / 3},
)
def double_cone():
    up = cq.Solid.makeCone(0, 10, 20)
    down = cq.Solid.makeCone(0, 10, 20, dir=cq.Vector(0, 0, -1))
    return cq.Compound.makeCompound([up, down])


@fixture(
    "sphere",
    "a whole sphere: one face, a seam and two poles",
    closed_form={"area_mm2": 400 * pi, "volume_mm3": 4000 * pi / 3},
)
def sphere():
    return cq.Workplane().sphere(10)


@fixture(
    "hemisphere",
    "half a sphere: one pole",
    closed_form={"area_mm2": 300 * pi, "volume_mm3": 2000 * pi / 3},
)
def hemisphere():
    return cq.Solid.makeSphere(10, angleDegrees1=0, angleDegrees2=90)


@fixture("sphere_lune", "a slice of a sphere from pole to pole", closed_form={"volume_mm3": 4000 * pi / 3 / 6})
def sphere_lune():
    return cq.Shape.cast(BRepPrimAPI_MakeSphere(10.0, -pi / 2, pi / 2, pi / 3).Shape())


@fixture(
    "sphere_zone",
    "a zone of a sphere between two circles of latitude: no pole",
    closed_form={"volume_mm3": pi * 10 / 6 * (3 * 75 + 3 * 75 + 100)},
)
def sphere_zone():
    return cq.Workplane().sphere(10).intersect(cq.Workplane().box(30, 30, 10))


@fixture("sphere_segment", "a piece of a sphere between longitudes and latitudes")
def sphere_segment():
    return cq.Shape.cast(BRepPrimAPI_MakeSphere(10.0, -pi / 6, pi / 3, 1.25 * pi).Shape())


@fixture(
    "sphere_cap_off_axis",
    "a sphere cut by a plane that is not a circle of latitude: the loop crosses the seam",
    closed_form={"volume_mm3": 4000 * pi / 3 - pi * 16 * (30 - 4) / 3},
)
def sphere_cap_off_axis():
    cutter = cq.Workplane(cq.Plane((0, 0, 0), (0, 1, 0), (1, 0, 0.2))).workplane(offset=6).rect(60, 60).extrude(20)
    return cq.Workplane().sphere(10).cut(cutter)


@fixture(
    "sphere_cut_through_pole",
    "a sphere cut by a plane that leaves one pole exactly on its edge",
)
def sphere_cut_through_pole():
    plane = cq.Plane((0, 0, 10), (0, 1, 0), (1, 0, 0.5))
    return cq.Workplane().sphere(10).cut(cq.Workplane(plane).rect(80, 80).extrude(40))


@fixture(
    "torus",
    "a whole torus: one face, two seams",
    closed_form={"area_mm2": 4 * pi * pi * 20 * 5, "volume_mm3": 2 * pi * pi * 20 * 25},
)
def torus():
    return cq.Solid.makeTorus(20, 5)


@fixture(
    "torus_segment", "a torus over 130 degrees round its axis", closed_form={"volume_mm3": 1000 * pi * pi * 130 / 360}
)
def torus_segment():
    return cq.Shape.cast(BRepPrimAPI_MakeTorus(20.0, 5.0, 130 * pi / 180).Shape())


@fixture("torus_tube_segment", "a torus over part of its tube: its upper and outer side, closed by planes and cones")
def torus_tube_segment():
    return cq.Shape.cast(BRepPrimAPI_MakeTorus(20.0, 5.0, -0.5, 2.0, 1.5 * pi).Shape())


@fixture("torus_cut_across", "a torus cut by a plane parallel to its axis (spiric sections)")
def torus_cut_across():
    cutter = cq.Workplane("YZ").workplane(offset=13).rect(100, 100).extrude(50)
    return cq.Workplane(cq.Solid.makeTorus(20, 5)).cut(cutter)


def revolved_circle(centre: float, radius: float, outer: bool, degrees: float):
    """What the part of a circle on one side of the axis sweeps out: the apple or the lemon."""
    h = sqrt(radius**2 - centre**2)
    far = centre + radius if outer else centre - radius
    profile = cq.Workplane("XZ").moveTo(0, -h).threePointArc((far, 0), (0, h)).close()
    return profile.revolve(degrees, (0, 0, 0), (0, 1, 0))


@fixture("torus_apple", "a torus whose minor radius is the larger one: part of its outer side, two degenerate points")
def torus_apple():
    return revolved_circle(6.0, 10.0, True, 220)


@fixture("torus_lemon", "a torus whose minor radius is the larger one: part of its inner side, a lemon")
def torus_lemon():
    return revolved_circle(6.0, 10.0, False, 220)


@fixture(
    "capsule",
    "cylinder and half spheres that join smoothly",
    closed_form={"area_mm2": 400 * pi + 2 * pi * 10 * 30, "volume_mm3": 4000 * pi / 3 + 3000 * pi},
)
def capsule():
    profile = cq.Workplane("XZ").moveTo(0, -25).threePointArc((sqrt(50), -15 - sqrt(50)), (10, -15))
    profile = profile.lineTo(10, 15).threePointArc((sqrt(50), 15 + sqrt(50)), (0, 25)).close()
    return profile.revolve(360, (0, 0, 0), (0, 1, 0))


@fixture("wedge", "a prism over a trapezium: slanting planes", closed_form={"volume_mm3": 20 * 10 * (30 + 10) / 2})
def wedge():
    return cq.Workplane("XZ").polyline([(0, 0), (30, 0), (10, 10), (0, 10)]).close().extrude(-20)
