"""Subfigures, groups, arrays, assemblies and names."""

from __future__ import annotations

from itertools import product
from math import cos, pi, sin

import numpy as np

from iges.catalogue import iges
from iges_brep import box_solid
from iges_deck import MEMBER, PART
from iges_model import IDENTITY, IgesModel, after, around, box_sides, moved, shift

#: A pin: small enough that copies of it keep apart.
PIN = ((0.0, 0.0, 0.0), (4.0, 3.0, 2.0))
PIN_AREA, PIN_VOLUME = 52.0, 24.0
PLATE = ((0.0, 0.0, -2.0), (60.0, 40.0, 0.0))
PLATE_AREA, PLATE_VOLUME = 5200.0, 4800.0


def named(model: IgesModel, name: str) -> int:
    """A name property, type 406 form 15."""
    return model.add(406, [1, name], form=15, status=PART)


def definition(model: IgesModel, name: str, members, depth: int = 0) -> int:
    return model.add(308, [depth, name, len(members), *members], status="00010201")


def instance(model: IgesModel, figure: int, at=(0.0, 0.0, 0.0), scale: float | None = None, **options) -> int:
    return model.add(408, [figure, *map(float, at), scale], **options)


def group(model: IgesModel, members, name: str = "", form: int = 7, **options) -> int:
    properties = [named(model, name)] if name else []
    made = model.add(402, [len(members), *members], form=form, properties=properties, **options)
    if form in (1, 14):
        for member in members:
            model[member].back.append(made)
    return made


def scaled(scale: float, rows=IDENTITY) -> tuple:
    return after(rows, tuple(tuple(scale * v for v in row) for row in IDENTITY))


def turn_z(angle: float, at=(0.0, 0.0, 0.0)) -> tuple:
    c, s = cos(angle), sin(angle)
    return ((c, -s, 0.0, at[0]), (s, c, 0.0, at[1]), (0.0, 0.0, 1.0, at[2]))


def totals(*boxes, **more) -> dict:
    """The reference of boxes, each (low, high) or (low, high, placement)."""
    area = volume = 0.0
    moment, corners = np.zeros(3), []
    for low, high, *rows in boxes:
        rows = rows[0] if rows else IDENTITY
        x, y, z = (b - a for a, b in zip(low, high))
        factor = abs(np.linalg.det(np.array(rows)[:, :3])) ** (1 / 3)
        own = 2 * (x * y + y * z + z * x) * factor**2
        area += own
        volume += x * y * z * factor**3
        moment += own * np.array(moved(rows, [(a + b) / 2 for a, b in zip(low, high)]))
        corners += [moved(rows, corner) for corner in product(*zip(low, high))]
    return {
        "area_mm2": area,
        "volume_mm3": volume,
        "bbox_mm": around([corners]),
        "closed": True,
        "solids": len(boxes),
        "faces": 6 * len(boxes),
        "area_centroid_mm": [float(c) for c in moment / area],
        "colours": {"none": area},
        **more,
    }


def part(name: str, instances: int, box) -> dict:
    figures = totals(box)
    return {
        "name": name,
        "instances": instances,
        **{key: figures[key] for key in ("solids", "faces", "closed", "area_mm2", "volume_mm3")},
    }


def root(name: str, *children: str) -> list[dict]:
    return [{"name": name, "children": [{"name": child} for child in children]}]


@iges("structure_408_offsets", "a subfigure placed three times by its offsets")
def offsets():
    model = IgesModel("structure_408_offsets")
    pin = definition(model, "PIN", [box_solid(model, *PIN, status=PART)])
    places = [(0.0, 0.0, 0.0), (20.0, 0.0, 0.0), (0.0, 15.0, 5.0)]
    for place in places:
        instance(model, pin, place)
    return model, totals(
        *((*PIN, shift(*place)) for place in places),
        tree=root("structure_408_offsets", *["PIN"] * 3),
        parts=[part("PIN", 3, PIN)],
    )


@iges("structure_408_scale", "a subfigure placed at scale 1 (left out) and 0.5, offset after it is scaled")
def scale():
    model = IgesModel("structure_408_scale")
    pin = definition(model, "PIN", [box_solid(model, (10.0, 0.0, 0.0), (14.0, 3.0, 2.0), status=PART)])
    instance(model, pin)
    instance(model, pin, (20.0, 8.0, 0.0), 0.5)
    box = ((10.0, 0.0, 0.0), (14.0, 3.0, 2.0))
    return model, totals(box, (*box, scaled(0.5, shift(20, 8, 0))))


