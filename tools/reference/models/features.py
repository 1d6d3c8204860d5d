"""Fillets, chamfers, shells: what CAD models are mostly made of."""

from math import pi

import cadquery as cq
from OCP.BRepFilletAPI import BRepFilletAPI_MakeFillet

from catalogue import fixture


@fixture(
    "box_filleted",
    "all edges of a box rounded: cylinders, and eighths of spheres at the corners",
    closed_form={
        # A box of 24 x 14 x 4 grown by 3 in every direction (Steiner).
        "volume_mm3": 24 * 14 * 4 + 2 * 3 * (24 * 14 + 24 * 4 + 14 * 4) + pi * 9 * (24 + 14 + 4) + 36 * pi,
        "area_mm2": 2 * (24 * 14 + 24 * 4 + 14 * 4) + 2 * pi * 3 * (24 + 14 + 4) + 36 * pi,
    },
)
def box_filleted():
    return cq.Workplane().box(30, 20, 10).edges().fillet(3)


@fixture("box_filleted_partly", "a box with fillets of two radii that meet")
def box_filleted_partly():
    return cq.Workplane().box(30, 20, 10).edges("|Z").fillet(4).faces(">Z").edges().fillet(1.5)


@fixture("fillet_variable", "a fillet whose radius grows along its edge")
def fillet_variable():
    box = cq.Workplane().box(30, 20, 10)
    fillet = BRepFilletAPI_MakeFillet(box.val().wrapped)
    fillet.Add(1.0, 4.0, box.edges(">Z and >Y").val().wrapped)
    return cq.Shape.cast(fillet.Shape())


@fixture("fillet_between_cylinders", "a fillet where two pipes meet: a B-spline along a saddle curve")
def fillet_between_cylinders():
    body = cq.Workplane().circle(10).extrude(40, both=True)
    branch = cq.Workplane("YZ").circle(5).extrude(25)
    joined = body.union(branch)
    return joined.edges(cq.selectors.BoxSelector((2, -6, -6), (12, 6, 6))).fillet(1.5)


@fixture("box_chamfered", "a box with chamfers")
def box_chamfered():
    return cq.Workplane().box(30, 20, 10).edges("|Z").chamfer(3).faces(">Z").edges().chamfer(1, 2)


@fixture("countersunk_plate", "counterbored and countersunk holes")
def countersunk_plate():
    plate = cq.Workplane().box(50, 25, 8).faces(">Z").workplane().pushPoints([(-14, 0)]).cboreHole(5, 10, 3)
    return plate.faces(">Z").workplane(origin=(0, 0, 4)).pushPoints([(14, 0)]).cskHole(5, 11, 82)


@fixture("shell_thin", "a box hollowed to walls of 0.2 mm, open on top")
def shell_thin():
    return cq.Workplane().box(30, 20, 10).faces(">Z").shell(-0.2)


@fixture("shell_round", "a filleted box hollowed outward: offset fillets inside")
def shell_round():
    return cq.Workplane().box(30, 20, 14).edges("|Z").fillet(4).edges("<Z").fillet(2).faces(">Z").shell(1.0)


@fixture("bottle", "a bottle: fillets, a neck, hollowed", angular=0.6)
def bottle():
    body = cq.Workplane().moveTo(-25, 0).vLine(-7).threePointArc((0, -15), (25, -7)).vLine(7).mirrorX().extrude(70)
    body = body.edges("|Z").fillet(4)
    body = body.faces(">Z").workplane(centerOption="CenterOfMass").circle(7.5).extrude(7, True)
    return body.faces(">Z").shell(-1.0)


@fixture("bracket", "a bracket as machined: fillets, chamfers, holes, pockets")
def bracket():
    foot = cq.Workplane().box(60, 40, 6).edges("|Z").fillet(6)
    wall = cq.Workplane().box(60, 6, 35).translate((0, 17, 17.5))
    body = foot.union(wall).edges(cq.selectors.BoxSelector((-31, 13, 2), (31, 15, 4))).fillet(5)
    body = body.faces("<Z").workplane().rect(44, 24, forConstruction=True).vertices().hole(5)
    return body.faces(">Y").workplane(centerOption="CenterOfMass").center(0, 6).hole(14).faces(">Z").edges().chamfer(1)


@fixture("gear_blank", "a gear of twelve straight teeth with a keyed bore")
def gear_blank():
    gear = cq.Workplane().circle(16).extrude(8)
    tooth = cq.Workplane().polyline([(15.5, -2.4), (20, -1.2), (20, 1.2), (15.5, 2.4)]).close().extrude(8)
    for k in range(12):
        gear = gear.union(tooth.rotate((0, 0, 0), (0, 0, 1), 30 * k))
    return gear.cut(cq.Workplane().circle(5).extrude(8)).cut(cq.Workplane().rect(3, 13).extrude(8))
