"""Colours, levels, what is blanked, and curves and points beside faces."""

from __future__ import annotations

from math import pi

from iges.catalogue import iges
from iges.loose import loose_box
from iges.structure import PIN, definition, group, instance, totals
from iges_brep import Brep, box_solid
from iges_deck import BLANKED, FREE, MEMBER, PART
from iges_model import IgesModel, box_sides, shift

BOX = ((0.0, 0.0, 0.0), (30.0, 20.0, 10.0))
#: Areas of the box's sides, in the order of `box_sides`.
SIDES = [200.0, 200.0, 300.0, 300.0, 600.0, 600.0]


def colour(model: IgesModel, red: float, green: float, blue: float, name: str | None = None) -> int:
    """A colour definition (314), in percent; returns what a colour field holds."""
    values = [float(red), float(green), float(blue), *([name] if name else [])]
    return -model.add(314, values, status="00000200")


def hexadecimal(red: float, green: float, blue: float) -> str:
    return "#" + "".join(f"{round(255 * c / 100):02x}" for c in (red, green, blue)) + "ff"


#: Colour numbers 1 to 8.
STANDARD = [
    (0, 0, 0),
    (100, 0, 0),
    (0, 100, 0),
    (0, 0, 100),
    (100, 100, 0),
    (100, 0, 100),
    (0, 100, 100),
    (100, 100, 100),
]
RED, BLUE, GREY = (100.0, 0.0, 0.0), (0.0, 20.0, 100.0), (60.0, 60.0, 60.0)


@iges("colour_definitions", "six trimmed planes with a colour definition (314) each, one with a name")
def definitions():
    model = IgesModel("colour_definitions")
    colours = [(100, 0, 0), (0, 60, 20), (0, 20, 100), (60, 60, 60), (12.5, 50, 75), (100, 100, 100)]
    for k, (polygon, percent) in enumerate(zip(box_sides(*BOX), colours)):
        model.polygon(*polygon, color=colour(model, *percent, "paint" if k == 3 else None))
    areas = {hexadecimal(*percent): area for percent, area in zip(colours, SIDES)}
    return model, {**model.reference(volume=6000.0), "colours": areas}


@iges("colour_numbers", "eight faces with the standard's colour numbers 1 to 8, and one without")
def numbers():
    model = IgesModel("colour_numbers")
    areas = {}
    for k in range(9):
        x = 10.0 * k
        polygon = [(x, 0.0, 0.0), (x + 8.0, 0.0, 0.0), (x + 8.0, 5.0 + k, 0.0), (x, 5.0 + k, 0.0)]
        model.polygon(*polygon, color=k)
        areas["none" if k == 0 else hexadecimal(*STANDARD[k - 1])] = 8.0 * (5.0 + k)
    return model, {**model.reference(), "colours": areas}


@iges("colour_on_solid", "a coloured solid (186): its faces have none of their own")
def on_solid():
    model = IgesModel("colour_on_solid")
    paint = colour(model, *BLUE)
    box_solid(model, *BOX, color=paint)
    return model, {**model.reference(volume=6000.0), "colours": {hexadecimal(*BLUE): 2200.0}}


@iges("colour_on_faces_of_solid", "a coloured solid with one face (510) of another colour")
def on_faces():
    model = IgesModel("colour_on_faces_of_solid")
    grey, red = colour(model, *GREY), colour(model, *RED)
    brep = Brep(model)
    faces = [brep.polygon(*side, color=red if k == 5 else 0) for k, side in enumerate(box_sides(*BOX))]
    brep.solid(faces, color=grey)
    areas = {hexadecimal(*GREY): 1600.0, hexadecimal(*RED): 600.0}
    return model, {**model.reference(volume=6000.0), "colours": areas}


@iges("colour_on_all_faces_of_solid", "a solid without colour whose faces (510) all have one")
def on_all_faces():
    model = IgesModel("colour_on_all_faces_of_solid")
    brep = Brep(model)
    brep.solid([brep.polygon(*side, color=2 + k) for k, side in enumerate(box_sides(*BOX))])
    areas = {hexadecimal(*STANDARD[1 + k]): area for k, area in enumerate(SIDES)}
    return model, {**model.reference(volume=6000.0), "colours": areas}


@iges("colour_on_shell", "an open shell whose colour its faces inherit")
def on_shell():
    model = IgesModel("colour_on_shell")
    brep = Brep(model)
    brep.shell(brep.box_faces(*BOX, 5), form=2, status=FREE, color=colour(model, *RED))
    return model, {**model.reference(), "colours": {hexadecimal(*RED): 1600.0}}


@iges("colour_in_subfigure", "a coloured solid in a subfigure that is placed twice")
def in_subfigure():
    model = IgesModel("colour_in_subfigure")
    paint = colour(model, *BLUE)
    pin = definition(model, "PIN", [box_solid(model, *PIN, status=PART, color=paint)])
    instance(model, pin)
    instance(model, pin, (10.0, 0.0, 0.0))
    boxes = [PIN, (*PIN, shift(10, 0, 0))]
    return model, {**totals(*boxes), "colours": {hexadecimal(*BLUE): 104.0}}


@iges("colour_on_primitive", "a coloured block (150)")
def on_primitive():
    model = IgesModel("colour_on_primitive")
    model.add(150, [4.0, 3.0, 2.0], color=colour(model, *RED))
    reference = totals(PIN)
    del reference["faces"]
    return model, {**reference, "colours": {hexadecimal(*RED): 52.0}}


