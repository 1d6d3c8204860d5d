"""Files that are cut off, or whose text is damaged."""

from __future__ import annotations


from broken.box import OPEN, WHOLE, box
from broken.expected import broken
from step_model import StepModel


def cut(share: float) -> str:
    """The first part of a box whose product comes first and whose points come last."""
    model = box()
    model.lines.reverse()
    text = model.text()
    return text[: int(len(text) * share)]


@broken("truncated_magic.step", "cut within ISO-10303-21", [2], ["not a step", "iso-10303", "end"])
def truncated_magic():
    return "ISO-103"


@broken("truncated_header.step", "cut within the header", [2], ["header", "data", "end"])
def truncated_header():
    return box().text()[:90]


@broken("truncated_before_data.step", "cut before the DATA section", [2], ["data"])
def truncated_before_data():
    return box().text().split("DATA;")[0]


@broken("truncated_at_20.step", "a fifth of the file", [2], ["end"])
def truncated_at_20():
    return cut(0.2)


@broken(
    "truncated_at_50.step",
    "half of the file: topology, and few of its points",
    [1, 2],
    ["end", "missing", "not defined", "undefined"],
)
def truncated_at_50():
    return cut(0.5)


@broken(
    "truncated_at_93.step",
    "nearly all of the file: some points are missing",
    [1, 2],
    ["end", "missing", "not defined", "undefined"],
)
def truncated_at_93():
    return cut(0.93)


@broken("truncated_in_string.step", "cut within a string", [1, 2], ["string", "end"])
def truncated_in_string():
    text = box().text()
    return text[: text.index("design processes")]


@broken("truncated_in_comment.step", "a comment that never ends, around the solid", [1, 2], ["comment"])
def truncated_in_comment():
    return box().text().replace("DATA;\n", "DATA;\n/* never closed\n", 1)


@broken("no_data.step", "a header and nothing else", [2], ["data", "no "])
def no_data():
    text = box().text()
    return text.split("DATA;")[0] + "END-ISO-10303-21;\n"


@broken("no_geometry.step", "products without any shape", [2], ["none", "nothing"])
def no_geometry():
    model = StepModel()
    model.product("ghost", [], representation="SHAPE_REPRESENTATION")
    return model


@broken(
    "junk_between_records.step",
    "lines of nonsense between the records: one diagnostic each, the model whole",
    [0, 1],
    [],
    WHOLE,
)
def junk_between_records():
    model = box()
    lines = []
    for k, line in enumerate(model.lines):
        lines.append(line)
        if k % 10 == 5:
            lines.append("@@ )( not a record ;")
    model.lines = lines
    return model


@broken("nul_bytes.step", "NUL bytes between records", [0, 1], [], WHOLE)
def nul_bytes():
    return box().text().encode().replace(b";\n#2", b";\n\x00\x00\n#2")


@broken(
    "record_without_semicolon.step",
    "a record of the lid without its semicolon: it swallows the next",
    [1],
    ["line", "#"],
)
def record_without_semicolon():
    model = box()
    plane = [k for k, line in enumerate(model.lines) if "=PLANE(" in line][-1]
    model.lines[plane] = model.lines[plane].rstrip(";")
    return model


@broken(
    "unbalanced_parentheses.step",
    "a record of the lid with a parenthesis too few",
    [1],
    ["line", "#", "parenthes"],
    OPEN,
)
def unbalanced_parentheses():
    model = box()
    plane = [k for k, line in enumerate(model.lines) if "=PLANE(" in line][-1]
    model.lines[plane] = model.lines[plane].replace(");", ";")
    return model


@broken("unterminated_string.step", "a name whose quote is never closed", [1, 2], ["string", "quote"])
def unterminated_string():
    model = box()
    face = [k for k, line in enumerate(model.lines) if "=ADVANCED_FACE(''" in line][-1]
    model.lines[face] = model.lines[face].replace("''", "'lid", 1)
    return model


@broken(
    "ids_twice.step",
    "one instance name defined twice, the second time as nonsense",
    [0, 1],
    ["twice", "again", "duplicate", "already"],
)
def ids_twice():
    model = box()
    model.lines.append(model.lines[0].split("=")[0] + "=DIRECTION('',(9.,9.,9.));")
    return model


@broken("nesting.step", "two thousand parentheses in one record", [0, 1], ["nest", "deep", "depth"], WHOLE)
def nesting():
    model = box()
    model.add_text("SOMETHING(" + "(" * 2000 + ")" * 2000 + ")")
    return model
