"""The reference beside each fixture: `NAME.reference.json`."""

from __future__ import annotations

import json
import math
import re
from pathlib import Path

from OCP.TopAbs import TopAbs_SOLID
from OCP.TopoDS import TopoDS_Shape

import exact
from integral import integrate
from step_in import NO_COLOUR, StepFile, face_entry

#: Figures of the model in memory and of the file read back must agree this well (relative).
ROUND_TRIP = 1e-4


def measure(shape: TopoDS_Shape, box) -> dict:
    """Exact totals over all placed instances, millimetres."""
    figures = [integrate(face) for face in exact.faces(shape)]
    area = sum(figure.area_mm2 for figure in figures)
    reference = {
        "area_mm2": area,
        "volume_mm3": exact.volume(shape),
        "bbox_mm": box,
        "closed": exact.is_closed(shape),
        "solids": len(exact.subshapes(shape, TopAbs_SOLID)),
        "faces": len(figures),
        "area_centroid_mm": [
            sum(f.area_mm2 * f.centroid_mm[axis] for f in figures) / area if area else None for axis in range(3)
        ],
    }
    curves = exact.free_edges(shape)
    if curves:
        reference["free_curves"] = {
            "count": len(curves),
            "length_mm": sum(exact.curve_length(curve) for curve in curves),
        }
    return reference


def with_entities(reference: dict, file: StepFile) -> dict:
    """Adds what only the written file tells: entities per face, tree, parts, colours."""
    reference = dict(reference)
    reference["face_areas_mm2"] = file.face_list()
    reference["colours"] = file.colours()
    reference["tree"] = file.tree()
    reference["parts"] = file.parts()
    return reference


def without_reading(reference: dict, name: str, shape: TopoDS_Shape, step: Path) -> dict:
    """The same for a single part that OpenCASCADE writes and misreads: faces in the order of writing."""
    ids = re.findall(rb"^\s*#(\d+)\s*=\s*ADVANCED_FACE", step.read_bytes(), re.M)
    faces = exact.faces(shape)
    assert len(ids) == len(faces), step
    part = {key: reference[key] for key in ("solids", "faces", "closed", "area_mm2", "volume_mm3")}
    return {
        **reference,
        "face_areas_mm2": [face_entry(int(entity_id), [face]) for entity_id, face in zip(ids, faces)],
        "colours": {NO_COLOUR: reference["area_mm2"]},
        "tree": [{"name": name}],
        "parts": [{"name": name, "instances": 1, **part}],
    }


def disagreements(expected: dict, found: dict) -> list[str]:
    """Where the totals of a file read back are not the expected ones."""
    notes = []
    for key in ("solids", "faces", "closed"):
        if expected[key] != found[key]:
            notes.append(f"{key} {found[key]}, not {expected[key]}")
    for key in ("area_mm2", "volume_mm3"):
        ours, theirs = abs(expected[key] or 0.0), abs(found[key] or 0.0)
        if not math.isclose(ours, theirs, rel_tol=ROUND_TRIP, abs_tol=1e-12):
            notes.append(f"{key} {theirs:.9g}, not {ours:.9g}")
    return notes


def finer_disagreements(expected: dict, found: dict) -> list[str]:
    """Where box, faces, colours or tree of a file read back are not the expected ones."""
    notes = []
    ours, theirs = expected["bbox_mm"], found["bbox_mm"]
    if ours and theirs:
        gap = max(abs(a - b) for low, high in zip(ours, theirs) for a, b in zip(low, high))
        if gap > ROUND_TRIP * (math.dist(*ours) or 1.0):
            notes.append(f"box {settled(theirs)}, not {settled(ours)}")
    others = {face["entity"]: face for face in found["face_areas_mm2"]}
    for face in expected["face_areas_mm2"]:
        notes += face_disagreements(face, others.get(face["entity"]))
    ours, theirs = expected["colours"], found["colours"]
    if not all(
        math.isclose(ours.get(c, 0.0), theirs.get(c, 0.0), rel_tol=ROUND_TRIP, abs_tol=1e-9) for c in {*ours, *theirs}
    ):
        notes.append("other colours")
    if "tree" in expected and settled(expected["tree"]) != settled(found["tree"]):
        notes.append("another tree")
    return notes


def face_disagreements(expected: dict, found: dict | None) -> list[str]:
    """Where one face is not the expected one."""
    if found is None:
        return [f"{expected['entity']} not found"]
    notes = []
    if not math.isclose(expected["area_mm2"], found["area_mm2"], rel_tol=ROUND_TRIP):
        notes.append(f"{expected['entity']} area {found['area_mm2']:.9g}, not {expected['area_mm2']:.9g}")
    centroid = expected.get("centroid_mm")
    if centroid and math.dist(centroid, found["centroid_mm"]) > ROUND_TRIP * math.sqrt(expected["area_mm2"]):
        notes.append(f"{expected['entity']} centroid {settled(found['centroid_mm'])}, not {settled(centroid)}")
    return notes


def write_reference(path: Path, reference: dict) -> None:
    """Writes the reference with twelve significant digits and one line per leaf list."""
    path.write_text(to_json(settled(reference)) + "\n", encoding="utf-8")


def settled(value):
    """Rounds every float to twelve significant digits, so that a rebuild gives the same text."""
    if isinstance(value, float):
        short = float(f"{value:.12g}")
        return 0.0 if abs(short) < 1e-12 else short
    if isinstance(value, dict):
        return {key: settled(inner) for key, inner in value.items()}
    if isinstance(value, (list, tuple)):
        return [settled(inner) for inner in value]
    return value


def to_json(value, indent: int = 0) -> str:
    """JSON whose lines are short enough to read and long enough to scan: what fits in 110 columns stays on one."""
    flat = json.dumps(value, ensure_ascii=False)
    if len(flat) + indent <= 110 or not isinstance(value, (dict, list)):
        return flat
    pad = " " * (indent + 2)
    if isinstance(value, dict):
        lines = [f"{pad}{json.dumps(key)}: {to_json(inner, indent + 2)}" for key, inner in value.items()]
        return "{\n" + ",\n".join(lines) + "\n" + " " * indent + "}"
    lines = [pad + to_json(inner, indent + 2) for inner in value]
    return "[\n" + ",\n".join(lines) + "\n" + " " * indent + "]"
