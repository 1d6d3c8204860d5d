"""Very large, very small, very thin, and far away."""

from math import pi

import cadquery as cq
from OCP.Geom import Geom_SphericalSurface
from OCP.gp import gp_Ax3, gp_Dir, gp_Pnt

from catalogue import StepOptions, fixture


@fixture(
    "thin_face",
    "a box 0.001 mm high: four sliver faces",
    closed_form={"area_mm2": 1200 + 0.1, "volume_mm3": 0.6},
)
def thin_face():
    return cq.Workplane().box(30, 20, 0.001)


@fixture(
    "tiny_faces",
    "a step of 0.001 mm by 0.001 mm in a block of 30 mm",
    closed_form={"volume_mm3": 6000 - 20 * 1e-6},
)
def tiny_faces():
    return (
        cq.Workplane("XZ")
        .polyline([(0, 0), (30, 0), (30, 9.999), (29.999, 9.999), (29.999, 10), (0, 10)])
        .close()
        .extrude(20)
    )


@fixture("tiny_hole", "a hole of 0.01 mm in a plate of 100 mm")
def tiny_hole():
    return cq.Workplane().box(100, 100, 1).faces(">Z").workplane().hole(0.01)


@fixture("narrow_groove", "a groove 0.002 mm wide round a shaft")
def narrow_groove():
    groove = cq.Workplane().circle(12).circle(9.5).extrude(0.002).translate((0, 0, 15))
    return cq.Workplane().circle(10).extrude(30).cut(groove)


@fixture("sliver_triangle", "a prism over a triangle 100 mm long and 0.01 mm wide", closed_form={"volume_mm3": 2.5})
def sliver_triangle():
    return cq.Workplane().polyline([(0, 0), (100, 0), (60, 0.01)]).close().extrude(5)


@fixture(
    "kilometre",
    "a pipe 2 km long: numbers of 1e6 mm",
    closed_form={"volume_mm3": pi * (400.0**2 - 350.0**2) * 2e6},
)
def kilometre():
    return cq.Workplane().circle(400).circle(350).extrude(2e6)


@fixture(
    "micrometre",
    "a rounded block of 20 micrometres in a file of millimetres",
    closed_form={"volume_mm3": (0.02 * 0.02 - (4 - pi) * 0.004**2) * 0.02},
)
def micrometre():
    return cq.Workplane().box(0.02, 0.02, 0.02).edges("|Z").fillet(0.004)


@fixture(
    "micrometre_unit",
    "a drilled block of 20 micrometres in a file of micrometres",
    step=StepOptions(unit="UM"),
    closed_form={"volume_mm3": (0.02 * 0.02 - pi * 0.005**2) * 0.02},
)
def micrometre_unit():
    return cq.Workplane().box(0.02, 0.02, 0.02).faces(">Z").workplane().hole(0.01)


@fixture(
    "far_from_origin",
    "a filleted box a kilometre from the origin: where 32-bit numbers fail",
    closed_form={
        "volume_mm3": 24 * 14 * 4 + 2 * 3 * (24 * 14 + 24 * 4 + 14 * 4) + pi * 9 * (24 + 14 + 4) + 36 * pi,
    },
)
def far_from_origin():
    return cq.Workplane().box(30, 20, 10).edges().fillet(3).translate((1e6, -2e6, 5e5))


@fixture("needle_and_plate", "a plate of one metre with a pin of 0.1 mm")
def needle_and_plate():
    return cq.Workplane().box(1000, 1000, 10).faces(">Z").workplane().circle(0.05).extrude(3)


@fixture("large_radius", "a nearly flat piece of a sphere of 100 m radius")
def large_radius():
    surface = Geom_SphericalSurface(gp_Ax3(gp_Pnt(0, 0, -1e5), gp_Dir(1, 0, 0), gp_Dir(0, 0, 1)), 1e5)
    face = cq.occ_impl.shapes.BRepBuilderAPI_MakeFace(surface, -2e-4, 2e-4, -1.5e-4, 1.5e-4, 1e-7).Face()
    return cq.Shape.cast(face)
