"""IGES 5.3 files in the fixed format, entity by entity."""

from __future__ import annotations

from dataclasses import dataclass, field

#: Status fields: blanked, subordinate, usage, hierarchy.
FREE = "00000000"
#: Physically dependent: a part of another entity.
PART = "00010000"
#: A part that is a curve in a surface's parameters.
IN_PARAMETERS = "00010500"
#: Logically dependent: a member of a group.
MEMBER = "00020000"
#: Not shown.
BLANKED = "01000000"

#: Columns of a line for parameters, and for the Start and Global sections.
PARAMETER_COLUMNS, TEXT_COLUMNS = 64, 72


class Raw(str):
    """A parameter that is written as it stands."""


@dataclass
class Entity:
    """One directory entry and its parameters (those after the type's number)."""

    kind: int
    parameters: list
    form: int = 0
    status: str = FREE
    color: int = 0
    level: int = 0
    transformation: int = 0
    structure: int = 0
    label: str = ""
    subscript: int | str = ""
    #: Entities that refer back, and properties, listed after the entity's own parameters.
    back: list[int] = field(default_factory=list)
    properties: list[int] = field(default_factory=list)


@dataclass
class Layout:
    """How a file is written, where that is not the usual way."""

    separator: str = ","
    terminator: str = ";"
    line_end: str = "\n"
    #: The letter before exponents.
    exponent: str = "E"
    #: Columns for parameters; fewer make more lines.
    columns: int = PARAMETER_COLUMNS


@dataclass
class Global:
    """The Global section; a `None` is left out."""

    name: str
    file_name: str = ""
    scale: float | None = 1.0
    unit: int | None = 2
    unit_name: str | None = "MM"
    resolution: float | None = 1e-6
    largest: float | None = 1000.0
    version: int | None = 11
    author: str | None = "trimloop"
    system: str | None = "trimloop"

    def fields(self, layout: Layout) -> list:
        comma = layout.separator != "," or layout.terminator != ";"
        marks = [layout.separator, layout.terminator] if comma else [None, None]
        date = "20000101.000000"
        return [
            *marks,
            self.name,
            self.file_name or f"{self.name}.igs",
            self.system,
            "tools/reference",
            32,
            38,
            6,
            308,
            15,
            self.name,
            self.scale,
            self.unit,
            self.unit_name,
            1,
            0.1,
            date,
            self.resolution,
            self.largest,
            self.author,
            "",
            self.version,
            0,
            date,
        ]


class Deck:
    """A file that grows by entities; pointers are the odd numbers of their directory entries."""

    def __init__(self, name: str, layout: Layout | None = None, **fields):
        self.layout = layout or Layout()
        self.head = Global(name, **fields)
        self.start = ["A fixture of trimloop, written by tools/reference."]
        self.entities: list[Entity] = []

    def add(self, kind: int, parameters, **options) -> int:
        """Adds an entity; options are the fields of `Entity`."""
        self.entities.append(Entity(kind, list(parameters), **options))
        return 2 * len(self.entities) - 1

    def next(self) -> int:
        """The pointer that the next entity will have."""
        return 2 * len(self.entities) + 1

    def __getitem__(self, pointer: int) -> Entity:
        return self.entities[pointer // 2]

    def text(self) -> str:
        sections = self.sections()
        counts = "".join(f"{letter}{len(lines):7d}" for letter, lines in sections.items())
        sections["T"] = [counts]
        end = self.layout.line_end
        return "".join(
            line.ljust(TEXT_COLUMNS) + f"{letter}{number:7d}" + end
            for letter, lines in sections.items()
            for number, line in enumerate(lines, 1)
        )

    def sections(self) -> dict[str, list[str]]:
        """The first 72 columns of the lines of sections S, G, D and P."""
        directory, parameters = [], []
        for index, entity in enumerate(self.entities):
            pointer = 2 * index + 1
            lines = self.wrapped([entity.kind, *self._parameters(entity)], self.layout.columns)
            directory += directory_lines(entity, len(parameters) + 1, len(lines))
            parameters += [line.ljust(PARAMETER_COLUMNS) + f"{pointer:8d}" for line in lines]
        return {
            "S": self.start,
            "G": self.wrapped(self.head.fields(self.layout), TEXT_COLUMNS),
            "D": directory,
            "P": parameters,
        }

    @staticmethod
    def _parameters(entity: Entity) -> list:
        if not (entity.back or entity.properties):
            return entity.parameters
        tail = [len(entity.back), *entity.back]
        if entity.properties:
            tail += [len(entity.properties), *entity.properties]
        return [*entity.parameters, *tail]

    def wrapped(self, values: list, columns: int) -> list[str]:
        """Values as lines; strings may cross lines, numbers do not."""
        lines, line = [], ""
        for index, value in enumerate(values):
            mark = self.layout.terminator if index == len(values) - 1 else self.layout.separator
            text = self.written(value) + mark
            if isinstance(value, str) and not isinstance(value, Raw):
                count = len(text) - len(value) - 1
                # The count and its H stay together.
                if len(line) + count > columns:
                    lines.append(line)
                    line = ""
                line += text
                while len(line) > columns:
                    lines.append(line[:columns])
                    line = line[columns:]
                continue
            if len(line) + len(text) > columns:
                lines.append(line)
                line = ""
            line += text
        return [*lines, line]

    def written(self, value) -> str:
        if value is None:
            return ""
        if isinstance(value, Raw):
            return str(value)
        if isinstance(value, str):
            return f"{len(value)}H{value}" if value else ""
        if isinstance(value, bool):
            return str(int(value))
        if isinstance(value, int):
            return str(value)
        return real(float(value), self.layout.exponent)


def real(value: float, exponent: str = "E") -> str:
    """A real as IGES writes it: always with a point."""
    text = repr(value + 0.0)
    if text.endswith(".0"):
        text = text[:-1]
    if "e" not in text:
        return text if exponent == "E" else f"{text}{exponent}0"
    digits, power = text.split("e")
    return f"{digits if '.' in digits else digits + '.'}{exponent}{int(power):+03d}"


def directory_lines(entity: Entity, first: int, count: int) -> list[str]:
    """The two lines of a directory entry."""

    def fields(*values) -> str:
        return "".join(f"{value:>8}" for value in values)

    return [
        fields(entity.kind, first, entity.structure, 0, entity.level, 0, entity.transformation, 0, entity.status),
        fields(entity.kind, 0, entity.color, count, entity.form, "", "", entity.label, entity.subscript),
    ]