@iges("structure_408_matrix", "a subfigure instance that a transformation matrix turns and moves")
def matrix():
    model = IgesModel("structure_408_matrix")
    pin = definition(model, "PIN", [box_solid(model, *PIN, status=PART)])
    rows = turn_z(pi / 2, (30.0, 0.0, 0.0))
    instance(model, pin)
    instance(model, pin, transformation=model.matrix(rows))
    return model, totals(PIN, (*PIN, rows))


@iges("structure_408_inches", "subfigure offsets and matrices in a file of inches")
def inches():
    model = IgesModel("structure_408_inches", unit=1, unit_name="INCH")
    pin = definition(model, "PIN", [box_solid(model, *PIN, status=PART)])
    rows = turn_z(pi / 2, (30.0, 0.0, 0.0))
    instance(model, pin, (5.0, 6.0, 7.0))
    instance(model, pin, transformation=model.matrix(rows))
    millimetres = tuple(tuple(25.4 * c for c in corner) for corner in PIN)
    inch = lambda rows: tuple((*row[:3], 25.4 * row[3]) for row in rows)  # noqa: E731
    return model, totals((*millimetres, inch(shift(5, 6, 7))), (*millimetres, inch(rows)))


@iges("structure_408_loose_faces", "a subfigure of six trimmed surfaces, placed twice")
def loose_faces():
    model = IgesModel("structure_408_loose_faces")
    faces = [model.polygon(*side, status=PART) for side in box_sides(*PIN)]
    pin = definition(model, "PIN", faces)
    instance(model, pin, (1.0, 0.0, 0.0))
    instance(model, pin, (11.0, 0.0, 0.0))
    return model, totals((*PIN, shift(1, 0, 0)), (*PIN, shift(11, 0, 0)), parts=[part("PIN", 2, PIN)])


@iges("structure_408_nested", "a subfigure of two instances of another, placed twice; next to it a plate")
def nested():
    model = IgesModel("structure_408_nested")
    pin = definition(model, "PIN", [box_solid(model, *PIN, status=PART)])
    rows = turn_z(pi / 2, (8.0, 0.0, 0.0))
    members = [
        instance(model, pin, status=PART),
        instance(model, pin, status=PART, transformation=model.matrix(rows)),
    ]
    pair = definition(model, "PAIR", members, depth=1)
    instance(model, pair, (5.0, 5.0, 0.0))
    instance(model, pair, (30.0, 20.0, 0.0), 2.0)
    box_solid(model, *PLATE)
    outer = [shift(5, 5, 0), scaled(2.0, shift(30, 20, 0))]
    return model, totals(PLATE, *((*PIN, after(a, b)) for a in outer for b in (IDENTITY, rows)))


@iges("structure_308_definition_with_matrix", "geometry in a subfigure has a transformation of its own")
def definition_with_matrix():
    model = IgesModel("structure_308_definition_with_matrix")
    own = turn_z(pi / 2)
    solid = box_solid(model, *PIN, status=PART, transformation=model.matrix(own))
    pin = definition(model, "PIN", [solid])
    instance(model, pin)
    instance(model, pin, (20.0, 0.0, 0.0), 1.0)
    return model, totals((*PIN, own), (*PIN, after(shift(20, 0, 0), own)))


@iges("structure_308_unused", "a subfigure that nothing places: it is not shown")
def unused():
    model = IgesModel("structure_308_unused")
    definition(model, "UNUSED", [box_solid(model, *PIN, status=PART)])
    box_solid(model, *PLATE)
    return model, totals(PLATE)


@iges("structure_402_form_7", "a named group without back pointers (402 form 7) of two boxes, and one box outside it")
def group_7():
    model = IgesModel("structure_402_form_7")
    boxes = [PIN, ((10.0, 0.0, 0.0), (14.0, 3.0, 2.0))]
    group(model, [box_solid(model, *box, status=MEMBER) for box in boxes], "PINS")
    box_solid(model, *PLATE)
    return model, totals(*boxes, PLATE)


for _form, _what in ((1, "with back pointers"), (14, "ordered, with back pointers"), (15, "ordered")):

    @iges(f"structure_402_form_{_form}", f"two named groups (402 form {_form}): {_what}")
    def groups(form=_form):
        name = f"structure_402_form_{form}"
        model = IgesModel(name)
        other = ((10.0, 0.0, 0.0), (14.0, 3.0, 2.0))
        group(model, [box_solid(model, *PIN, status=MEMBER), box_solid(model, *other, status=MEMBER)], "PINS", form)
        group(model, [box_solid(model, *PLATE, status=MEMBER)], "PLATES", form)
        return model, totals(PIN, other, PLATE, tree=root(name, "PINS", "PLATES"))


@iges("structure_402_nested", "a named group of two named groups")
def groups_nested():
    model = IgesModel("structure_402_nested")
    inner = [
        group(model, [box_solid(model, *PIN, status=MEMBER)], "PINS", status=MEMBER),
        group(model, [box_solid(model, *PLATE, status=MEMBER)], "PLATES", status=MEMBER),
    ]
    group(model, inner, "ALL")
    return model, totals(PIN, PLATE)


