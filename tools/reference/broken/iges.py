"""IGES files that are cut off, count wrong, point nowhere or round in circles."""

from __future__ import annotations

from broken.box import BOX, OPEN, WHOLE
from broken.expected import broken
from iges.curves import circle_spline
from iges.loose import loose_box
from iges.structure import PIN, definition, group, instance, named
from iges_brep import box_solid
from iges_deck import BLANKED, PART, Raw
from iges_model import IDENTITY, IgesModel, box_sides
from plane_curves import Spline

LID = box_sides(*BOX)[5]


def box_beside(name: str) -> IgesModel:
    """A good box of loose faces, to which damage is added."""
    model = IgesModel(name)
    loose_box(model, *BOX)
    return model


def lid_within(name: str, boundary) -> IgesModel:
    """A box whose lid has a boundary that `boundary` writes."""
    model = IgesModel(name)
    loose_box(model, *BOX, sides=range(5))
    model.trimmed(model.plane(LID[0]), boundary(model))
    return model


def lines_of(model: IgesModel) -> list[str]:
    return model.text().splitlines(keepends=True)


def only(model: IgesModel, letters: str) -> str:
    """The sections of these letters."""
    return "".join(line for line in lines_of(model) if line[72] in letters)


# Cut off


@broken("iges_truncated_in_start.igs", "IGES cut within the Start section", [2])
def truncated_in_start():
    return box_beside("box").text()[:70]


@broken("iges_truncated_after_start.igs", "IGES that is nothing but its Start section", [2])
def truncated_after_start():
    return only(box_beside("box"), "S")


@broken("iges_truncated_in_global.igs", "IGES cut within the Global section", [2])
def truncated_in_global():
    return box_beside("box").text()[: 81 * 2 + 40]


@broken("iges_truncated_in_directory.igs", "IGES cut within the Directory section: no parameters at all", [2])
def truncated_in_directory():
    model = box_beside("box")
    return only(model, "SG") + only(model, "D")[: 81 * 20 + 30]


