"""The models of `freecad/models.py`: made by FreeCAD, measured like all others."""

from __future__ import annotations

import os
import shutil
import subprocess
import tempfile
from pathlib import Path

from exact import bounding_box
from reference import measure, with_entities, write_reference
from step_in import StepFile
from step_out import settle_header

SOURCE = "FreeCAD 0.20.2 (OpenCASCADE 7.6); figures integrated over the exact surfaces"


def make_all(folder: Path, words: list[str]) -> int:
    """Makes the models whose folder/name contains one of the words; returns how many went wrong."""
    if words and not any("freecad" in word for word in words):
        return 0
    if shutil.which("freecadcmd") is None:
        print("freecadcmd is not installed: fixtures/freecad is left as it is")
        return 0
    names = [word.removeprefix("freecad/") for word in words if word.startswith("freecad/")]
    with tempfile.TemporaryDirectory() as scratch:
        done = subprocess.run(
            ["freecadcmd", str(Path(__file__).parent / "freecad" / "models.py")],
            env={**os.environ, "TRIMLOOP_OUT": scratch, "TRIMLOOP_NAMES": " ".join(names)},
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            check=True,
        )
        reports = [
            line[line.index(word) :].split("\t")
            for line in done.stdout.splitlines()
            for word in ("MADE\t", "FAILED\t")
            if word in line
        ]
        folder.mkdir(parents=True, exist_ok=True)
        for status, name, shows in reports:
            print(f"freecad/{name} {status.lower()}", flush=True)
            if status == "MADE":
                take(Path(scratch), folder, name, shows)
    return sum(status != "MADE" for status, _, _ in reports)


def take(scratch: Path, folder: Path, name: str, shows: str) -> None:
    """Moves one model's files into the fixtures and writes its reference."""
    for old in folder.glob(f"{name}.*"):
        old.unlink()
    for extension in ("step", "stl", "obj"):
        shutil.move(scratch / f"{name}.{extension}", folder / f"{name}.{extension}")
    step = folder / f"{name}.step"
    settle_header(step)
    file = StepFile(step)
    figures = with_entities(measure(file.shape, bounding_box(file.shape)), file)
    write_reference(folder / f"{name}.reference.json", {"source": SOURCE, "shows": shows, **figures})
