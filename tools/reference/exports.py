"""Meshes as users make them: STEP fixtures opened in FreeCAD and in cadquery, and exported from there.

Each export runs in a process of its own, one after the other, so that one that crashes or hangs stops no other.
"""

from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
import tempfile
import zlib
from importlib.metadata import version
from math import dist
from pathlib import Path
from typing import Callable

import cadquery as cq

from exact import faces
from mesh_in import differences, read_mesh

#: The folders whose STEP files are exported.
FOLDERS = ("cadquery", "freecad", "hand")
#: Largest distance from the surface, as a part of the box's diagonal.
LINEAR = 1e-3
#: Largest angle, radians.
ANGULAR = 0.35
#: One in so many models leaves FreeCAD as OBJ, unless that takes more than so many bytes; the others as STL.
OBJ_EVERY, OBJ_LIMIT = 3, 60_000
#: What one export may take, seconds.
TIMEOUT = 60
#: What one file, and all of them, may take, bytes.
FILE_LIMIT = 400_000
FOLDER_LIMIT = 11_500_000
#: Models that stay however large, because no small one has such a shape.
STAYING = (
    "cadquery/torus.step",
    "cadquery/torus_apple.step",
    "cadquery/torus_lemon.step",
    "cadquery/spline_revolved.step",
    "cadquery/sphere_with_pinholes.step",
    "cadquery/shell_round.step",
    "cadquery/sweep_round_corners.step",
    "cadquery/plate_perforated.step",
    "cadquery/thread.step",
    "freecad/thread.step",
    "hand/sphere_as_two_halves.step",
    "hand/sphere_vertex_loop.step",
    "hand/surface_bspline.step",
    "hand/surface_degenerate_torus_lemon.step",
    "hand/torus_vertex_loop.step",
)

#: Exports `step` to `mesh` at a linear tolerance; returns `version`, `read_by` and `triangles` of the entry.
Exporter = Callable[[Path, Path, float], dict]


class NoMesh(Exception):
    """Why a model has no export."""


def make_exports(fixtures: Path) -> None:
    """Rewrites `exports/`; what an exporter that is not installed made stays as it is."""
    folder = fixtures / "exports"
    catalogue = folder / "exports.json"
    old = json.loads(catalogue.read_text(encoding="utf-8")) if catalogue.exists() else {}
    made, skipped = [], []
    for exporter, export in (("freecad", freecad_export), ("cadquery", cadquery_export)):
        if exporter == "freecad" and shutil.which("freecadcmd") is None:
            print("freecadcmd is not installed: fixtures/exports/freecad is left as it is")
            made += [entry for entry in old.get("exports", []) if entry["exporter"] == exporter]
            skipped += [entry for entry in old.get("skipped", []) if entry["exporter"] == exporter]
            continue
        shutil.rmtree(folder / exporter, ignore_errors=True)
        (folder / exporter).mkdir(parents=True)
        for step in sources(fixtures, exporter):
            entry = exported(fixtures, step, exporter, export)
            (skipped if "reason" in entry else made).append(entry)
    made, dropped = fit(fixtures, made)
    skipped = sorted(skipped + dropped, key=lambda e: (e["exporter"], e["step"]))
    write_catalogue(catalogue, made, skipped)
    print(f"{len(made)} exports, {len(skipped)} skipped")


def sources(fixtures: Path, exporter: str) -> list[Path]:
    """The STEP files to export: none that the exporter made and meshed itself."""
    found = [step for folder in FOLDERS for step in sorted((fixtures / folder).glob("*.step"))]
    return [step for step in found if step.parent.name != exporter or not step.with_suffix(".stl").exists()]


def exported(fixtures: Path, step: Path, exporter: str, export: Exporter) -> dict:
    """One model's entry in `exports.json`: its export, or the reason why there is none."""
    source = step.relative_to(fixtures).as_posix()
    name = f"{step.parent.name}__{step.stem}"
    mesh = fixtures / "exports" / exporter / f"{name}.stl"
    reference = json.loads(step.with_suffix(".reference.json").read_text(encoding="utf-8"))
    try:
        linear = tolerance(reference)
        if exporter == "freecad" and zlib.crc32(name.encode()) % OBJ_EVERY == 0:
            mesh = mesh.with_suffix(".obj")
        told = export(step, mesh, linear)
        if mesh.suffix == ".obj" and told["triangles"] and mesh.stat().st_size > OBJ_LIMIT:
            mesh.unlink()
            mesh = mesh.with_suffix(".stl")
            told = export(step, mesh, linear)
        if told["triangles"] == 0:
            raise NoMesh("empty mesh")
        if mesh.stat().st_size > FILE_LIMIT:
            raise NoMesh(f"larger than {FILE_LIMIT // 1000} kB")
    except NoMesh as reason:
        mesh.unlink(missing_ok=True)
        print(f"{source} {exporter}: {reason}", flush=True)
        return {"step": source, "exporter": exporter, "reason": str(reason)}
    return {
        "path": mesh.relative_to(fixtures).as_posix(),
        "step": source,
        "exporter": exporter,
        "linear_mm": linear,
        "angular_rad": ANGULAR,
        **told,
        "differs": differences(read_mesh(mesh), reference, linear),
    }


