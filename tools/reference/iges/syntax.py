"""Delimiters, lines, numbers, strings and units as files have them."""

from __future__ import annotations

import re
from typing import Callable

from iges.catalogue import iges
from iges.loose import loose_box
from iges.structure import PIN, PLATE, named, totals
from iges_brep import box_solid
from iges_deck import Layout, Raw
from iges_model import IgesModel, box_sides

BOX = ((0.0, 0.0, 0.0), (30.0, 20.0, 10.0))


def solid(name: str, layout: Layout | None = None, **fields):
    """A box as a solid, and its reference."""
    model = IgesModel(name, layout, **fields)
    box_solid(model, *BOX)
    return model, model.reference(volume=6000.0)


def rewritten(name: str, change: Callable[[list[str]], str | bytes]):
    """The same file with its lines, each of 80 columns, put together otherwise."""
    model, reference = solid(name)
    return change(model.text().splitlines()), reference


# Delimiters, numbers, strings


@iges("syntax_delimiters", "/ between parameters and # after them")
def delimiters():
    return solid("syntax_delimiters", Layout(separator="/", terminator="#"))


@iges("syntax_delimiters_in_strings", "strings that hold the delimiters")
def delimiters_in_strings():
    model = IgesModel("a, b; c", file_name="x;y,z.igs")
    box_solid(model, *BOX, properties=[named(model, "1H,,1H; and 5Hfalse;")])
    return model, model.reference(volume=6000.0)


@iges("syntax_string_across_lines", "strings that cross lines, in the Global section and in parameters")
def string_across_lines():
    long = " ".join(f"word{k}" for k in range(40))
    model = IgesModel("syntax_string_across_lines", author=long, file_name="C:\\" + "folder\\" * 20 + "box.igs")
    box_solid(model, *BOX, properties=[named(model, long)])
    return model, model.reference(volume=6000.0)


@iges("syntax_string_splits_count", "a string whose count ends a line, so that its text begins the next")
def string_splits_count():
    model = IgesModel("syntax_string_splits_count")
    model.layout = Layout(columns=9)
    box_solid(model, *BOX, properties=[named(model, "begins the next line")])
    return model, model.reference(volume=6000.0)


@iges("syntax_exponent_d", "all reals with the exponent letter D")
def exponent_d():
    return solid("syntax_exponent_d", Layout(exponent="D"))


@iges("syntax_numbers", "reals as integers, with signs, lower-case exponents, no leading or trailing digits")
def numbers():
    model = IgesModel("syntax_numbers")
    loose_box(model, *BOX)
    forms = {
        0.0: ["0", "-0.", "+0.0", ".0", "0.E5"],
        10.0: ["10", "+10.", "1.E1", "1.d+01", ".1e2"],
        20.0: ["20", "2.0E+1", "200.E-1", "2D1", "+.2e02"],
        30.0: ["30", "30.00", "3.e1", "0.3E2", "3000.D-2"],
    }
    count = 0
    for entity in model.entities:
        if entity.kind != 110:
            continue
        for k, value in enumerate(entity.parameters):
            entity.parameters[k] = Raw(forms[value][count % 5])
            count += 1
    return model, model.reference(volume=6000.0)


@iges("syntax_defaulted_fields", "fields left out: zero coordinates, counts, flags, most of the Global section")
def defaulted():
    model = IgesModel("syntax_defaulted_fields", scale=None, largest=None, author=None, system=None, version=None)
    loose_box(model, *BOX)
    for entity in model.entities:
        if entity.kind == 110:
            entity.parameters = [value or None for value in entity.parameters]
        elif entity.kind == 108:
            entity.parameters = [value or None for value in entity.parameters]
        elif entity.kind == 144:
            # The number of inner boundaries is left out.
            entity.parameters[2] = None
    return model, model.reference(volume=6000.0)


