"""Registering hand-written IGES files."""

from __future__ import annotations

from catalogue import hand


def iges(name: str, shows: str):
    """Registers the decorated function as the builder of `fixtures/iges/NAME.igs`."""
    return hand(name, shows, folder="iges", extension=".igs")
