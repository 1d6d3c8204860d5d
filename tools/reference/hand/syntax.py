"""What ISO 10303-21 allows in a file's text, over one and the same box."""

from __future__ import annotations

import gzip
import io
import re
import zipfile

from catalogue import hand
from part21 import Raw
from step_model import AP203, AP214, StepModel

BOX = [[0.0, 0.0, 0.0], [30.0, 20.0, 10.0]]


def box_model(name: str, schema: str = AP214) -> StepModel:
    model = StepModel(schema)
    model.product(name, [model.box(*BOX)])
    return model


def reference(model: StepModel, name: str) -> dict:
    figures = model.reference(volume=6000.0, bbox=BOX)
    figures["tree"][0]["name"] = figures["parts"][0]["name"] = name
    return figures


def named(text_of_name: str, meaning: str):
    """A box whose product's name is written as given, quotes included."""
    model = box_model("PLACEHOLDER")
    text = model.text().replace("'PLACEHOLDER'", text_of_name)
    return text, reference(model, meaning)


STRINGS = {
    "apostrophe": ("'it''s'", "it's"),
    "backslash": (r"'a\\b'", "a\\b"),
    "x": (r"'Gr\X\F6\X\DFe'", "Größe"),
    "x2": (r"'\X2\03A9\X0\ \X2\6B6F8ECA\X0\'", "Ω 歯車"),
    "x2_surrogates": (r"'\X2\D83DDE42\X0\'", "🙂"),
    "x4": (r"'\X4\0001F642\X0\!'", "🙂!"),
    "s": (r"'Gr\S\v\S\_e'", "Größe"),
    "newline_inside": ("'one\ntwo'", "onetwo"),
}

for _name, (_text, _meaning) in STRINGS.items():

    @hand(f"string_{_name}", f"a product named by {_text!r}"[:100])
    def string_file(text=_text, meaning=_meaning):
        return named(text, meaning)


@hand("string_page", r"a product named by \PE\ and \S\: Cyrillic of ISO 8859-5")
def string_page():
    # In ISO 8859-5, 0xB0 + n is the n-th capital from A on: \S\0 is 0xB0, \S\1 is 0xB1, \S\2 is 0xB2.
    return named(r"'\PE\\S\0\S\1\S\2'", "АБВ")


@hand("string_raw_utf8", "a product's name in raw UTF-8, as many writers do")
def string_raw_utf8():
    text, figures = named("'Größe 歯車 🙂'", "Größe 歯車 🙂")
    return text.encode("utf-8"), figures


@hand("string_raw_latin1", "a product's name in raw ISO 8859-1, as older writers do")
def string_raw_latin1():
    text, figures = named("'Größe'", "Größe")
    return text.encode("latin-1"), figures


@hand("string_broken_escape", "escapes that are cut off or meaningless: taken as they stand, the model unharmed")
def string_broken_escape():
    model = box_model("PLACEHOLDER")
    text = model.text().replace("'PLACEHOLDER'", r"'bolt\X2\00 \Q\ \X\G1'")
    figures = reference(model, "")
    del figures["tree"], figures["parts"]
    return text, figures


@hand("text_comments", "comments everywhere, one with a semicolon and a quote, one across lines")
def text_comments():
    model = box_model("text_comments")
    lines = model.text().splitlines()
    out = []
    for k, line in enumerate(lines):
        if line.startswith("#") and k % 3 == 0:
            line = line.replace("=", "/* it's; here */ = /* #1=POINT(); */", 1)
        out.append(line)
        if k % 7 == 0:
            out.append("/* a comment\n   over lines * / still */")
    return "\n".join(out[1:] if out[0].startswith("/*") else out) + "\n", reference(model, "text_comments")


@hand("text_one_line", "the whole file on a single line")
def text_one_line():
    model = box_model("text_one_line")
    return model.text().replace("\n", ""), reference(model, "text_one_line")


@hand("text_split_lines", "every record broken after each comma, with tabs and blank lines")
def text_split_lines():
    model = box_model("text_split_lines")
    head, data = model.text().split("DATA;\n")
    return head + "DATA;\n" + data.replace(",", ",\n\n\t  "), reference(model, "text_split_lines")


@hand("text_crlf", "lines that end in CR LF")
def text_crlf():
    model = box_model("text_crlf")
    return model.text().replace("\n", "\r\n").encode(), reference(model, "text_crlf")


