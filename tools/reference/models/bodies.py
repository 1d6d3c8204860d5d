"""Voids, several bodies, sheets, free curves: what a file may hold besides one solid."""

from math import pi

import cadquery as cq
from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeSolid, BRepBuilderAPI_Sewing
from OCP.TopoDS import TopoDS

from catalogue import fixture


@fixture(
    "hollow_ball",
    "a sphere with a concentric void: BREP_WITH_VOIDS",
    closed_form={"volume_mm3": 4 / 3 * pi * (1000 - 512), "area_mm2": 4 * pi * (100 + 64)},
)
def hollow_ball():
    return cq.Workplane().sphere(10).cut(cq.Workplane().sphere(8))


@fixture(
    "hollow_box_two_voids",
    "a box with a ball-shaped and a box-shaped void",
    closed_form={"volume_mm3": 40 * 20 * 20 - 4 / 3 * pi * 216 - 512, "area_mm2": 800 + 3200 + 4 * pi * 36 + 384},
)
def hollow_box_two_voids():
    ball = cq.Workplane().sphere(6).translate((-10, 0, 0))
    return cq.Workplane().box(40, 20, 20).cut(ball).cut(cq.Workplane().box(8, 8, 8).translate((10, 0, 0)))


@fixture(
    "solid_in_void",
    "a ball inside a hollow ball: two solids, one within the other's void",
    closed_form={"volume_mm3": 4 / 3 * pi * (1000 - 512 + 125)},
)
def solid_in_void():
    return cq.Compound.makeCompound([hollow_ball().val(), cq.Solid.makeSphere(5, angleDegrees1=-90)])


@fixture("several_solids", "five solids of one product")
def several_solids():
    return cq.Workplane().rarray(15, 1, 5, 1).rect(10, 10).extrude(5)


@fixture(
    "touching_solids",
    "two boxes that share a face exactly",
    closed_form={"volume_mm3": 2000.0, "area_mm2": 1200.0},
)
def touching_solids():
    return cq.Compound.makeCompound([cq.Solid.makeBox(10, 10, 10), cq.Solid.makeBox(10, 10, 10, cq.Vector(10, 0, 0))])


@fixture("sheet_open_shell", "a box without its lid: an open shell", closed_form={"area_mm2": 1600.0})
def sheet_open_shell():
    box = cq.Workplane().box(30, 20, 10)
    return cq.Shell.makeShell([face for face in box.faces().vals() if face.Center().z < 4.9])


@fixture("sheet_single_face", "a single plane face with two holes", closed_form={"area_mm2": 600 - pi * (16 + 9)})
def sheet_single_face():
    outer = cq.Wire.makePolygon([cq.Vector(0, 0), cq.Vector(30, 0), cq.Vector(30, 20), cq.Vector(0, 20)], close=True)
    holes = [cq.Wire.makeCircle(r, cq.Vector(x, 10, 0), cq.Vector(0, 0, 1)) for r, x in [(4, 8), (3, 20)]]
    return cq.Face.makeFromWires(outer, holes)


@fixture(
    "sheet_cylinder",
    "a tube without thickness: a closed surface with two free circles",
    closed_form={"area_mm2": 2 * pi * 5 * 12},
)
def sheet_cylinder():
    return [f for f in cq.Solid.makeCylinder(5, 12).Faces() if f.geomType() == "CYLINDER"][0]


@fixture("sheet_sphere", "a whole sphere as a sheet", closed_form={"area_mm2": 4 * pi * 49})
def sheet_sphere():
    return cq.Solid.makeSphere(7, angleDegrees1=-90, angleDegrees2=90).Faces()[0]


@fixture(
    "shell_closed_not_solid",
    "a closed shell that is not declared a solid",
    closed_form={"area_mm2": 2200.0},
)
def shell_closed_not_solid():
    return cq.Workplane().box(30, 20, 10).shells().val()


@fixture("shell_t_junction", "three plane faces that meet in one edge: not a manifold", closed_form={"area_mm2": 600.0})
def shell_t_junction():
    spots = [cq.Vector(10, 0), cq.Vector(-10, 0), cq.Vector(0, 10)]
    sewing = BRepBuilderAPI_Sewing(1e-6, True, True, True, True)
    for spot in spots:
        outline = [cq.Vector(), spot, spot + cq.Vector(0, 0, 20), cq.Vector(0, 0, 20)]
        sewing.Add(cq.Face.makeFromWires(cq.Wire.makePolygon(outline, close=True)).wrapped)
    sewing.Perform()
    return cq.Shape.cast(sewing.SewedShape())


@fixture(
    "solid_inside_out", "a box whose faces point inward, as some writers leave it", closed_form={"area_mm2": 2200.0}
)
def solid_inside_out():
    shell = cq.Workplane().box(30, 20, 10).shells().val().wrapped.Reversed()
    return cq.Shape.cast(BRepBuilderAPI_MakeSolid(TopoDS.Shell_s(shell)).Solid())


@fixture("wires", "free curves only: a polygon, a circle, a spline, an arc of an ellipse")
def wires():
    return cq.Compound.makeCompound(
        [
            cq.Wire.makePolygon([cq.Vector(0, 0), cq.Vector(10, 0), cq.Vector(10, 5)], close=True),
            cq.Wire.makeCircle(4, cq.Vector(20, 0, 0), cq.Vector(0, 1, 1)),
            cq.Edge.makeSpline([cq.Vector(0, 10), cq.Vector(5, 14, 3), cq.Vector(12, 9, -2)]),
            cq.Edge.makeEllipse(6, 3, angle1=20, angle2=250),
        ]
    )


@fixture("solid_sheet_and_wire", "a solid, a sheet and a free curve in one product")
def solid_sheet_and_wire():
    line = cq.Edge.makeLine(cq.Vector(20, 0), cq.Vector(20, 15, 5))
    patch = cq.Face.makePlane(10, 8, cq.Vector(-20, 0, 0), cq.Vector(1, 0, 1))
    return cq.Compound.makeCompound([cq.Solid.makeBox(10, 10, 10), patch, line])