@iges("structure_402_of_loose_faces", "one group of six trimmed surfaces, without a name")
def group_of_faces():
    model = IgesModel("structure_402_of_loose_faces")
    group(model, [model.polygon(*side, status=MEMBER) for side in box_sides(*PLATE)])
    return model, model.reference(volume=PLATE_VOLUME)


@iges("structure_402_two_groups_share", "two groups that list the same box: it is there once")
def groups_share():
    model = IgesModel("structure_402_two_groups_share")
    shared = box_solid(model, *PLATE, status=MEMBER)
    group(model, [box_solid(model, *PIN, status=MEMBER), shared], "FIRST")
    group(model, [shared], "SECOND")
    return model, totals(PIN, PLATE)


def balls(places, radius: float = 2.0, **more) -> dict:
    """The reference of spheres, each at its centre."""
    count = len(places)
    area = count * 4 * pi * radius**2
    return {
        "area_mm2": area,
        "volume_mm3": count * 4 / 3 * pi * radius**3,
        "bbox_mm": around([[c + s * radius for c in place] for place in places] for s in (-1, 1)),
        "closed": True,
        "solids": count,
        "area_centroid_mm": [sum(place[k] for place in places) / count for k in range(3)],
        "colours": {"none": area},
        **more,
    }


def ball(model: IgesModel) -> int:
    """A subfigure of one sphere, which looks the same however it is turned."""
    return definition(model, "BALL", [model.add(158, [2.0, 0.0, 0.0, 0.0], status=PART)])


def grid(columns: int, rows: int, angle: float = 0.0) -> list[tuple]:
    """Where the members of an array stand, up each column in turn."""
    turn = turn_z(angle, (5.0, 6.0, 1.0))
    return [moved(turn, (10.0 * i, 12.0 * j, 0.0)) for i in range(columns) for j in range(rows)]


@iges("structure_412_rectangular", "a rectangular array (412) of three columns and two rows, turned by 30 degrees")
def rectangular():
    model = IgesModel("structure_412_rectangular")
    model.add(412, [ball(model), 1.0, 5.0, 6.0, 1.0, 3, 2, 10.0, 12.0, pi / 6, 0])
    return model, balls(grid(3, 2, pi / 6))


@iges("structure_412_scaled_boxes", "a rectangular array of boxes at half their size")
def rectangular_boxes():
    model = IgesModel("structure_412_scaled_boxes")
    pin = definition(model, "PIN", [box_solid(model, *PIN, status=PART)])
    model.add(412, [pin, 0.5, 5.0, 6.0, 1.0, 2, 2, 10.0, 12.0, 0.0, 0])
    return model, totals(*((*PIN, scaled(0.5, shift(*place))) for place in grid(2, 2)))


@iges("structure_412_positions_left_out", "an array that leaves out its first and last position (DO-DON'T flag 1)")
def rectangular_without():
    model = IgesModel("structure_412_positions_left_out")
    model.add(412, [ball(model), 1.0, 5.0, 6.0, 1.0, 3, 2, 10.0, 12.0, 0.0, 2, 1, 1, 6])
    return model, balls(grid(3, 2)[1:-1])


@iges(
    "structure_412_positions_listed",
    "an array of which only the first and the last position is shown (DO-DON'T flag 0)",
)
def rectangular_only():
    model = IgesModel("structure_412_positions_listed")
    model.add(412, [ball(model), 1.0, 5.0, 6.0, 1.0, 3, 2, 10.0, 12.0, 0.0, 2, 0, 1, 6])
    return model, balls([grid(3, 2)[0], grid(3, 2)[-1]])


def on_circle(count: int) -> list[tuple]:
    return [(5.0 + 20 * cos(0.5 + 0.9 * k), 6.0 + 20 * sin(0.5 + 0.9 * k), 1.0) for k in range(count)]


@iges("structure_414_circular", "a circular array (414) of five")
def circular():
    model = IgesModel("structure_414_circular")
    model.add(414, [ball(model), 5, 5.0, 6.0, 1.0, 20.0, 0.5, 0.9, 0])
    return model, balls(on_circle(5))


@iges("structure_414_positions_left_out", "a circular array that leaves out its second and fifth position")
def circular_without():
    model = IgesModel("structure_414_positions_left_out")
    model.add(414, [ball(model), 6, 5.0, 6.0, 1.0, 20.0, 0.5, 0.9, 2, 1, 2, 5])
    return model, balls([place for k, place in enumerate(on_circle(6), 1) if k not in (2, 5)])


