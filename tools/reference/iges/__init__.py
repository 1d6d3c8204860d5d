"""Hand-written IGES files, one module per theme."""

from iges import loose  # noqa: F401