@hand("text_cr", "lines that end in CR alone")
def text_cr():
    model = box_model("text_cr")
    return model.text().replace("\n", "\r").encode(), reference(model, "text_cr")


@hand("text_bom", "a UTF-8 byte order mark before ISO-10303-21")
def text_bom():
    model = box_model("text_bom")
    return b"\xef\xbb\xbf" + model.text().encode(), reference(model, "text_bom")


@hand("text_lower_case", "keywords and enumerations in lower case")
def text_lower_case():
    model = box_model("text_lower_case")
    head, data = model.text().split("DATA;\n")
    pieces = data.replace("ENDSEC;\nEND-ISO-10303-21;\n", "").split("'")
    low = "'".join(piece if k % 2 else piece.lower() for k, piece in enumerate(pieces))
    return head + "DATA;\n" + low + "ENDSEC;\nEND-ISO-10303-21;\n", reference(model, "text_lower_case")


@hand("text_shuffled", "instances in reverse order: every reference points forward")
def text_shuffled():
    model = box_model("text_shuffled")
    model.lines.reverse()
    return model, reference(model, "text_shuffled")


@hand("text_large_ids", "instance names of nine digits with gaps")
def text_large_ids():
    model = box_model("text_large_ids")
    text = re.sub(r"#(\d+)", lambda m: f"#{900000000 + 37 * int(m[1])}", model.text())
    figures = reference(model, "text_large_ids")
    for face in figures["face_areas_mm2"]:
        face["entity"] = f"#{900000000 + 37 * int(face['entity'][1:])}"
    return text, figures


@hand("text_huge_ids", "instance names beyond 32 bits")
def text_huge_ids():
    model = box_model("text_huge_ids")
    base = 5_000_000_000_000
    text = re.sub(r"#(\d+)", lambda m: f"#{base + int(m[1])}", model.text())
    figures = reference(model, "text_huge_ids")
    for face in figures["face_areas_mm2"]:
        face["entity"] = f"#{base + int(face['entity'][1:])}"
    return text, figures


@hand("text_numbers", "reals written in every allowed way: signs, no digits after the point, exponents")
def text_numbers():
    model = box_model("text_numbers")
    text = model.text()
    text = (
        text.replace("30.,", "+3.0E+1,")
        .replace("20.,", "2.e1,")
        .replace(",10.)", ",1000.0E-02)")
        .replace("0.,", "-0.0,")
    )
    return text, reference(model, "text_numbers")


@hand("text_integers_for_reals", "integers where reals belong, as sloppy writers do")
def text_integers_for_reals():
    model = box_model("text_integers_for_reals")
    text = model.text().replace("30.", "30").replace("20.", "20").replace("10.)", "10)")
    return text, reference(model, "text_integers_for_reals")


@hand(
    "text_user_defined",
    "user-defined keywords, binary values, nested lists, typed and omitted parameters that mean nothing here",
)
def text_user_defined():
    model = box_model("text_user_defined")
    model.add("!TRIMLOOP_NOTE", 'it is a "box"', Raw('"23F0A"'), [[1, 2], [], [[3.5, None]]], Raw("!LENGTH(2.)"))
    model.add_text("(!A() !B(1,2) REPRESENTATION_ITEM(''))")
    model.add("SOME_FUTURE_ENTITY", Raw("*"), None, [Raw(".MAYBE.")])
    return model, reference(model, "text_user_defined")


@hand("text_scope", "an edition 1 SCOPE block around an instance")
def text_scope():
    model = box_model("text_scope")
    last = model.lines[-1]
    inner = model.add("SOME_LOCAL_ENTITY", 1)
    model.lines.pop()
    number, rest = last.split("=", 1)
    model.lines[-1] = f"{number}=&SCOPE\n#{int(inner)}=SOME_LOCAL_ENTITY(1);\nENDSCOPE /#{int(inner)}/ {rest}"
    return model, reference(model, "text_scope")


