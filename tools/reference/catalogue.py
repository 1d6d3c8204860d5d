"""The list of fixtures: each is a function that returns a model, registered with what it shows."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Callable

#: Every registered fixture by (folder, name), in the order of registration.
FIXTURES: dict[tuple[str, str], "Fixture"] = {}


@dataclass
class StepOptions:
    """How OpenCASCADE writes the STEP file."""

    #: AP203, AP214 or AP242.
    schema: str = "AP214"
    #: Length unit of the file: MM, INCH, M, CM, FT, UM, KM.
    unit: str = "MM"
    #: Whether edges carry their curves in the surfaces' parameters.
    pcurves: bool = True
    #: Whether characters beyond ASCII are written as they are, not as \\X2\\ escapes.
    raw_unicode: bool = False


@dataclass
class Fixture:
    """One model and how its files are written."""

    name: str
    folder: str
    #: One line for the reader of the table: what the model exercises.
    shows: str
    #: Returns a cadquery Shape, Workplane or Assembly, or an XCAF document.
    build: Callable[[], object]
    step: StepOptions = field(default_factory=StepOptions)
    #: Largest distance of the exported meshes from the surface, as a part of the box's diagonal.
    deflection: float = 3e-3
    #: Largest angle of the exported meshes, radians.
    angular: float = 0.6
    #: False where OpenCASCADE misreads the (right) file it wrote: the reference is then the model in memory.
    reads_back: bool = True
    #: Whether meshes are exported; not where another fixture's would be the same.
    meshes: bool = True
    #: Figures known in closed form, which the measured ones must meet: area_mm2, volume_mm3.
    closed_form: dict[str, float] = field(default_factory=dict)


def fixture(name: str, shows: str, *, folder: str = "cadquery", **options):
    """Registers the decorated function as the builder of the fixture `name`."""

    def register(build):
        assert (folder, name) not in FIXTURES, name
        FIXTURES[folder, name] = Fixture(name, folder, shows, build, **options)
        return build

    return register


#: Hand-written files by (folder, name).
HAND: dict[tuple[str, str], "HandWritten"] = {}


@dataclass
class HandWritten:
    """A file that no CAD tool at hand writes, made entity by entity."""

    name: str
    folder: str
    shows: str
    #: Returns the file (a Part21, text or bytes) and its reference without source and description.
    build: Callable[[], tuple[object, dict]]
    extension: str = ".step"


def hand(name: str, shows: str, *, folder: str = "hand", extension: str = ".step"):
    """Registers the decorated function as the builder of the hand-written file `name`."""

    def register(build):
        assert (folder, name) not in HAND, name
        HAND[folder, name] = HandWritten(name, folder, shows, build, extension)
        return build

    return register
