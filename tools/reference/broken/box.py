"""A box, whole or with a lid that has something wrong with it."""

from __future__ import annotations

from typing import Callable

from hand.topology import box_polygons
from part21 import TRUE, Ref
from step_model import StepModel

BOX = [[0.0, 0.0, 0.0], [30.0, 20.0, 10.0]]
#: Its area.
WHOLE = 2200.0


def box(schema: str | None = None) -> StepModel:
    model = StepModel(*([schema] if schema else []))
    model.product("box", [model.box(*BOX)])
    return model


def box_with(face: Callable[[StepModel], Ref]) -> StepModel:
    """A box whose lid, the side at high z, is written by `face`."""
    model = StepModel()
    faces = model.box_faces(*BOX, 5)
    model.product("box", [model.solid([*faces, face(model)])])
    return model


LID = box_polygons(*BOX)[5]
OPEN = 1600.0


def lid_on(surface: Callable[[StepModel], Ref]) -> StepModel:
    """A box whose lid lies on a surface that is no surface."""

    def face(model: StepModel) -> Ref:
        bound = model.add("FACE_OUTER_BOUND", "", model.polygon(*LID), TRUE)
        return model.add("ADVANCED_FACE", "", [bound], surface(model), TRUE)

    return box_with(face)


def lid_within(curve: Callable[[StepModel], Ref]) -> StepModel:
    """A box whose lid has one edge on a curve that is no curve (another edge than its neighbour's)."""

    def face(model: StepModel) -> Ref:
        uses: list = [model.straight(a, b) for a, b in zip(LID, LID[1:] + LID[:1])]
        uses[0] = (model.edge(LID[0], LID[1], curve(model)), True)
        bound = model.add("FACE_OUTER_BOUND", "", model.loop(*uses), TRUE)
        return model.add("ADVANCED_FACE", "", [bound], model.plane(LID[0]), TRUE)

    return box_with(face)
