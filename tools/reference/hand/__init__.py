"""Hand-written files for what CAD tools at hand do not write, one module per theme."""

from hand import (  # noqa: F401
    assemblies,
    curves,
    seamless,
    sloppy,
    styles,
    surfaces,
    syntax,
    tessellated,
    topology,
    units,
)
