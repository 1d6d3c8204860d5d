"""The same few models in other units and schemas, with and without curves in the surfaces' parameters."""

from math import pi

import cadquery as cq

from catalogue import StepOptions, fixture
from models.holes import (
    cylinder_with_hole_across_seam,
    sphere_with_hole_off_axis,
    torus_with_hole_on_both_seams,
)
from models.splines import ellipsoid, spline_closed_extruded, spline_revolved


def flange() -> cq.Workplane:
    body = cq.Workplane().circle(20).extrude(5).faces(">Z").workplane().circle(10).extrude(15)
    return body.faces(">Z").workplane().hole(12).faces("<Z").edges().fillet(1)


for _name, _unit in {"inch": "INCH", "metre": "M", "centimetre": "CM", "foot": "FT"}.items():

    @fixture(
        f"unit_{_name}",
        f"a flange in a file whose unit is the {_name}",
        step=StepOptions(unit=_unit),
        meshes=_name == "inch",
    )
    def in_unit():
        return flange()


for _schema in ("AP203", "AP242"):

    @fixture(f"schema_{_schema.lower()}", f"a flange in {_schema}", step=StepOptions(schema=_schema), meshes=False)
    def in_schema():
        return flange()

    @fixture(
        f"schema_{_schema.lower()}_assembly",
        f"a coloured assembly in {_schema}, in inches",
        step=StepOptions(schema=_schema, unit="INCH"),
        meshes=_schema == "AP242",
    )
    def assembly_in_schema():
        tree = cq.Assembly(name="unit")
        tree.add(flange(), name="flange", color=cq.Color(0.1, 0.5, 0.3))
        tree.add(
            flange(), name="counterpart", color=cq.Color(0.7, 0.5, 0.3), loc=cq.Location((0, 0, -3), (1, 0, 0), 180)
        )
        return tree


BARE = StepOptions(pcurves=False)


@fixture(
    "bare_cylinder",
    "a cylinder without curves in parameters: the seam is a plain line used twice",
    step=BARE,
    meshes=False,
    closed_form={"volume_mm3": 3000 * pi},
)
def bare_cylinder():
    return cq.Workplane().circle(10).extrude(30)


@fixture("bare_cone_with_apex", "a cone to its apex without curves in parameters", step=BARE, meshes=False)
def bare_cone_with_apex():
    return cq.Solid.makeCone(10, 0, 25)


@fixture(
    "bare_sphere",
    "a whole sphere without curves in parameters",
    step=BARE,
    meshes=False,
    closed_form={"area_mm2": 400 * pi},
)
def bare_sphere():
    return cq.Workplane().sphere(10)


@fixture("bare_torus", "a whole torus without curves in parameters", step=BARE, meshes=False)
def bare_torus():
    return cq.Solid.makeTorus(20, 5)


@fixture(
    "bare_cylinder_with_hole_across_seam", "a hole in a seam, without curves in parameters", step=BARE, meshes=False
)
def bare_cylinder_with_hole_across_seam():
    return cylinder_with_hole_across_seam()


@fixture("bare_sphere_with_hole", "a drilled sphere without curves in parameters", step=BARE, meshes=False)
def bare_sphere_with_hole():
    return sphere_with_hole_off_axis()


@fixture("bare_torus_with_hole", "a torus drilled at both seams, without curves in parameters", step=BARE, meshes=False)
def bare_torus_with_hole():
    return torus_with_hole_on_both_seams()


@fixture(
    "bare_ellipsoid", "a closed B-spline with collapsed sides, without curves in parameters", step=BARE, meshes=False
)
def bare_ellipsoid():
    return ellipsoid()


@fixture(
    "bare_spline_closed_extruded", "a closed extruded spline without curves in parameters", step=BARE, meshes=False
)
def bare_spline_closed_extruded():
    return spline_closed_extruded()


@fixture("bare_spline_revolved", "a revolved spline without curves in parameters", step=BARE, meshes=False)
def bare_spline_revolved():
    return spline_revolved()


@fixture("bare_bracket", "a filleted box without curves in parameters", step=BARE, meshes=False)
def bare_bracket():
    return cq.Workplane().box(30, 20, 10).edges("|Z").fillet(4).faces(">Z").edges().fillet(1.5)