@iges("colour_pointer_wrong", "a colour field that points to no colour: no colour")
def pointer_wrong():
    model = IgesModel("colour_pointer_wrong")
    loose_box(model, color=-9999)
    return model, model.reference(volume=6000.0)


@iges("levels", "trimmed planes on levels 0, 1 and 40, and one on a list of levels (406 form 1)")
def levels():
    model = IgesModel("levels")
    several = model.add(406, [2, 3, 5], form=1, status=PART)
    for k, side in enumerate(box_sides(*BOX)):
        model.polygon(*side, level=(0, 1, 1, 40, 40, -several)[k])
    return model, model.reference(volume=6000.0)


@iges("blanked_faces", "two sides of a box are blanked: they are not shown")
def blanked_faces():
    model = IgesModel("blanked_faces")
    for k, side in enumerate(box_sides(*BOX)):
        model.polygon(*side, hidden=k in (1, 4))
    return model, model.reference()


@iges("blanked_solid", "one of two solids is blanked")
def blanked_solid():
    model = IgesModel("blanked_solid")
    box_solid(model, *BOX)
    box_solid(model, (40.0, 0.0, 0.0), (45.0, 5.0, 5.0), status=BLANKED)
    for face in model.faces[6:]:
        face.hidden = True
    return model, model.reference(volume=6000.0)


@iges("blanked_instance", "one of two instances of a subfigure is blanked")
def blanked_instance():
    model = IgesModel("blanked_instance")
    pin = definition(model, "PIN", [box_solid(model, *PIN, status=PART)])
    instance(model, pin)
    instance(model, pin, (10.0, 0.0, 0.0), status=BLANKED)
    return model, totals(PIN)


@iges("blanked_group", "a blanked group beside a box; its members are not blanked themselves, but shown only with it")
def blanked_group():
    model = IgesModel("blanked_group")
    group(model, [box_solid(model, *PIN, status=MEMBER)], "HIDDEN", status=BLANKED)
    box = ((10.0, 0.0, 0.0), (14.0, 3.0, 2.0))
    box_solid(model, *box)
    return model, totals(box)


@iges("curves_beside_solid", "free curves of many kinds beside a solid; blanked and subordinate curves do not count")
def curves_beside():
    model = IgesModel("curves_beside_solid")
    box_solid(model, *BOX)
    curves(model)
    model.line((0.0, 0.0, 30.0), (50.0, 0.0, 30.0))
    model.add(110, [0.0, 0.0, 31.0, 50.0, 0.0, 31.0], status=BLANKED)
    model.add(110, [0.0, 0.0, 32.0, 50.0, 0.0, 32.0], status="00000100")
    reference = model.reference(volume=6000.0)
    return model, {**reference, "closed": False, "free_curves": {"count": 4, "length_mm": LENGTH}}


#: Of the curves below.
LENGTH = 30.0 + 10 * pi + (5 * pi + 12.0) + 25.0


def curves(model: IgesModel) -> None:
    """A line, a circle, a composite curve and a polyline at z = 20."""
    model.add(110, [0.0, 0.0, 20.0, 30.0, 0.0, 20.0])
    model.circle((10.0, 10.0), 5.0, 20.0, status=FREE)
    parts = [
        model.arc((20.0, 10.0), (25.0, 10.0), (15.0, 10.0), 20.0),
        model.line((15.0, 10.0, 20.0), (15.0, -2.0, 20.0)),
    ]
    model.composite(parts, status=FREE)
    model.add(106, [1, 3, 20.0, 0.0, 5.0, 0.0, 15.0, 15.0, 15.0], form=11)


@iges("curves_alone", "curves without any face: a line, a circle, a composite, a polyline")
def curves_alone():
    model = IgesModel("curves_alone")
    curves(model)
    return model, {
        "area_mm2": 0.0,
        "volume_mm3": None,
        "bbox_mm": [[0.0, -2.0, 20.0], [30.0, 15.0, 20.0]],
        "closed": False,
        "solids": 0,
        "faces": 0,
        "free_curves": {"count": 4, "length_mm": LENGTH},
    }


@iges("curves_in_group", "curves that a group lists count as free; a coloured one among them")
def curves_in_group():
    model = IgesModel("curves_in_group")
    lines = [model.add(110, [0.0, 0.0, float(z), 30.0, 0.0, float(z)], status=MEMBER, color=2 + z) for z in range(3)]
    group(model, lines, "WIRES")
    return model, {
        "area_mm2": 0.0,
        "volume_mm3": None,
        "bbox_mm": [[0.0, 0.0, 0.0], [30.0, 0.0, 2.0]],
        "closed": False,
        "solids": 0,
        "faces": 0,
        "free_curves": {"count": 3, "length_mm": 90.0},
    }


@iges("points_beside_solid", "independent points (116), one with a coordinate left out, beside a solid")
def points_beside():
    model = IgesModel("points_beside_solid")
    box_solid(model, *BOX)
    model.add(116, [5.0, 5.0, 20.0, 0])
    model.add(116, [None, 7.0, 25.0])
    return model, {**model.reference(volume=6000.0), "closed": False}


@iges("annotation_beside_solid", "notes, lines of a drawing and a view beside a solid: only the solid is shown")
def annotation():
    model = IgesModel("annotation_beside_solid")
    box_solid(model, *BOX)
    note = [1, 9, 18.0, 4.0, 1, pi / 2, 0.0, 0, 0, 0.0, 0.0, 0.0, "A BOX; OK,"]
    model.add(212, note, status="00000100")
    model.add(410, [1, 1.0, 0, 0, 0, 0, 0, 0], status="00000100")
    model.add(404, [0, 0], status="00000100")
    return model, model.reference(volume=6000.0)
