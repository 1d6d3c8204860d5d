"""The tables in fixtures/README.md, made of what the references say."""

from __future__ import annotations

import json
from pathlib import Path

MARK = "<!-- The tables below are written by tools/reference/make. -->"
FOLDERS = {
    "cadquery": "Made with cadquery",
    "freecad": "Made with FreeCAD",
    "hand": "Written by hand",
    "sloppy": "Sloppy files",
    "iges": "IGES written by hand",
    "iges_opencascade": "IGES written by OpenCASCADE",
}
#: Folders whose tables tell where OpenCASCADE differs.
DIFFERING = ("hand", "sloppy", "iges")


def write_tables(fixtures: Path) -> None:
    """Rewrites everything below the mark."""
    readme = fixtures / "README.md"
    head = readme.read_text(encoding="utf-8").split(MARK)[0]
    parts = [head + MARK + "\n"]
    for folder, title in FOLDERS.items():
        parts.append(f"\n## {title} (`{folder}/`)\n\n{table(fixtures / folder)}")
    parts.append(f"\n## Broken files (`broken/`)\n\n{broken_table(fixtures / 'broken')}")
    readme.write_text("".join(parts), encoding="utf-8")


def table(folder: Path) -> str:
    """One row per reference: what it shows, and where OpenCASCADE differs."""
    rows = []
    differing = folder.name in DIFFERING
    for path in sorted(folder.glob("*.reference.json")):
        reference = json.loads(path.read_text(encoding="utf-8"))
        name = path.name.removesuffix(".reference.json")
        cells = [f"`{name}`", cell(reference["shows"])]
        if differing:
            cells.append(cell("; ".join(reference.get("opencascade_differs", [])[:2])))
        rows.append("| " + " | ".join(cells) + " |")
    head = ["file", "shows"] + (["OpenCASCADE 7.9 sees"] if differing else [])
    return "\n".join(["| " + " | ".join(head) + " |", "| " + " | ".join("---" for _ in head) + " |", *rows]) + "\n"


def broken_table(folder: Path) -> str:
    """One row per broken file: what is wrong, and the exit codes that are right."""
    rows = ["| file | wrong is | exit |", "| --- | --- | --- |"]
    for entry in json.loads((folder / "expected.json").read_text(encoding="utf-8")):
        codes = " or ".join(map(str, entry["exit"]))
        rows.append(f"| `{entry['file']}` | {cell(entry['shows'])} | {codes} |")
    return "\n".join(rows) + "\n"


def cell(text: str) -> str:
    """Text that does not break a table."""
    return text.replace("|", "\\|").replace("\n", " ").replace("<", "&lt;")