@iges("syntax_trailing_fields_left_out", "records that end before their last fields, which are zero")
def trailing():
    model = IgesModel("syntax_trailing_fields_left_out")
    loose_box(model, *BOX)
    for entity in model.entities:
        if entity.kind == 108:
            # The display symbol's place and size.
            entity.parameters = entity.parameters[:5]
        elif entity.kind == 142:
            entity.parameters = entity.parameters[:4]
    return model, model.reference(volume=6000.0)


@iges("syntax_blanks_in_parameters", "blanks around numbers, and one parameter a line")
def blanks():
    model = IgesModel("syntax_blanks_in_parameters")
    model.layout = Layout(columns=24)
    loose_box(model, *BOX)
    for entity in model.entities:
        if entity.kind == 110:
            entity.parameters = [Raw(f"  {value!r} ") for value in entity.parameters]
    return model, model.reference(volume=6000.0)


@iges("syntax_comments_after_records", "text after a record's end, which is nobody's")
def comments():
    model = IgesModel("syntax_comments_after_records")
    box_solid(model, *BOX)

    def commented(line: str) -> str:
        text = line[:64].rstrip()
        if line[72] == "P" and text.endswith(";") and len(text) < 50:
            return (text + " a note, 1;").ljust(64) + line[64:]
        return line

    lines = [commented(line) for line in model.text().splitlines()]
    return "\n".join(lines) + "\n", model.reference(volume=6000.0)


# Lines


@iges("syntax_crlf", "lines that end with CR LF")
def crlf():
    return solid("syntax_crlf", Layout(line_end="\r\n"))


@iges("syntax_cr", "lines that end with CR alone")
def cr():
    return solid("syntax_cr", Layout(line_end="\r"))


