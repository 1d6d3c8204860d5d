"""Arguments that are too few, too many, or of the wrong type."""

from __future__ import annotations


from broken.box import LID, OPEN, box_with, lid_on
from broken.expected import broken
from part21 import TRUE, Ref
from step_model import X, Z, StepModel


@broken(
    "arguments_too_few.step",
    "a PLANE without its placement, a face bound without its flag",
    [1],
    ["PLANE", "argument", "parameter"],
    OPEN,
)
def arguments_too_few():
    return lid_on(lambda model: model.add("PLANE", ""))


@broken("arguments_none.step", "a face without any argument", [1], ["ADVANCED_FACE", "argument", "parameter"], OPEN)
def arguments_none():
    return box_with(lambda model: model.add("ADVANCED_FACE"))


@broken("arguments_too_many.step", "a PLANE with five arguments: the first two count", [0, 1], [], OPEN)
def arguments_too_many():
    return lid_on(lambda model: model.add("PLANE", "", model.axis2(LID[0]), 1, 2, [3]))


@broken(
    "arguments_wrong_types.step", "a string for a radius, a list for a reference, a number for a flag", [1], [], OPEN
)
def arguments_wrong_types():
    return lid_on(lambda model: model.add("CYLINDRICAL_SURFACE", "", [model.axis2()], "ten"))


@broken("arguments_unset.step", "a PLANE whose placement is $", [1], ["PLANE", "$", "unset", "missing"], OPEN)
def arguments_unset():
    return lid_on(lambda model: model.add("PLANE", "", None))


@broken("bounds_not_a_list.step", "a face whose bounds are one reference, not a list", [0, 1], [], OPEN)
def bounds_not_a_list():
    def face(model: StepModel) -> Ref:
        bound = model.add("FACE_OUTER_BOUND", "", model.polygon(*LID), TRUE)
        return model.add("ADVANCED_FACE", "", bound, model.plane(LID[0]), TRUE)

    return box_with(face)


@broken("point_of_two_coordinates.step", "a point in space with two coordinates as the lid's origin", [0, 1], [], OPEN)
def point_of_two_coordinates():
    def plane(model: StepModel) -> Ref:
        point = model.add("CARTESIAN_POINT", "", (0.0, 0.0))
        return model.add(
            "PLANE", "", model.add("AXIS2_PLACEMENT_3D", "", point, model.direction(Z), model.direction(X))
        )

    return lid_on(plane)


@broken("loop_empty.step", "an edge loop without edges", [0, 1], [], OPEN)
def loop_empty():
    def face(model: StepModel) -> Ref:
        bound = model.add("FACE_OUTER_BOUND", "", model.add("EDGE_LOOP", "", []), TRUE)
        return model.add("ADVANCED_FACE", "", [bound], model.plane(LID[0]), TRUE)

    return box_with(face)


@broken("shell_empty.step", "a solid whose shell has no faces", [2], ["no ", "empty", "nothing"])
def shell_empty():
    model = StepModel()
    model.product("box", [model.solid([])])
    return model


@broken("plane_unbounded.step", "a plane face without any bound, which is infinite", [1], ["bound", "infinite"], OPEN)
def plane_unbounded():
    return box_with(lambda model: model.add("ADVANCED_FACE", "", [], model.plane(LID[0]), TRUE))


@broken("face_of_one_edge.step", "a loop of one straight edge, which bounds nothing", [0, 1], [], OPEN)
def face_of_one_edge():
    def face(model: StepModel) -> Ref:
        bound = model.add("FACE_OUTER_BOUND", "", model.loop(model.straight(LID[0], LID[1])), TRUE)
        return model.add("ADVANCED_FACE", "", [bound], model.plane(LID[0]), TRUE)

    return box_with(face)