@iges("structure_414_moved", "a circular array under a transformation")
def circular_moved():
    model = IgesModel("structure_414_moved")
    rows = ((0.0, 0.0, 1.0, 3.0), (1.0, 0.0, 0.0, 4.0), (0.0, 1.0, 0.0, 5.0))
    model.add(414, [ball(model), 4, 5.0, 6.0, 1.0, 20.0, 0.5, 0.9, 0], transformation=model.matrix(rows))
    return model, balls([moved(rows, place) for place in on_circle(4)])


@iges("structure_184_assembly", "a solid assembly (184): a solid twice with matrices, another one as it is")
def solid_assembly():
    model = IgesModel("structure_184_assembly")
    pin, plate = box_solid(model, *PIN, status=PART), box_solid(model, *PLATE, status=PART)
    places = [shift(5, 5, 0), turn_z(pi / 2, (40.0, 10.0, 0.0))]
    model.add(184, [3, pin, pin, plate, model.matrix(places[0]), model.matrix(places[1]), 0])
    return model, totals(*((*PIN, place) for place in places), PLATE)


@iges("structure_184_moved", "a solid assembly of primitives that a matrix moves as a whole")
def solid_assembly_moved():
    model = IgesModel("structure_184_moved")
    block = model.add(150, [4.0, 3.0, 2.0], status=PART)
    rows = turn_z(pi / 2, (1.0, 2.0, 3.0))
    places = [shift(10, 0, 0), shift(20, 0, 0)]
    model.add(184, [2, block, block, *map(model.matrix, places)], form=0, transformation=model.matrix(rows))
    reference = totals(*((*PIN, after(rows, place)) for place in places))
    del reference["faces"]
    return model, reference


@iges("structure_430_instances", "solid instances (430) of one block, placed by their transformations")
def solid_instances():
    model = IgesModel("structure_430_instances")
    block = box_solid(model, *PIN, status=PART)
    places = [shift(0, 0, 0), shift(10, 0, 0), turn_z(pi / 2, (30.0, 0.0, 0.0))]
    for place in places:
        model.add(430, [block], form=1, transformation=model.matrix(place))
    return model, totals(*((*PIN, place) for place in places))


@iges("structure_430_in_assembly", "a solid assembly of solid instances: two transformations each")
def instances_in_assembly():
    model = IgesModel("structure_430_in_assembly")
    block = model.add(150, [4.0, 3.0, 2.0], status=PART)
    inner, outer = turn_z(pi / 2, (7.0, 0.0, 0.0)), [shift(10, 0, 0), shift(20, 5, 0)]
    use = model.add(430, [block], status=PART, transformation=model.matrix(inner))
    model.add(184, [2, use, use, *map(model.matrix, outer)])
    reference = totals(*((*PIN, after(place, inner)) for place in outer))
    del reference["faces"]
    return model, reference


@iges("structure_names", "a solid named by a property (406 form 15), one by label and subscript, one by a label")
def names():
    model = IgesModel("structure_names")
    first = box_solid(model, *PIN, properties=[named(model, "pin of steel")])
    assert model[first].properties
    box_solid(model, (10.0, 0.0, 0.0), (14.0, 3.0, 2.0), label="PIN", subscript=12)
    box_solid(model, (20.0, 0.0, 0.0), (24.0, 3.0, 2.0), label="LASTPIN")
    return model, totals(*(((x, 0.0, 0.0), (x + 4.0, 3.0, 2.0)) for x in (0.0, 10.0, 20.0)))


@iges("structure_instance_names", "subfigure instances with names of their own (406 form 15)")
def instance_names():
    name = "structure_instance_names"
    model = IgesModel(name)
    pin = definition(model, "PIN", [box_solid(model, *PIN, status=PART)])
    for k, own in enumerate(("left", "right")):
        instance(model, pin, (10.0 * k, 0.0, 0.0), properties=[named(model, own)])
    places = [shift(0, 0, 0), shift(10, 0, 0)]
    tree = root(name, "PIN", "PIN")
    for node, own in zip(tree[0]["children"], ("left", "right")):
        node["instance"] = own
    return model, totals(*((*PIN, place) for place in places), tree=tree, parts=[part("PIN", 2, PIN)])


@iges("structure_group_of_instances", "a named group of subfigure instances and a solid")
def group_of_instances():
    model = IgesModel("structure_group_of_instances")
    pin = definition(model, "PIN", [box_solid(model, *PIN, status=PART)])
    members = [instance(model, pin, (10.0 * k, 10.0, 0.0), status=MEMBER) for k in range(3)]
    group(model, [*members, box_solid(model, *PLATE, status=MEMBER)], "TRAY")
    return model, totals(PLATE, *((*PIN, shift(10 * k, 10, 0)) for k in range(3)))
