"""Triangles over points that are not there."""

from __future__ import annotations


from broken.expected import broken
from step_model import AP242, StepModel


def tessellated(triangles, count: int = 4, normals=()) -> StepModel:
    """A tessellated face over the four corners of a square, with whatever triangles are asked for."""
    model = StepModel(AP242)
    points = [(0.0, 0.0, 0.0), (10.0, 0.0, 0.0), (10.0, 10.0, 0.0), (0.0, 10.0, 0.0)]
    list_ = model.add("COORDINATES_LIST", "", count, points)
    face = model.add("TRIANGULATED_FACE", "", list_, count, list(normals), None, [], triangles)
    shell = model.add("TESSELLATED_SHELL", "", [face], None)
    model.product("square", [shell], representation="TESSELLATED_SHAPE_REPRESENTATION")
    return model


@broken("tessellated_count_huge.step", "a coordinates list that claims four thousand million points", [0, 1], [], 100.0)
def tessellated_count_huge():
    return tessellated([(1, 2, 3), (1, 3, 4)], 4294967295)


@broken("tessellated_index_out_of_range.step", "a triangle over a point that is not there", [1], [], 50.0)
def tessellated_index_out_of_range():
    return tessellated([(1, 2, 3), (1, 3, 99)])


@broken("tessellated_index_zero.step", "triangles that count from zero or below", [1, 2], [])
def tessellated_index_zero():
    return tessellated([(0, 1, 2), (-1, 2, 3)])


@broken("tessellated_degenerate.step", "triangles over one point thrice, beside good ones", [0, 1], [], 100.0)
def tessellated_degenerate():
    return tessellated([(1, 2, 3), (1, 3, 4), (2, 2, 2), (1, 2, 1)])


@broken("tessellated_normals_wrong_count.step", "three normals for four points", [0, 1], [], 100.0)
def tessellated_normals_wrong_count():
    return tessellated([(1, 2, 3), (1, 3, 4)], normals=[(0.0, 0.0, 1.0)] * 3)
