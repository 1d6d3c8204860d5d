"""Prisms over outlines of any kind of curve: every curve becomes an edge of two planes and the base of one wall."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Callable

import numpy as np

from part21 import Ref
from plane_curves import Piece, line_piece
from step_model import Z, StepModel


@dataclass
class Segment:
    """A part of an outline, run so that the inside is to the left."""

    start: tuple[float, float]
    end: tuple[float, float]
    pieces: list[Piece]
    #: Writes the curve at height z.
    curve: Callable[[StepModel, float], Ref]
    #: Whether the curve runs from start to end.
    forward: bool = True
    #: Writes the wall's surface over the curve at z = 0; None: a surface of linear extrusion.
    wall: Callable[[StepModel], Ref] | None = None
    #: The kind of that surface.
    kind: str = "extrusion"
    #: Whether that surface's normal points out of the outline.
    outward: bool = True


def straight(start, end) -> Segment:
    """A line."""
    direction = np.array(end) - np.array(start)
    direction = direction / np.hypot(*direction)
    normal = (float(direction[1]), float(-direction[0]), 0.0)
    return Segment(
        start,
        end,
        [line_piece(start, end)],
        lambda model, z: model.line((*start, z), (*end, z)),
        wall=lambda model: model.plane((*start, 0.0), normal, (float(direction[0]), float(direction[1]), 0.0)),
        kind="plane",
    )


def outline_figures(segments) -> tuple[float, tuple[float, float], np.ndarray]:
    """Area, centroid and box of an outline."""
    pieces = [piece for segment in segments for piece in segment.pieces]
    area, x, y = sum(piece.moments() for piece in pieces)
    boxes = np.array([piece.box() for piece in pieces])
    return float(area), (float(x / area), float(y / area)), np.array([boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0)])


def sheet(model: StepModel, name: str, segments) -> dict:
    """A plane face within the outline; returns the reference."""
    area, centroid, box = outline_figures(segments)
    edges = [(model.edge((*s.start, 0.0), (*s.end, 0.0), s.curve(model, 0.0), s.forward), True) for s in segments]
    face = model.face(model.plane(), [model.loop(*edges)], kind="plane", area=area, centroid=(*centroid, 0.0))
    body = model.add("SHELL_BASED_SURFACE_MODEL", "", [model.add("OPEN_SHELL", "", [face])])
    model.product(name, [body], representation="MANIFOLD_SURFACE_SHAPE_REPRESENTATION")
    return model.reference(bbox=[[*map(float, box[0]), 0.0], [*map(float, box[1]), 0.0]], closed=False)


def prism(model: StepModel, name: str, segments, height: float) -> dict:
    """The solid over the outline from z = 0 to `height`; returns the reference."""
    area, centroid, box = outline_figures(segments)
    low = [model.edge((*s.start, 0.0), (*s.end, 0.0), s.curve(model, 0.0), s.forward) for s in segments]
    high = [model.edge((*s.start, height), (*s.end, height), s.curve(model, height), s.forward) for s in segments]
    floor = model.face(
        model.plane(axis=(0.0, 0.0, -1.0)),
        [model.loop(*((edge, False) for edge in reversed(low)))],
        kind="plane",
        area=area,
        centroid=(*centroid, 0.0),
    )
    lid = model.face(
        model.plane((0.0, 0.0, height)), [model.loop(*high)], kind="plane", area=area, centroid=(*centroid, height)
    )
    walls = [wall(model, segment, a, b, height) for segment, a, b in zip(segments, low, high)]
    model.product(name, [model.solid([floor, lid, *walls])])
    return model.reference(volume=area * height, bbox=[[*map(float, box[0]), 0.0], [*map(float, box[1]), height]])


def wall(model: StepModel, segment: Segment, low: Ref, high: Ref, height: float) -> Ref:
    """The wall over one segment."""
    right, up_right = model.straight((*segment.end, 0.0), (*segment.end, height))
    left, up_left = model.straight((*segment.start, 0.0), (*segment.start, height))
    if segment.wall is None:
        surface = model.add("SURFACE_OF_LINEAR_EXTRUSION", "", segment.curve(model, 0.0), model.vector(Z))
        same_sense = segment.forward
    else:
        surface, same_sense = segment.wall(model), segment.outward
    length = sum(piece.length() for piece in segment.pieces)
    x, y = sum(piece.length_moments() for piece in segment.pieces) / length
    return model.face(
        surface,
        [model.loop(low, (right, up_right), (high, False), (left, not up_left))],
        kind=segment.kind,
        area=length * height,
        centroid=(float(x), float(y), height / 2),
        same_sense=same_sense,
    )
