"""The models, one module per family."""

from models import (  # noqa: F401
    assemblies,
    bodies,
    conics,
    features,
    files,
    holes,
    lofts_and_sweeps,
    primitives,
    scales,
    splines,
)