@hand("text_two_data_sections", "edition 2: two DATA sections with names, references across them")
def text_two_data_sections():
    model = box_model("text_two_data_sections")
    half = len(model.lines) // 2
    schema = f"('{model.schema}')"
    body = (
        f"DATA('first',{schema});\n" + "\n".join(model.lines[:half]) + "\nENDSEC;\n"
        f"DATA('second',{schema});\n" + "\n".join(model.lines[half:]) + "\nENDSEC;\n"
    )
    text = model.header().replace("'2;1'", "'3;1'") + body + "END-ISO-10303-21;\n"
    return text, reference(model, "text_two_data_sections")


@hand("text_edition_3", "edition 3: ANCHOR and REFERENCE sections before DATA, a SIGNATURE after it")
def text_edition_3():
    model = box_model("text_edition_3")
    solid = next(ref for ref, keyword in model.keywords.items() if keyword == "MANIFOLD_SOLID_BREP")
    head = model.header().replace("'2;1'", "'4;1'")
    anchor = f"ANCHOR;\n<body>=#{int(solid)};\n<axis>=(1.,0.,0.){{note:'a value'}};\nENDSEC;\n"
    external = "REFERENCE;\n#90001=<other.stp#body>;\n@90002=<other.stp#axis>;\nENDSEC;\n"
    data = "DATA;\n" + "\n".join(model.lines) + "\nENDSEC;\n"
    signature = "END-ISO-10303-21;\nSIGNATURE;\nMIIB0wYJKoZIhvcNAQcCoIIBxDCCAcACAQExADALBgkq\nENDSEC;\n"
    return head + anchor + external + data + signature, reference(model, "text_edition_3")


@hand("text_header_extended", "a header with FILE_POPULATION, SECTION_LANGUAGE, SECTION_CONTEXT and SCHEMA_POPULATION")
def text_header_extended():
    model = box_model("text_header_extended")
    more = (
        "FILE_POPULATION('AUTOMOTIVE_DESIGN','SECTION_BOUNDARY',$);\nSECTION_LANGUAGE($,'en');\n"
        "SECTION_CONTEXT($,('first','second'));\nSCHEMA_POPULATION(());\n"
    )
    return model.text().replace("ENDSEC;\nDATA;", more + "ENDSEC;\nDATA;", 1), reference(model, "text_header_extended")


@hand("text_no_end", "the file ends after the DATA section's ENDSEC, without END-ISO-10303-21")
def text_no_end():
    model = box_model("text_no_end")
    return model.text().replace("END-ISO-10303-21;\n", ""), reference(model, "text_no_end")


SCHEMAS = {
    "schema_unknown": "SOMETHING_NEW_DESIGN { 1 0 10303 999 1 1 1 1 }",
    "schema_ap203_edition_1": AP203,
    "schema_ap203_edition_2": "AP203_CONFIGURATION_CONTROLLED_3D_DESIGN_OF_MECHANICAL_PARTS_AND_ASSEMBLIES_MIM_LF { 1 0 10303 403 2 1 2 }",
    "schema_ap242_edition_1": "AP242_MANAGED_MODEL_BASED_3D_ENGINEERING_MIM_LF { 1 0 10303 442 1 1 4 }",
    "schema_ap242_edition_2": "AP242_MANAGED_MODEL_BASED_3D_ENGINEERING_MIM_LF { 1 0 10303 442 3 1 4 }",
    "schema_ap242_edition_3": "AP242_MANAGED_MODEL_BASED_3D_ENGINEERING_MIM_LF { 1 0 10303 442 4 1 4 }",
    "schema_empty": "",
}

for _name, _schema in SCHEMAS.items():

    @hand(_name, f"the schema is named {_schema.split(' ')[0]!r}")
    def schema_file(name=_name, schema=_schema):
        model = box_model(name, schema)
        return model, reference(model, name)


@hand("container_gzip", "a gzip file around a STEP file", extension=".step.gz")
def container_gzip():
    model = box_model("container")
    buffer = io.BytesIO()
    with gzip.GzipFile(filename="", mode="wb", fileobj=buffer, mtime=0) as packed:
        packed.write(model.text().encode())
    return buffer.getvalue(), reference(model, "container")


@hand("container_zip", "a zip file around a STEP file", extension=".stpz")
def container_zip():
    model = box_model("container")
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as packed:
        packed.writestr(zipfile.ZipInfo("container.stp", (2000, 1, 1, 0, 0, 0)), model.text(), zipfile.ZIP_DEFLATED)
    return buffer.getvalue(), reference(model, "container")