def tolerance(reference: dict) -> float:
    """The linear tolerance for a model, millimetres, to six digits."""
    if not reference["bbox_mm"] or not reference["faces"]:
        raise NoMesh("no faces")
    return float(f"{LINEAR * dist(*reference['bbox_mm']):.6g}")


def freecad_export(step: Path, mesh: Path, linear: float) -> dict:
    """What FreeCAD makes of a model; where `Import`, its usual reader, crashes, `Part` reads the file."""
    for reader in ("Import", "Part"):
        done = run_freecad(step, mesh, linear, reader)
        said = dict(line.split("\t", 1) for line in done.stdout.splitlines() if "\t" in line)
        if "MADE" in said:
            return {"version": said["VERSION"], "read_by": reader, "triangles": int(said["MADE"])}
        if "FAILED" in said:
            raise NoMesh(said["FAILED"])
    raise NoMesh("FreeCAD crashes")


def run_freecad(step: Path, mesh: Path, linear: float, reader: str) -> subprocess.CompletedProcess[str]:
    """Runs `freecad/export.py`, without the user's preferences."""
    with tempfile.TemporaryDirectory() as scratch:
        told = {
            "TRIMLOOP_STEP": str(step),
            "TRIMLOOP_READER": reader,
            "TRIMLOOP_MESH": str(mesh),
            "TRIMLOOP_LINEAR": repr(linear),
            "TRIMLOOP_ANGULAR": repr(ANGULAR),
            "FREECAD_USER_HOME": scratch,
        }
        try:
            return subprocess.run(
                ["freecadcmd", str(Path(__file__).parent / "freecad" / "export.py")],
                env={**os.environ, **told},
                stdin=subprocess.DEVNULL,
                capture_output=True,
                text=True,
                errors="replace",
                timeout=TIMEOUT,
            )
        except subprocess.TimeoutExpired:
            raise NoMesh(f"not done after {TIMEOUT} s") from None


def cadquery_export(step: Path, mesh: Path, linear: float) -> dict:
    """What cadquery makes of a model, in a child of this process that an alarm ends."""
    with tempfile.TemporaryDirectory() as scratch:
        report = Path(scratch) / "report"
        child = os.fork()
        if child == 0:
            signal.alarm(TIMEOUT)
            report.write_text(cadquery_mesh(step, mesh, linear), encoding="utf-8")
            os._exit(0)
        status = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
        if status == -signal.SIGALRM:
            raise NoMesh(f"not done after {TIMEOUT} s")
        failure = report.read_text(encoding="utf-8") if report.exists() else f"cadquery ended with {status}"
    if failure:
        raise NoMesh(failure)
    tool = f"cadquery {version('cadquery')} (OCP {version('cadquery-ocp')})"
    return {"version": tool, "read_by": "importStep", "triangles": len(read_mesh(mesh))}


def cadquery_mesh(step: Path, mesh: Path, linear: float) -> str:
    """Reads and exports a model; returns why it could not, or nothing."""
    try:
        shape = cq.Compound.makeCompound(cq.importers.importStep(str(step)).vals())
        if not faces(shape.wrapped):
            return "no faces"
        # Exporters take the linear tolerance as a part of each edge's length unless told otherwise.
        written = shape.exportStl(str(mesh), linear, ANGULAR, relative=False, parallel=False)
        return "" if written else "empty mesh"
    except Exception as error:
        return " ".join(str(error).split()) or type(error).__name__


def fit(fixtures: Path, made: list[dict]) -> tuple[list[dict], list[dict]]:
    """Removes the largest files until the rest fits the folder; returns what is left and what went."""
    size = {entry["path"]: (fixtures / entry["path"]).stat().st_size for entry in made}
    kept, dropped, total = [], [], 0
    for entry in sorted(made, key=lambda e: (e["step"] not in STAYING, size[e["path"]], e["path"])):
        total += size[entry["path"]]
        if total <= FOLDER_LIMIT:
            kept.append(entry)
            continue
        (fixtures / entry["path"]).unlink()
        reason = f"too large ({size[entry['path']] // 1000} kB) for the room that smaller ones leave"
        dropped.append({"step": entry["step"], "exporter": entry["exporter"], "reason": reason})
    return sorted(kept, key=lambda e: e["path"]), dropped


def write_catalogue(path: Path, made: list[dict], skipped: list[dict]) -> None:
    """Writes `exports.json`, one line for each export."""
    parts = []
    for key, entries in (("exports", made), ("skipped", skipped)):
        lines = ",\n".join("    " + json.dumps(entry, ensure_ascii=False) for entry in entries)
        parts.append(f'  "{key}": [\n{lines}\n  ]' if entries else f'  "{key}": []')
    path.write_text("{\n" + ",\n".join(parts) + "\n}\n", encoding="utf-8")
