"""Hand-written IGES files, one module per theme."""

from iges import (  # noqa: F401
    curves,
    looks,
    loose,
    placement,
    primitives,
    solids,
    structure,
    surfaces,
    syntax,
    trimming,
)
