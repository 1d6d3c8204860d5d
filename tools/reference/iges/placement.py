"""Transformation matrices (124) on every level."""

from __future__ import annotations

from math import cos, pi, sin

from iges.catalogue import iges
from iges.structure import PIN, totals, turn_z
from iges_brep import box_solid
from iges_model import IgesModel, after, around, box_sides, moved, shift
from step_model import polygon_figures

BOX = ((0.0, 0.0, 0.0), (30.0, 20.0, 10.0))
#: About an axis that is none of the coordinate axes: a third of a turn round (1, 1, 1), then moved.
CYCLE = ((0.0, 0.0, 1.0, 5.0), (1.0, 0.0, 0.0, 6.0), (0.0, 1.0, 0.0, 7.0))
MIRROR = ((-1.0, 0.0, 0.0, 4.0), (0.0, 1.0, 0.0, 0.0), (0.0, 0.0, 1.0, 0.0))


def tilted(angle: float, at=(0.0, 0.0, 0.0)) -> tuple:
    c, s = cos(angle), sin(angle)
    return ((1.0, 0.0, 0.0, at[0]), (0.0, c, -s, at[1]), (0.0, s, c, at[2]))


SKEW = after(turn_z(0.7, (3.0, -2.0, 8.0)), tilted(0.4))


@iges("matrix_on_solid", "a transformation on a solid (186)")
def on_solid():
    model = IgesModel("matrix_on_solid")
    box_solid(model, *BOX, transformation=model.matrix(SKEW))
    return model, totals((*BOX, SKEW))


@iges(
    "matrix_on_faces_of_solid", "a transformation on the plane surfaces of a solid, whose edges stand where they should"
)
def on_surfaces_of_solid():
    model = IgesModel("matrix_on_faces_of_solid")
    box_solid(model, *BOX)
    # Each plane is written at the origin, and moved to its place.
    for entity in [e for e in model.entities if e.kind == 190]:
        x, y, z = model[entity.parameters[0]].parameters[:3]
        entity.parameters[0] = model.point((0.0, 0.0, 0.0))
        entity.transformation = model.matrix(shift(x, y, z))
    return model, model.reference(volume=6000.0)


def moved_faces(model: IgesModel, rows, nested: bool = False) -> dict:
    """Six trimmed planes, each with the transformation."""
    for side in box_sides(*BOX):
        matrix = model.matrix(rows) if not nested else nested_matrix(model)
        face = model.polygon(*side, transformation=matrix)
        area, _, centroid = polygon_figures(side)
        figures = model.faces[-1]
        figures.centroid, figures.box = moved(rows, centroid), around([[moved(rows, p) for p in side]])
        assert figures.entity == face and area == figures.area
    return model.reference(volume=6000.0)


def nested_matrix(model: IgesModel) -> int:
    """SKEW in two steps: a matrix whose own directory entry points to another."""
    outer = model.matrix(turn_z(0.7, (3.0, -2.0, 8.0)))
    return model.matrix(tilted(0.4), transformation=outer)


@iges("matrix_on_trimmed_surfaces", "a transformation on each trimmed surface (144)")
def on_trimmed():
    model = IgesModel("matrix_on_trimmed_surfaces")
    return model, moved_faces(model, SKEW)


@iges("matrix_nested", "a transformation that has a transformation, on each trimmed surface")
def nested():
    model = IgesModel("matrix_nested")
    return model, moved_faces(model, SKEW, nested=True)


@iges("matrix_nested_on_solid", "a transformation that has a transformation, on a solid")
def nested_on_solid():
    model = IgesModel("matrix_nested_on_solid")
    box_solid(model, *BOX, transformation=nested_matrix(model))
    return model, totals((*BOX, SKEW))


