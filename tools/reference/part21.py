"""Writing ISO 10303-21 text by hand: no schema, no checks, whatever is asked for."""

from __future__ import annotations

from dataclasses import dataclass


class Ref(int):
    """An instance's name: Ref(7) is written #7."""


class Enum(str):
    """An enumeration value: Enum("T") is written .T."""


@dataclass(frozen=True)
class Typed:
    """A value with its type: Typed("LENGTH_MEASURE", 2.0) is written LENGTH_MEASURE(2.)."""

    keyword: str
    value: object


@dataclass(frozen=True)
class Raw:
    """Text that is written as it stands."""

    text: str


#: Written as an asterisk: an attribute that is derived in a subtype.
DERIVED = Raw("*")
TRUE, FALSE, UNKNOWN = Enum("T"), Enum("F"), Enum("U")


def logical(value: bool) -> Enum:
    """.T. or .F."""
    return TRUE if value else FALSE


def real(value: float) -> str:
    """A real number, which in this format always has a point: 1., 0.25, 1.E-05."""
    text = repr(float(value)).upper()
    mantissa, _, exponent = text.partition("E")
    mantissa = mantissa[:-1] if mantissa.endswith(".0") else mantissa
    if "." not in mantissa:
        mantissa += "."
    return f"{mantissa}E{exponent}" if exponent else mantissa


def string(value: str) -> str:
    """A string with quotes and backslashes doubled and everything beyond ASCII in \\X2\\ or \\X4\\ escapes."""
    parts, run = [], []

    def flush() -> None:
        if not run:
            return
        if max(run) > 0xFFFF:
            parts.append("\\X4\\" + "".join(f"{code:08X}" for code in run) + "\\X0\\")
        else:
            parts.append("\\X2\\" + "".join(f"{code:04X}" for code in run) + "\\X0\\")
        run.clear()

    for character in value:
        if " " <= character <= "~":
            flush()
            parts.append({"'": "''", "\\": "\\\\"}.get(character, character))
        else:
            run.append(ord(character))
    flush()
    return "'" + "".join(parts) + "'"


def parameter(value) -> str:
    """Any parameter as text."""
    match value:
        case None:
            return "$"
        case Raw():
            return value.text
        case Ref():
            return f"#{int(value)}"
        case Enum():
            return f".{value}."
        case Typed():
            return f"{value.keyword}({parameter(value.value)})"
        case bool():
            return f".{'T' if value else 'F'}."
        case int():
            return str(value)
        case float():
            return real(value)
        case str():
            return string(value)
        case list() | tuple():
            return "(" + ",".join(map(parameter, value)) + ")"
    raise TypeError(f"no parameter: {value!r}")


class Part21:
    """A file with one DATA section that grows instance by instance."""

    def __init__(self, schema: str = "AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }", description: str = ""):
        self.schema = schema
        self.description = description
        self.lines: list[str] = []
        self.keywords: dict[int, str] = {}
        self.next_id = 1

    def add(self, keyword: str, *parameters) -> Ref:
        """Adds a simple instance."""
        return self.add_text(f"{keyword}({','.join(map(parameter, parameters))})", keyword)

    def add_complex(self, **parts) -> Ref:
        """Adds a complex instance: `NAME=(parameters, ...)` each, in the order given."""
        inner = " ".join(f"{name}({','.join(map(parameter, values))})" for name, values in parts.items())
        return self.add_text(f"({inner})", "+".join(parts))

    def add_text(self, text: str, keyword: str = "") -> Ref:
        """Adds an instance whose right-hand side is given as text."""
        ref = Ref(self.next_id)
        self.next_id += 1
        self.keywords[ref] = keyword
        self.lines.append(f"#{int(ref)}={text};")
        return ref

    def reserve(self) -> Ref:
        """A name for an instance that is defined later, by `define`."""
        ref = Ref(self.next_id)
        self.next_id += 1
        return ref

    def define(self, ref: Ref, keyword: str, *parameters) -> Ref:
        """Defines a reserved instance."""
        self.keywords[ref] = keyword
        self.lines.append(f"#{int(ref)}={keyword}({','.join(map(parameter, parameters))});")
        return ref

    def header(self) -> str:
        """The file's first lines, up to the DATA section."""
        return (
            "ISO-10303-21;\nHEADER;\n"
            f"FILE_DESCRIPTION(({string(self.description)}),'2;1');\n"
            "FILE_NAME('','2000-01-01T00:00:00',('Trimloop'),(''),'tools/reference','hand-written','');\n"
            f"FILE_SCHEMA(({string(self.schema)}));\nENDSEC;\n"
        )

    def text(self) -> str:
        """The whole file."""
        return self.header() + "DATA;\n" + "\n".join(self.lines) + "\nENDSEC;\nEND-ISO-10303-21;\n"
