"""Rebuilds the fixtures; called by `make`, which sees to the Python environment."""

from __future__ import annotations

import math
import os
import sys
import traceback
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

import models  # noqa: E402,F401  (registers the fixtures)
from catalogue import FIXTURES, Fixture  # noqa: E402
from exact import bounding_box, faces  # noqa: E402
from mesh_out import write_meshes  # noqa: E402
from reference import (  # noqa: E402
    disagreements,
    doubts,
    measure,
    with_entities,
    write_reference,
)
from step_in import StepFile  # noqa: E402
from step_out import write_step  # noqa: E402
from xcaf import document_of, shape_of  # noqa: E402

FIXTURES_FOLDER = Path(__file__).parents[2] / "fixtures"
SOURCE = "OpenCASCADE 7.9.3 (cadquery 2.8.0), exact surfaces"


def make(fixture: Fixture) -> list[str]:
    """Builds one fixture's files; returns what a person should look at."""
    folder = FIXTURES_FOLDER / fixture.folder
    folder.mkdir(parents=True, exist_ok=True)
    stem = folder / fixture.name
    model = fixture.build()
    shape = shape_of(model)
    box = bounding_box(shape)
    reference = measure(shape, box)
    notes = doubts(shape)
    step = stem.with_name(fixture.name + ".step")
    write_step(document_of(fixture.name, model), step, fixture.step)
    file = StepFile(step)
    notes += disagreements(reference, measure(file.shape, bounding_box(file.shape)))
    for key, expected in fixture.closed_form.items():
        if not math.isclose(reference[key], expected, rel_tol=1e-6):
            notes.append(f"{key}: {reference[key]:.12g} measured, {expected:.12g} in closed form")
        reference[key] = expected
    reference = {"source": SOURCE, "shows": fixture.shows, **with_entities(reference, file)}
    write_reference(stem.with_name(fixture.name + ".reference.json"), reference)
    if faces(shape):
        write_meshes(fixture.name, model, shape, box, stem, fixture.deflection, fixture.angular)
    return notes


def make_apart(fixture: Fixture) -> bool:
    """Builds one fixture in a process of its own: OpenCASCADE numbers products per process."""
    child = os.fork()
    if child == 0:
        try:
            notes = make(fixture)
            size = (FIXTURES_FOLDER / fixture.folder / f"{fixture.name}.step").stat().st_size
            print(f"{fixture.folder}/{fixture.name}: {size} bytes", *notes, sep="\n    ", flush=True)
            os._exit(0)
        except BaseException:
            print(f"{fixture.folder}/{fixture.name}: FAILED\n{traceback.format_exc()}", flush=True)
            os._exit(1)
    _, status = os.waitpid(child, 0)
    if os.WIFSIGNALED(status):
        print(f"{fixture.folder}/{fixture.name}: DIED of signal {os.WTERMSIG(status)}", flush=True)
    return status == 0


def main(words: list[str]) -> int:
    """Builds the fixtures whose name contains one of the words, or all."""
    chosen = [f for f in FIXTURES.values() if not words or any(word in f.name for word in words)]
    failed = [fixture.name for fixture in chosen if not make_apart(fixture)]
    print(f"{len(chosen)} fixtures, {len(failed)} failed", *failed)
    return bool(failed)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
