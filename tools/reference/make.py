"""Rebuilds the fixtures; called by `make`, which sees to the Python environment."""

from __future__ import annotations

import math
import os
import sys
import time
import traceback
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

import broken  # noqa: E402,F401  (registers the broken files)
import hand  # noqa: E402,F401  (registers the hand-written files)
import iges  # noqa: E402,F401  (registers the hand-written IGES files)
import models  # noqa: E402,F401  (registers the fixtures)
from catalogue import FIXTURES, HAND, Fixture, HandWritten  # noqa: E402

from broken.expected import write_all as write_broken  # noqa: E402
from exact import bounding_box, faces  # noqa: E402
from exports import make_exports  # noqa: E402
from freecad_run import make_all as make_freecad  # noqa: E402
from iges_in import seen_in_iges  # noqa: E402
from iges_out import WRITTEN, Written, make_written  # noqa: E402
from mesh_out import write_meshes  # noqa: E402
from readme import write_tables  # noqa: E402
from reference import (  # noqa: E402
    disagreements,
    finer_disagreements,
    measure,
    with_entities,
    without_reading,
    write_reference,
)
from step_in import StepFile  # noqa: E402
from step_out import write_step  # noqa: E402
from xcaf import document_of, shape_of  # noqa: E402

FIXTURES_FOLDER = Path(__file__).parents[2] / "fixtures"
SOURCE = "OpenCASCADE 7.9.3 (cadquery 2.8.0), exact surfaces"


def make(fixture: Fixture) -> list[str]:
    """Builds one fixture's files; returns what a person should look at."""
    folder = emptied_folder(fixture)
    stem = folder / fixture.name
    model = fixture.build()
    shape = shape_of(model)
    box = bounding_box(shape)
    in_memory = measure(shape, box)
    step = stem.with_name(fixture.name + ".step")
    write_step(document_of(fixture.name, model), step, fixture.step)
    reference, notes = reference_of(fixture, shape, in_memory, step)
    notes += hold_against_closed_form(reference, fixture.closed_form)
    notes += [f"face without an entity: {face}" for face in reference["face_areas_mm2"] if not face["entity"]]
    if fixture.meshes and faces(shape):
        unit = write_meshes(fixture.name, model, shape, box, stem, fixture.deflection, fixture.angular)
        reference["glb_unit_mm"] = unit
    write_reference(
        stem.with_name(fixture.name + ".reference.json"), {"source": SOURCE, "shows": fixture.shows, **reference}
    )
    return notes


def emptied_folder(fixture: Fixture | HandWritten | Written) -> Path:
    """The fixture's folder, without what earlier runs left of it."""
    folder = FIXTURES_FOLDER / fixture.folder
    folder.mkdir(parents=True, exist_ok=True)
    for old in folder.glob(f"{fixture.name}.*"):
        old.unlink()
    return folder


def reference_of(fixture: Fixture, shape, in_memory: dict, step: Path) -> tuple[dict, list[str]]:
    """The reference: of the file read back, or of the model in memory where OpenCASCADE misreads what it wrote."""
    if not fixture.reads_back:
        return without_reading(in_memory, fixture.name, shape, step), []
    file = StepFile(step)
    read_back = measure(file.shape, bounding_box(file.shape))
    return with_entities(read_back, file), disagreements(in_memory, read_back)


def hold_against_closed_form(reference: dict, closed_form: dict[str, float]) -> list[str]:
    """Puts the closed form's figures in place of the measured ones, and tells where they differ."""
    notes = []
    for key, expected in closed_form.items():
        if not math.isclose(reference[key], expected, rel_tol=1e-6):
            notes.append(f"{key}: {reference[key]:.12g} measured, {expected:.12g} in closed form")
        reference[key] = expected
    return notes


def make_hand(fixture: HandWritten) -> list[str]:
    """Writes a hand-written file and its reference; tells where OpenCASCADE sees something else in it."""
    folder = emptied_folder(fixture)
    content, reference = fixture.build()
    if not isinstance(content, (str, bytes)):
        content = content.text()
    step = folder / (fixture.name + fixture.extension)
    step.write_bytes(content if isinstance(content, bytes) else content.encode("utf-8"))
    differences = seen_otherwise(reference, step)
    reference = {"source": "closed form", "shows": fixture.shows, **reference, "opencascade_differs": differences}
    write_reference(folder / (fixture.name + ".reference.json"), reference)
    return [f"OpenCASCADE: {difference}" for difference in differences]


def seen_otherwise(reference: dict, step: Path) -> list[str]:
    """Where OpenCASCADE's figures of a file are not the reference's."""
    if step.suffix == ".igs":
        return seen_in_iges(reference, step)
    if step.suffix != ".step":
        return []
    try:
        file = StepFile(step)
        found = measure(file.shape, bounding_box(file.shape))
        return disagreements(reference, found) or finer_disagreements(reference, with_entities(found, file))
    except Exception as error:
        return [f"reads nothing ({type(error).__name__})"]


def make_any(fixture: Fixture | HandWritten | Written) -> list[str]:
    """Builds one fixture of any kind."""
    if isinstance(fixture, Fixture):
        return make(fixture)
    return make_hand(fixture) if isinstance(fixture, HandWritten) else make_written(fixture, emptied_folder(fixture))


def make_aloud(fixture: Fixture | HandWritten | Written) -> bool:
    """Builds one fixture and tells how it went."""
    started = time.monotonic()
    try:
        notes = make_any(fixture)
    except Exception:
        print(f"{fixture.folder}/{fixture.name}: FAILED\n{traceback.format_exc()}", flush=True)
        return False
    seconds = time.monotonic() - started
    print(f"{fixture.folder}/{fixture.name} ({seconds:.1f} s)", *notes, sep="\n    ", flush=True)
    return not notes


def apart(work, items: list) -> list[bool]:
    """Does the work on each item in a process of its own, a few at a time.

    OpenCASCADE numbers products per process, and orders some of what it writes by address: children of one unchanged
    parent (without address randomization, see `make`) all start alike.
    """
    results, running = [False] * len(items), {}
    for index, item in enumerate(items):
        if len(running) == (os.cpu_count() or 1):
            collect(running, results)
        sys.stdout.flush()
        child = os.fork()
        if child == 0:
            os._exit(0 if work(item) else 1)
        running[child] = index
    while running:
        collect(running, results)
    return results


def collect(running: dict[int, int], results: list[bool]) -> None:
    """Waits for one child; a child that died is no success."""
    child, status = os.wait()
    results[running.pop(child)] = status == 0


def main(words: list[str]) -> int:
    """Builds the fixtures whose folder/name contains one of the words, or all."""
    known = [*FIXTURES.values(), *HAND.values(), *WRITTEN.values()]
    chosen = [f for f in known if not words or any(word in f"{f.folder}/{f.name}" for word in words)]
    make_freecad(FIXTURES_FOLDER / "freecad", words)
    if not words or "broken" in words:
        write_broken(FIXTURES_FOLDER / "broken")
    good = apart(make_aloud, chosen)
    if not words or "exports" in words:
        make_exports(FIXTURES_FOLDER)
    write_tables(FIXTURES_FOLDER)
    failed = [fixture.name for fixture, well in zip(chosen, good) if not well]
    print(f"{len(chosen)} fixtures, {len(failed)} to look at:", *failed)
    return bool(failed)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
