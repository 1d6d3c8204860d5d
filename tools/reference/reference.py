"""The reference beside each fixture: `NAME.reference.json`."""

from __future__ import annotations

import json
import math
from pathlib import Path

from OCP.TopAbs import TopAbs_SOLID
from OCP.TopoDS import TopoDS_Shape

import exact
from step_in import StepFile

#: Figures of the model in memory and of the file read back must agree this well (relative).
ROUND_TRIP = 1e-5


def measure(shape: TopoDS_Shape, box) -> dict:
    """Exact totals over all placed instances, millimetres."""
    figures = [exact.face_area(face) for face in exact.faces(shape)]
    area = sum(figure[0] for figure in figures)
    reference = {
        "area_mm2": area,
        "volume_mm3": exact.volume(shape),
        "bbox_mm": box,
        "closed": exact.is_closed(shape),
        "solids": len(exact.subshapes(shape, TopAbs_SOLID)),
        "faces": len(figures),
        "area_centroid_mm": [
            sum(f[0] * f[1][axis] for f in figures) / area if area else None for axis in range(3)
        ],
    }
    curves = exact.free_edges(shape)
    if curves:
        reference["free_curves"] = {
            "count": len(curves),
            "length_mm": sum(exact.curve_length(curve) for curve in curves),
        }
    return reference


def doubts(shape: TopoDS_Shape) -> list[str]:
    """Faces whose area two ways of integrating give differently."""
    found = []
    for index, face in enumerate(exact.faces(shape)):
        area, _, doubt = exact.face_area(face)
        if doubt > exact.AGREEMENT:
            found.append(f"face {index} ({exact.surface_kind(face)}): area {area:.9g} doubtful to {doubt:.1e}")
    return found


def with_entities(reference: dict, file: StepFile) -> dict:
    """Adds what only the written file tells: entities per face, tree, parts, colours."""
    reference = dict(reference)
    reference["face_areas_mm2"] = file.face_list()
    reference["colours"] = file.colours()
    reference["tree"] = file.tree()
    reference["parts"] = file.parts()
    return reference


def disagreements(reference: dict, read_back: dict) -> list[str]:
    """What differs between the model in memory and the file read back."""
    found = []
    for key in ("solids", "faces", "closed"):
        if reference[key] != read_back[key]:
            found.append(f"{key}: {reference[key]} in memory, {read_back[key]} read back")
    for key in ("area_mm2", "volume_mm3"):
        ours, theirs = reference[key] or 0.0, read_back[key] or 0.0
        if not math.isclose(ours, theirs, rel_tol=ROUND_TRIP, abs_tol=1e-12):
            found.append(f"{key}: {ours:.9g} in memory, {theirs:.9g} read back")
    return found


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