@iges("syntax_mixed_line_ends", "LF, CR LF and CR in turn")
def mixed_ends():
    ends = ("\n", "\r\n", "\r")
    return rewritten(
        "syntax_mixed_line_ends",
        lambda lines: "".join(line + ends[k // 3 % 3] for k, line in enumerate(lines)).encode(),
    )


@iges("syntax_no_line_ends", "records of 80 bytes without any line end")
def no_ends():
    return rewritten("syntax_no_line_ends", lambda lines: "".join(lines))


@iges("syntax_blank_lines", "blank lines between lines and sections, and at the end")
def blank_lines():
    def change(lines: list[str]) -> str:
        return "\n\n" + "".join(line + "\n" + ("\n" if k % 5 == 0 else "") for k, line in enumerate(lines)) + "\n  \n"

    return rewritten("syntax_blank_lines", change)


@iges("syntax_lower_case_sections", "section letters in lower case")
def lower_case():
    return rewritten(
        "syntax_lower_case_sections",
        lambda lines: "".join(line[:72] + line[72].lower() + line[73:] + "\n" for line in lines),
    )


@iges("syntax_long_lines", "lines longer than 80 columns")
def long_lines():
    return rewritten(
        "syntax_long_lines", lambda lines: "".join(f"{line}  card {k:5d} of a deck\n" for k, line in enumerate(lines))
    )


@iges("syntax_no_end_of_last_line", "the last line is short and has no line end")
def no_last_end():
    return rewritten("syntax_no_end_of_last_line", lambda lines: "\n".join(lines)[:-1].rstrip() + "1")


@iges("syntax_tabs", "tabs for blanks, to columns that are multiples of eight")
def tabs():
    def tabbed(line: str) -> str:
        fields = [line[k : k + 8] for k in range(0, 80, 8)]
        text = "".join(
            field.rstrip(" ") + "\t" if k < 9 and field.endswith("  ") else field for k, field in enumerate(fields)
        )
        return text + "\n"

    return rewritten("syntax_tabs", lambda lines: "".join(tabbed(line) for line in lines))


@iges("syntax_sequence_unpadded", "sequence numbers at the left, without zeros or blanks before them")
def unpadded():
    return rewritten(
        "syntax_sequence_unpadded",
        lambda lines: "".join(line[:73] + line[73:].strip().ljust(7) + "\n" for line in lines),
    )


@iges("syntax_sequence_zeros", "sequence numbers and pointers padded with zeros")
def zeros():
    def padded(line: str) -> str:
        if line[72] == "P":
            line = line[:65] + line[65:72].strip().rjust(7, "0") + line[72:]
        return line[:73] + line[73:].strip().rjust(7, "0") + "\n"

    return rewritten("syntax_sequence_zeros", lambda lines: "".join(map(padded, lines)))


@iges("syntax_directory_zeros_blank", "directory fields that are blank where others write 0")
def blank_fields():
    def change(lines: list[str]) -> str:
        out = []
        for line in lines:
            if line[72] == "D":
                fields = [line[k : k + 8] for k in range(0, 72, 8)]
                line = (
                    "".join("        " if field.strip() in ("0", "00000000") else field for field in fields) + line[72:]
                )
            out.append(line + "\n")
        return "".join(out)

    return rewritten("syntax_directory_zeros_blank", change)


@iges("syntax_status_with_blanks", "status numbers without leading zeros")
def short_status():
    def change(lines: list[str]) -> str:
        return "".join(
            re.sub(r"(0{1,7})(\d*)(D)", lambda m: " " * len(m[1]) + (m[2] or "0") + m[3], line) + "\n"
            if line[72] == "D" and line[64:72].strip("0 ") and not line[64:72].startswith(" ")
            else line + "\n"
            for line in lines
        )

    return rewritten("syntax_status_with_blanks", change)


@iges("syntax_terminate_wrong", "a Terminate section whose counts are wrong")
def terminate_wrong():
    return rewritten(
        "syntax_terminate_wrong",
        lambda lines: "\n".join([*lines[:-1], "S      9G      9D      9P      9".ljust(72) + "T      1"]) + "\n",
    )


@iges("syntax_terminate_missing", "no Terminate section")
def terminate_missing():
    return rewritten("syntax_terminate_missing", lambda lines: "\n".join(lines[:-1]) + "\n")


@iges("syntax_text_after_terminate", "lines after the Terminate section")
def after_terminate():
    return rewritten("syntax_text_after_terminate", lambda lines: "\n".join([*lines, "END OF FILE", "", "\x1a"]) + "\n")


@iges("syntax_start_long", "a Start section of many lines, some of which look like other sections")
def start_long():
    model = IgesModel("syntax_start_long")
    model.start = ["A long prologue; 1H,,1H;", "     144       1       0", *(f"line {k}" for k in range(30)), ""]
    box_solid(model, *BOX)
    return model, model.reference(volume=6000.0)


@iges("syntax_latin1", "names with letters of ISO 8859-1: one byte each")
def latin1():
    model = IgesModel("syntax_latin1", author="J\u00f6rg M\u00fcller")
    box_solid(model, *BOX, properties=[named(model, "Geh\u00e4use \u00d8 5")])
    return model.text().encode("latin-1"), model.reference(volume=6000.0)


@iges("syntax_parameters_out_of_order", "the Parameter section lists the entities backward")
def out_of_order():
    model = IgesModel("syntax_parameters_out_of_order")
    loose_box(model, *BOX)
    sections = model.sections()
    blocks = []
    for k in range(0, len(sections["D"]), 2):
        first, count = int(sections["D"][k][8:16]), int(sections["D"][k + 1][24:32])
        blocks.append(sections["P"][first - 1 : first - 1 + count])
    lines, places = [], {}
    for k in reversed(range(len(blocks))):
        places[k] = len(lines) + 1
        lines += blocks[k]
    for k in range(len(blocks)):
        line = sections["D"][2 * k]
        sections["D"][2 * k] = line[:8] + f"{places[k]:8d}" + line[16:]
    sections["P"] = lines
    sections["T"] = ["".join(f"{letter}{len(rows):7d}" for letter, rows in sections.items())]
    text = "".join(
        row.ljust(72) + f"{letter}{number:7d}\n"
        for letter, rows in sections.items()
        for number, row in enumerate(rows, 1)
    )
    return text, model.reference(volume=6000.0)


@iges("syntax_null_entities", "null entities (type 0) among the others, where something was deleted")
def null_entities():
    model = IgesModel("syntax_null_entities")
    for side in box_sides(*BOX):
        model.add(0, [1, 2, 3])
        model.polygon(*side)
    return model, model.reference(volume=6000.0)


@iges("syntax_version_5_1", "a Global section of 24 fields, as version 5.1 has it")
def old_version():
    model = IgesModel("syntax_version_5_1", version=9)
    box_solid(model, *BOX)
    fields = model.head.fields
    model.head.fields = lambda layout: fields(layout)[:24]
    return model, model.reference(volume=6000.0)


@iges("syntax_back_pointers", "properties, names and back pointers after the parameters of many entities")
def back_pointers():
    model = IgesModel("syntax_back_pointers")
    first = box_solid(model, *PIN)
    box_solid(model, *PLATE)
    note = named(model, "name")
    for entity in model.entities:
        if entity.kind in (110, 190, 502, 504, 508, 510, 514, 186):
            entity.back, entity.properties = [first], [note]
    return model, totals(PIN, PLATE)


# Units


UNITS = [
    ("inch", 1, "INCH", 25.4),
    ("inch_by_name_in", 1, "IN", 25.4),
    ("millimetre", 2, "MM", 1.0),
    ("name_counts", 3, "CM", 10.0),
    ("name_counts_foot", 3, "FT", 304.8),
    ("name_counts_metre", 3, "M", 1000.0),
    ("foot", 4, "FT", 304.8),
    ("mile", 5, "MI", 1609344.0),
    ("metre", 6, "M", 1000.0),
    ("kilometre", 7, "KM", 1e6),
    ("mil", 8, "MIL", 0.0254),
    ("micrometre", 9, "UM", 1e-3),
    ("centimetre", 10, "CM", 10.0),
    ("microinch", 11, "UIN", 25.4e-6),
]

for _name, _flag, _unit, _factor in UNITS:

    @iges(f"unit_{_name}", f"units flag {_flag} with the name {_unit}")
    def unit_file(name=_name, flag=_flag, unit=_unit, factor=_factor):
        # References end at the twelfth decimal.
        size = 1.0 if factor > 1e-4 else 1000.0
        model = IgesModel(f"unit_{name}", unit=flag, unit_name=unit)
        loose_box(model, (0.0, 0.0, 0.0), (size, 2 * size, size / 2))
        return model, model.reference(volume=size**3, scale=factor)


@iges("unit_flag_left_out", "neither units flag nor name: inches, as the standard says")
def unit_left_out():
    model = IgesModel("unit_flag_left_out", unit=None, unit_name=None)
    loose_box(model, (0.0, 0.0, 0.0), (1.0, 2.0, 0.5))
    return model, model.reference(volume=1.0, scale=25.4)


@iges("unit_name_disagrees", "units flag 2 with the name INCH: the flag counts")
def unit_disagrees():
    model = IgesModel("unit_name_disagrees", unit=2, unit_name="INCH")
    loose_box(model, (0.0, 0.0, 0.0), (1.0, 2.0, 0.5))
    return model, model.reference(volume=1.0)


@iges("unit_unknown", "units flag 3 with a name that no one knows: millimetres are assumed")
def unit_unknown():
    model = IgesModel("unit_unknown", unit=3, unit_name="CUBIT")
    loose_box(model, (0.0, 0.0, 0.0), (1.0, 2.0, 0.5))
    return model, model.reference(volume=1.0)


@iges("unit_scale_2", "a model space scale of 2: two units in the file are one in the real world")
def unit_scale():
    model = IgesModel("unit_scale_2", scale=2.0)
    loose_box(model, (0.0, 0.0, 0.0), (30.0, 20.0, 10.0))
    return model, model.reference(volume=6000.0, scale=0.5)


@iges("unit_scale_in_inches", "a model space scale of 0.125 in inches, on a solid")
def unit_scale_inches():
    model = IgesModel("unit_scale_in_inches", scale=0.125, unit=1, unit_name="INCH")
    box_solid(model, (0.0, 0.0, 0.0), (3.0, 2.0, 1.0))
    return model, model.reference(volume=6.0, scale=25.4 * 8)