@iges("matrix_inches", "a nested transformation in a file of inches: translations are in the file's unit")
def in_inches():
    model = IgesModel("matrix_inches", unit=1, unit_name="INCH")
    box_solid(model, (0.0, 0.0, 0.0), (3.0, 2.0, 1.0), transformation=nested_matrix(model))
    rows = tuple((*row[:3], 25.4 * row[3]) for row in SKEW)
    return model, totals(((0.0, 0.0, 0.0), (76.2, 50.8, 25.4), rows))


@iges("matrix_on_curves_and_surfaces", "each line and each plane of a box has a transformation of its own")
def on_curves_and_surfaces():
    model = IgesModel("matrix_on_curves_and_surfaces")
    for side in box_sides(*BOX):
        area, normal, centroid = polygon_figures(side)
        lines = []
        for a, b in zip(side, (*side[1:], side[0])):
            # A line along x from the origin, moved into place.
            there = tuple(q - p for p, q in zip(a, b))
            lines.append(
                model.line(
                    (1.0, 2.0, 3.0),
                    tuple(1.0 + k + c for k, c in enumerate(there)),
                    transformation=model.matrix(shift(*(p - 1.0 - k for k, p in enumerate(a)))),
                )
            )
        plane = model.plane((0.0, 0.0, 0.0), normal, transformation=model.matrix(shift(*side[0])))
        face = model.trimmed(plane, model.composite(lines))
        model.know(face, "plane", area, centroid, around([side]))
    return model, model.reference(volume=6000.0)


@iges("matrix_mirrored", "a mirroring transformation (124 form 1) on a solid")
def mirrored():
    model = IgesModel("matrix_mirrored")
    rows = after(SKEW, MIRROR)
    box_solid(model, *BOX, transformation=model.matrix(rows, form=1))
    return model, totals((*BOX, rows))


@iges("matrix_mirrored_faces", "a mirroring transformation on each trimmed surface")
def mirrored_faces():
    model = IgesModel("matrix_mirrored_faces")
    return model, moved_faces(model, after(SKEW, MIRROR))


@iges("matrix_on_revolved_surface", "a cylinder (120) and its round ends, written about x and turned upright")
def on_revolved():
    model = IgesModel("matrix_on_revolved_surface")
    place = lambda: model.matrix(CYCLE)  # noqa: E731
    # CYCLE takes z to x, x to y, y to z.
    axis = model.line((0.0, 0.0, 0.0), (0.0, 0.0, 1.0))
    generatrix = model.line((10.0, 0.0, 0.0), (10.0, 0.0, 30.0))
    wall = model.add(120, [axis, generatrix, 0.0, 2 * pi], transformation=place())
    model.know(wall, "cylinder", 600 * pi, (20.0, 6.0, 7.0), [[5.0, -4.0, -3.0], [35.0, 16.0, 17.0]])
    for z in (0.0, 30.0):
        x = 5.0 + z
        rim = model.circle((0.0, 0.0), 10.0, z, transformation=place())
        plane = model.plane((0.0, 0.0, z), transformation=place())
        cap = model.trimmed(plane, rim)
        model.know(cap, "plane", 100 * pi, (x, 6.0, 7.0), [[x, -4.0, -3.0], [x, 16.0, 17.0]])
    return model, model.reference(volume=3000 * pi)


@iges("matrix_on_group_members", "a group's members keep their own transformations")
def on_members():
    model = IgesModel("matrix_on_group_members")
    members = [box_solid(model, *PIN, status="00020000", transformation=model.matrix(rows)) for rows in (SKEW, CYCLE)]
    model.add(402, [2, *members], form=7)
    return model, totals((*PIN, SKEW), (*PIN, CYCLE))


@iges("matrix_identity", "a transformation that changes nothing, and one of a whole turn")
def identity():
    model = IgesModel("matrix_identity")
    box_solid(model, *PIN, transformation=model.matrix(shift(0, 0, 0)))
    box_solid(model, (10.0, 0.0, 0.0), (14.0, 3.0, 2.0), transformation=model.matrix(turn_z(2 * pi)))
    return model, totals(PIN, ((10.0, 0.0, 0.0), (14.0, 3.0, 2.0)))
