"""The models, one module per family."""

from models import primitives  # noqa: F401
