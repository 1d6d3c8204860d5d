"""References to nothing, to the wrong thing, and round in circles."""

from __future__ import annotations

from typing import Callable

from broken.box import BOX, OPEN, WHOLE, box_with, lid_on, lid_within
from broken.expected import broken
from part21 import DERIVED, FALSE, TRUE, Enum, Raw, Ref, Typed, parameter
from step_model import Z, StepModel


@broken("reference_missing_surface.step", "the lid's plane is not defined", [1], ["#99999"], OPEN)
def reference_missing_surface():
    return lid_on(lambda model: Ref(99999))


@broken("reference_missing_curve.step", "the curve of one of the lid's edges is not defined", [0, 1], ["#99999"], OPEN)
def reference_missing_curve():
    return lid_within(lambda model: Ref(99999))


@broken("reference_missing_face.step", "a face of the shell is not defined", [1], ["#99999"], OPEN)
def reference_missing_face():
    return box_with(lambda model: Ref(99999))


@broken("reference_missing_shell.step", "the solid's shell is not defined", [2], ["#99999"])
def reference_missing_shell():
    model = StepModel()
    model.product("box", [model.add("MANIFOLD_SOLID_BREP", "", Ref(99999))])
    return model


@broken("reference_wrong_type_surface.step", "the lid lies on a point", [1], ["CARTESIAN_POINT"], OPEN)
def reference_wrong_type_surface():
    return lid_on(lambda model: model.point((0.0, 0.0, 10.0)))


@broken(
    "reference_wrong_type_face.step", "a shell lists a product context as a face", [1], ["APPLICATION_CONTEXT"], OPEN
)
def reference_wrong_type_face():
    return box_with(lambda model: model.add("APPLICATION_CONTEXT", "not a face"))


@broken("reference_unknown_type.step", "the lid lies on a surface of an unknown kind", [1], ["FANCY_SURFACE"], OPEN)
def reference_unknown_type():
    return lid_on(lambda model: model.add("FANCY_SURFACE", "", model.axis2(), 1.0))


def itself(keyword: str, *parameters) -> Callable[[StepModel], Ref]:
    """An instance one of whose parameters, `Raw("@")`, is the instance."""

    def write(model: StepModel) -> Ref:
        ref = model.reserve()
        text = f"{keyword}(" + ",".join(_parameter(model, p) for p in parameters) + ")"
        model.keywords[ref] = keyword
        model.lines.append(f"#{int(ref)}={text.replace('@', f'#{int(ref)}')};")
        return ref

    return write


def _parameter(model: StepModel, value) -> str:
    return parameter(value(model) if callable(value) else value)


SELF = Raw("@")
CYCLES = {
    "offset_surface": ("", SELF, 1.0, FALSE),
    "rectangular_trimmed_surface": ("", SELF, 0.0, 1.0, 0.0, 1.0, TRUE, TRUE),
    "surface_of_linear_extrusion": ("", SELF, lambda model: model.vector(Z)),
    "plane": ("", SELF),
}

for _keyword, _parameters in CYCLES.items():

    @broken(
        f"cycle_{_keyword}.step",
        f"a {_keyword.upper()} that is built on itself",
        [1],
        ["cycle", "itself", "circular"],
        OPEN,
    )
    def cycle_surface(keyword=_keyword, parameters=_parameters):
        return lid_on(itself(keyword.upper(), *parameters))


@broken("cycle_curve.step", "a TRIMMED_CURVE over itself", [0, 1], ["cycle", "itself", "circular"], OPEN)
def cycle_curve():
    ends = ([Typed("PARAMETER_VALUE", 0.0)], [Typed("PARAMETER_VALUE", 1.0)], TRUE, Enum("PARAMETER"))
    return lid_within(itself("TRIMMED_CURVE", "", SELF, *ends))


@broken(
    "cycle_composite_curve.step",
    "two composite curves that contain each other",
    [0, 1],
    ["cycle", "itself", "circular"],
    OPEN,
)
def cycle_composite_curve():
    def curve(model: StepModel) -> Ref:
        first, second = model.reserve(), model.reserve()
        for a, b in ((first, second), (second, first)):
            segment = model.add("COMPOSITE_CURVE_SEGMENT", Enum("CONTINUOUS"), TRUE, b)
            model.define(a, "COMPOSITE_CURVE", "", [segment], FALSE)
        return first

    return lid_within(curve)