@broken("iges_truncated_in_parameters.igs", "IGES cut in the middle of the Parameter section", [1, 2])
def truncated_in_parameters():
    model = box_beside("box")
    parameters = only(model, "P")
    return only(model, "SGD") + parameters[: len(parameters) // 2]


@broken("iges_truncated_near_end.igs", "IGES cut within the parameters of its last face", [1], [], OPEN)
def truncated_near_end():
    model = box_beside("box")
    return only(model, "SGD") + only(model, "P")[: -81 - 60]


# Pointers


@broken("iges_pointer_out_of_range.igs", "a trimmed surface whose surface is beyond the directory", [1], [], OPEN)
def pointer_out_of_range():
    model = IgesModel("box")
    loose_box(model, *BOX, sides=range(5))
    model.trimmed(99999, model.polyline(*LID))
    return model


@broken("iges_pointer_even.igs", "a boundary that points to the second line of a directory entry", [0, 1], [], OPEN)
def pointer_even():
    return lid_within("box", lambda model: model.polyline(*LID) + 1)


@broken("iges_pointer_zero.igs", "a boundary without any curve", [0, 1], [], OPEN)
def pointer_zero():
    return lid_within("box", lambda model: 0)


@broken("iges_pointer_to_wrong_type.igs", "a trimmed surface on a line, bounded by a plane", [1], [], OPEN)
def pointer_to_wrong_type():
    model = IgesModel("box")
    loose_box(model, *BOX, sides=range(5))
    model.trimmed(model.line(LID[0], LID[1]), model.plane())
    return model


@broken("iges_cycle_composite.igs", "a composite curve that contains itself", [0, 1], [], OPEN)
def cycle_composite():
    def boundary(model: IgesModel) -> int:
        curve = model.polyline(*LID)
        model[curve].parameters[1] = curve
        return curve

    return lid_within("box", boundary)


@broken("iges_cycle_matrix.igs", "two transformations that refer to each other, on one face", [0, 1], [], OPEN)
def cycle_matrix():
    model = IgesModel("box")
    loose_box(model, *BOX, sides=range(5))
    first = model.matrix(IDENTITY)
    model[first].transformation = model.matrix(IDENTITY, transformation=first)
    model.polygon(*LID, transformation=first)
    return model


@broken("iges_cycle_offset_surface.igs", "an offset surface of itself", [0, 1], [], WHOLE)
def cycle_offset_surface():
    model = box_beside("box")
    model.add(140, [0.0, 0.0, 1.0, 2.0, model.next()])
    return model


@broken("iges_cycle_subfigure.igs", "a subfigure that places itself, beside a box", [0, 1], [], WHOLE)
def cycle_subfigure():
    model = box_beside("box")
    use = instance(model, model.next() + 2, status=PART)
    figure = definition(model, "LOOP", [use, box_solid(model, *PIN, status=PART)])
    model[use].parameters[0] = figure
    instance(model, figure, (50.0, 0.0, 0.0))
    return model


@broken("iges_cycle_group.igs", "a group of itself, and two groups of each other", [0, 1], [], WHOLE)
def cycle_group():
    model = box_beside("box")
    group(model, [model.next()])
    first = group(model, [0])
    model[first].parameters[1] = group(model, [first])
    return model


@broken("iges_cycle_assembly.igs", "a solid assembly of itself, and a solid instance of itself", [0, 1], [], WHOLE)
def cycle_assembly():
    model = box_beside("box")
    model.add(184, [1, model.next(), 0])
    model.add(430, [model.next()])
    return model


@broken("iges_subfigure_doubling.igs", "forty subfigures, each with the one before twice: 2^40 boxes", [0, 1, 2])
def subfigure_doubling():
    model = IgesModel("box")
    figure = definition(model, "F0", [box_solid(model, *PIN, status=PART)])
    for level in range(1, 41):
        uses = [instance(model, figure, (k * 2.0**level, 0.0, 0.0), status=PART) for k in range(2)]
        figure = definition(model, f"F{level}", uses, depth=level)
    instance(model, figure)
    return model


@broken("iges_array_huge.igs", "an array of 2,000,000,000 columns and as many rows", [0, 1, 2])
def array_huge():
    model = box_beside("box")
    pin = definition(model, "PIN", [box_solid(model, *PIN, status=PART)])
    model.add(412, [pin, 1.0, 0.0, 0.0, 0.0, 2000000000, 2000000000, 10.0, 10.0, 0.0, 0])
    return model


# Counts and numbers


@broken("iges_parameters_too_few.igs", "a line of four numbers in the lid's boundary", [1], [], OPEN)
def parameters_too_few():
    def boundary(model: IgesModel) -> int:
        curve = model.polyline(*LID)
        model[model[curve].parameters[1]].parameters[4:] = []
        return curve

    return lid_within("box", boundary)


@broken("iges_parameters_none.igs", "a B-spline surface, a circle and a solid without any parameter", [1], [], WHOLE)
def parameters_none():
    model = box_beside("box")
    for kind in (128, 100, 186):
        model.add(kind, [])
    return model


@broken("iges_parameters_too_many.igs", "lines with nine numbers each: the first six count", [0, 1], [], WHOLE)
def parameters_too_many():
    model = box_beside("box")
    for entity in model.entities:
        if entity.kind == 110:
            entity.parameters += [1.0, 2.0, 3.0]
    return model


@broken("iges_count_huge_128.igs", "a B-spline surface that claims two thousand million poles a row", [1], [], WHOLE)
def count_huge_128():
    model = box_beside("box")
    surface = model.bilinear((0.0, 0.0, 20.0), (5.0, 0.0, 0.0), (0.0, 5.0, 0.0))
    model[surface].parameters[0] = 2000000000
    return model


@broken(
    "iges_count_huge_102.igs", "a boundary composed of 999,999,999 curves, of which four are listed", [0, 1], [], OPEN
)
def count_huge_102():
    def boundary(model: IgesModel) -> int:
        curve = model.polyline(*LID)
        model[curve].parameters[0] = 999999999
        return curve

    return lid_within("box", boundary)


@broken("iges_count_negative.igs", "a boundary composed of -3 curves", [0, 1], [], OPEN)
def count_negative():
    def boundary(model: IgesModel) -> int:
        curve = model.polyline(*LID)
        model[curve].parameters[0] = -3
        return curve

    return lid_within("box", boundary)


for _name, _text, _codes in (
    ("nan", "NAN", [1]),
    ("1e400", "1.E400", [1]),
    ("1e308", "1.D308", [1]),
    ("word", "WIDE", [1]),
):

    @broken(f"iges_number_{_name}.igs", f"a coordinate written {_text} in the lid's boundary", _codes, [], OPEN)
    def number(text=_text):
        def boundary(model: IgesModel) -> int:
            curve = model.polyline(*LID)
            model[model[curve].parameters[1]].parameters[0] = Raw(text)
            return curve

        return lid_within("box", boundary)


@broken("iges_spline_knots_decreasing.igs", "a boundary of B-splines whose knots fall", [0, 1], [], OPEN)
def spline_knots_decreasing():
    ring = circle_spline(5.0)
    poles = [(x + 15.0, y + 10.0, 10.0) for x, y in ring.poles]
    return lid_within("box", lambda model: model.spline(Spline(2, poles, ring.knots[::-1], ring.weights)))


@broken("iges_string_beyond_end.igs", "a name whose count reaches beyond the end of the file", [0, 1], [], WHOLE)
def string_beyond_end():
    model = box_beside("box")
    name = named(model, "x")
    model[name].parameters[1] = Raw("99999Hx")
    return model


@broken(
    "iges_global_string_beyond_end.igs", "a string in the Global section whose count swallows the rest of it", [0, 1, 2]
)
def global_string_beyond_end():
    return box_beside("box").text().replace("3Hbox", "9999Hbox", 1)


# The directory


@broken("iges_directory_not_numeric.igs", "letters in the directory entry of the lid's plane", [1], [], OPEN)
def directory_not_numeric():
    model = box_beside("box")
    last = [index for index, entity in enumerate(model.entities) if entity.kind == 108][-1]
    lines = lines_of(model)
    first = next(k for k, line in enumerate(lines) if line[72] == "D")
    for row in (first + 2 * last, first + 2 * last + 1):
        lines[row] = "   PLANE    THE     LID" + lines[row][23:]
    return "".join(lines)


@broken(
    "iges_parameter_pointer_beyond.igs",
    "a directory entry whose parameters are said to be beyond their section; the lines point back to it",
    [0, 1],
    [],
    OPEN,
)
def parameter_pointer_beyond():
    model = box_beside("box")
    last = [index for index, entity in enumerate(model.entities) if entity.kind == 108][-1]
    lines = lines_of(model)
    row = next(k for k, line in enumerate(lines) if line[72] == "D") + 2 * last
    lines[row] = lines[row][:8] + f"{99999:8d}" + lines[row][16:]
    return "".join(lines)


@broken("iges_directory_odd.igs", "the last directory entry lacks its second line", [0, 1], [], WHOLE)
def directory_odd():
    model = box_beside("box")
    model.add(116, [0.0, 0.0, 0.0])
    lines = lines_of(model)
    lines.pop(max(k for k, line in enumerate(lines) if line[72] == "D"))
    return "".join(lines)


@broken("iges_type_unknown.igs", "entities of types 9999, -5 and 600 beside a box", [0, 1], [], WHOLE)
def type_unknown():
    model = box_beside("box")
    for kind in (9999, -5, 600):
        model.add(kind, [1, 2, 3])
    return model


@broken("iges_all_blanked.igs", "a box all of whose faces are blanked", [0, 1, 2])
def all_blanked():
    model = IgesModel("box")
    loose_box(model, *BOX, status=BLANKED)
    return model


@broken("iges_only_annotation.igs", "a file with a note and nothing else", [2])
def only_annotation():
    model = IgesModel("note")
    model.add(212, [1, 4, 8.0, 4.0, 1, 1.5707963267949, 0.0, 0, 0, 0.0, 0.0, 0.0, "NOTE"], status="00000100")
    return model


@broken("iges_no_entities.igs", "all sections, but no entity", [2])
def no_entities():
    return IgesModel("nothing")


@broken("iges_binary.igs", "the binary form of IGES", [2], ["binary"])
def binary():
    lengths = b"".join(n.to_bytes(4, "big") for n in (32, 24, 8, 11, 52, 0, 80, 160, 240, 320, 400))
    return b"B" + (47).to_bytes(4, "big") + lengths + bytes(range(256))


@broken("iges_html.igs", "a web page that is called .igs", [2])
def html():
    return "<!DOCTYPE html>\n<html><head><title>404 Not Found</title></head><body>Not Found</body></html>\n"
