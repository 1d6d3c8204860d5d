"""The list of broken files, and what is expected of their conversion."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Callable

from iges_deck import Deck
from part21 import Part21


@dataclass
class Broken:
    """One file and what is expected of its conversion."""

    file: str
    #: What is wrong with it.
    shows: str
    #: Exit codes that are right: 2 nothing usable, 1 something lost, 0 where it does no harm.
    exit: list[int]
    #: What the message must contain, in any case of letters; any one of them.
    words: list[str] = field(default_factory=list)
    #: Area of what must still be written, where something can be.
    area_mm2: float | None = None


BROKEN: dict[str, tuple[Broken, Callable[[], object]]] = {}


def broken(file: str, shows: str, exit: list[int], words: list[str] | None = None, area: float | None = None):
    """Registers the decorated function, which returns the file's content."""

    def register(build):
        assert file not in BROKEN, file
        BROKEN[file] = (Broken(file, shows, exit, words or [], area), build)
        return build

    return register


def write_all(folder: Path) -> None:
    """Writes every broken file, and `expected.json`."""
    folder.mkdir(parents=True, exist_ok=True)
    for old in folder.iterdir():
        old.unlink()
    for name, (_, build) in BROKEN.items():
        content = build()
        if isinstance(content, (Part21, Deck)):
            content = content.text()
        (folder / name).write_bytes(content if isinstance(content, bytes) else content.encode())
    lines = [json.dumps({k: v for k, v in asdict(entry).items() if v is not None}) for entry, _ in BROKEN.values()]
    (folder / "expected.json").write_text("[\n" + ",\n".join(lines) + "\n]\n")