@broken("cycle_face.step", "an ORIENTED_FACE of itself", [1], ["cycle", "itself", "circular"], OPEN)
def cycle_face():
    return box_with(itself("ORIENTED_FACE", "", DERIVED, SELF, TRUE))


@broken(
    "cycle_shell.step", "an ORIENTED_CLOSED_SHELL of itself as a void", [0, 1], ["cycle", "itself", "circular"], WHOLE
)
def cycle_shell():
    model = StepModel()
    shell = model.add("CLOSED_SHELL", "", model.box_faces(*BOX))
    void = itself("ORIENTED_CLOSED_SHELL", "", DERIVED, SELF, TRUE)(model)
    model.product("box", [model.add("BREP_WITH_VOIDS", "", shell, [void])])
    return model


@broken(
    "cycle_placement.step",
    "a placement whose point is the placement",
    [1],
    ["cycle", "itself", "circular", "AXIS2_PLACEMENT_3D"],
    OPEN,
)
def cycle_placement():
    return lid_on(lambda model: model.add("PLANE", "", itself("AXIS2_PLACEMENT_3D", "", SELF, None, None)(model)))


@broken("cycle_unit.step", "a unit that is a multiple of itself", [0, 1], ["cycle", "itself", "circular", "unit"])
def cycle_unit():
    model = StepModel()
    ref = model.reserve()
    measure = model.add("LENGTH_MEASURE_WITH_UNIT", Typed("LENGTH_MEASURE", 12.0), ref)
    model.lines.append(f"#{int(ref)}=(CONVERSION_BASED_UNIT('FOOT',#{int(measure)}) LENGTH_UNIT() NAMED_UNIT(*));")
    model.product("box", [model.box(*BOX)], context=model.context(ref))
    return model


@broken(
    "cycle_mapped_item.step",
    "a representation that contains a mapped item of itself",
    [0, 1, 2],
    ["cycle", "itself", "circular"],
    WHOLE,
)
def cycle_mapped_item():
    model = StepModel()
    context, axes = model.default_context(), model.axis2()
    shape, map_ = model.reserve(), model.reserve()
    model.define(map_, "REPRESENTATION_MAP", axes, shape)
    item = model.add("MAPPED_ITEM", "", map_, model.axis2((5.0, 0.0, 0.0)))
    model.define(shape, "SHAPE_REPRESENTATION", "", [axes, model.box(*BOX), item], context)
    model.product_of("box", shape, axes, context)
    return model


@broken(
    "assembly_contains_itself.step", "an assembly that is its own child", [0, 1, 2], ["cycle", "itself", "circular"]
)
def assembly_contains_itself():
    model = StepModel()
    part = model.product("box", [model.box(*BOX)])
    top = model.product("top", representation="SHAPE_REPRESENTATION")
    model.place(part, top, "box")
    model.place(top, top, "again", (50.0, 0.0, 0.0))
    return model


@broken(
    "assembly_cycle_of_three.step",
    "three assemblies that contain one another in a ring: there is no root",
    [0, 1, 2],
    ["cycle", "itself", "circular", "root"],
)
def assembly_cycle_of_three():
    model = StepModel()
    part = model.product("box", [model.box(*BOX)])
    ring = [model.product(name, representation="SHAPE_REPRESENTATION") for name in ("first", "second", "third")]
    model.place(part, ring[0], "box")
    for child, parent in zip(ring, ring[1:] + ring[:1]):
        model.place(child, parent, "round", (50.0, 0.0, 0.0))
    return model


@broken(
    "assembly_doubling.step",
    "forty levels, each with the level below twice: 2^40 instances of a box",
    [0, 1, 2],
    ["instances", "too many"],
)
def assembly_doubling():
    model = StepModel()
    below = model.product("box", [model.box(*BOX)])
    for level in range(40):
        above = model.product(f"level {level}", representation="SHAPE_REPRESENTATION")
        model.place(below, above, "left")
        model.place(below, above, "right", (40.0 * 2.0**level, 0.0, 0.0))
        below = above
    return model


@broken("cycle_style.step", "an over-riding styled item that over-rides itself", [0, 1], [], WHOLE)
def cycle_style():
    model = StepModel()
    solid = model.box(*BOX)
    model.product("box", [solid])
    itself("OVER_RIDING_STYLED_ITEM", "", [], solid, SELF)(model)
    return model
