"""Solids of constructive geometry, each alone."""

from __future__ import annotations

from math import cos, pi, sin, sqrt

import numpy as np

from iges.catalogue import iges
from iges_deck import PART
from iges_model import IgesModel, around, box_sides
from surface_figures import Piece, flat_polygon, frame, placed, quarters, revolved, stacked

#: Directions of unit length that are no axis.
SLANTING = (2 / 3, 2 / 3, 1 / 3)
ACROSS = (-1 / sqrt(2), 1 / sqrt(2), 0.0)
PLACE = (10.0, -4.0, 6.0)


def rows_of(origin=PLACE, axis=SLANTING, x=ACROSS) -> np.ndarray:
    """From the primitive's own axes to the model's."""
    return np.column_stack([frame(axis, x), origin])


def body(pieces, volume: float, rows=None, **more) -> dict:
    """The reference of a solid whose sides are these pieces."""
    if rows is not None:
        pieces = [placed(piece, rows) for piece in pieces]
    area = sum(piece.area for piece in pieces)
    centroid = sum(piece.area * np.array(piece.centroid) for piece in pieces) / area
    return {
        "area_mm2": area,
        "volume_mm3": volume,
        "bbox_mm": around(piece.box for piece in pieces),
        "closed": True,
        "solids": 1,
        "area_centroid_mm": [float(c) for c in centroid],
        "colours": {"none": area},
        **more,
    }


def ring(radius: float, z: float, inner: float = 0.0) -> Piece:
    """A round plane, or a washer."""
    return Piece(lambda r, a: stacked(r * np.cos(a), r * np.sin(a), z), (inner, radius), quarters(0.0, 2 * pi))


def block_pieces(x: float, y: float, z: float) -> list[Piece]:
    return [piece for side in box_sides((0.0, 0.0, 0.0), (x, y, z)) for piece in flat_polygon(side)]


@iges("primitive_150_block", "a block (150) with slanting axes")
def block():
    model = IgesModel("primitive_150_block")
    model.add(150, [30.0, 20.0, 10.0, *PLACE, *ACROSS, *SLANTING])
    return model, body(block_pieces(30.0, 20.0, 10.0), 6000.0, rows_of())


@iges("primitive_150_block_defaults", "a block (150) with nothing but its lengths: the rest is left out")
def block_defaults():
    model = IgesModel("primitive_150_block_defaults")
    model.add(150, [30.0, 20.0, 10.0])
    return model, body(block_pieces(30.0, 20.0, 10.0), 6000.0)


@iges("primitive_150_block_moved", "a block (150) under a transformation matrix")
def block_moved():
    model = IgesModel("primitive_150_block_moved")
    rows = ((0.0, -0.8, 0.6, 7.0), (1.0, 0.0, 0.0, -2.0), (0.0, 0.6, 0.8, 11.0))
    model.add(150, [30.0, 20.0, 10.0, 1.0, 2.0, 3.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0], transformation=model.matrix(rows))
    inner = ((1.0, 0.0, 0.0, 1.0), (0.0, 1.0, 0.0, 2.0), (0.0, 0.0, 1.0, 3.0))
    pieces = [placed(piece, inner) for piece in block_pieces(30.0, 20.0, 10.0)]
    return model, body(pieces, 6000.0, rows)


def wedge_pieces(x: float, y: float, z: float, top: float) -> list[Piece]:
    """x along the lower side (y = 0), `top` along the upper."""
    low, high = [(0.0, 0.0), (x, 0.0)], [(top, y), (0.0, y)] if top else [(0.0, y)]
    outline = [*low, *high]
    sides = [[(*p, 0.0) for p in outline], [(*p, z) for p in outline]]
    sides += [[(*a, 0.0), (*b, 0.0), (*b, z), (*a, z)] for a, b in zip(outline, outline[1:] + outline[:1])]
    return [piece for side in sides for piece in flat_polygon(side)]


@iges("primitive_152_wedge", "a right angular wedge (152) that is cut off at the top, with slanting axes")
def wedge():
    model = IgesModel("primitive_152_wedge")
    model.add(152, [30.0, 20.0, 10.0, 12.0, *PLACE, *ACROSS, *SLANTING])
    return model, body(wedge_pieces(30.0, 20.0, 10.0, 12.0), 4200.0, rows_of())


@iges("primitive_152_wedge_sharp", "a right angular wedge (152) that ends in an edge")
def wedge_sharp():
    model = IgesModel("primitive_152_wedge_sharp")
    model.add(152, [30.0, 20.0, 10.0, 0.0, 5.0, 5.0, 5.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0])
    rows = rows_of((5.0, 5.0, 5.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0))
    return model, body(wedge_pieces(30.0, 20.0, 10.0, 0.0), 3000.0, rows)


@iges("primitive_154_cylinder", "a right circular cylinder (154) along a slanting axis")
def cylinder():
    model = IgesModel("primitive_154_cylinder")
    model.add(154, [25.0, 8.0, *PLACE, *SLANTING])
    wall = revolved(lambda t: (8.0 + 0 * t, t), (0.0, 25.0), 0.0, 2 * pi)
    return model, body([wall, ring(8.0, 0.0), ring(8.0, 25.0)], 1600 * pi, rows_of())


@iges("primitive_156_cone", "a right circular cone frustum (156) along a slanting axis")
def cone():
    model = IgesModel("primitive_156_cone")
    model.add(156, [12.0, 9.0, 4.0, *PLACE, *SLANTING])
    wall = revolved(lambda t: (9.0 - 5.0 * t, 12.0 * t), (0.0, 1.0), 0.0, 2 * pi)
    volume = pi * 12 * (81 + 36 + 16) / 3
    return model, body([wall, ring(9.0, 0.0), ring(4.0, 12.0)], volume, rows_of())


@iges("primitive_156_cone_with_apex", "a right circular cone (156) whose second radius is left out: an apex")
def cone_with_apex():
    model = IgesModel("primitive_156_cone_with_apex")
    model.add(156, [12.0, 9.0, None, 1.0, 2.0, 3.0, 0.0, -1.0, 0.0])
    wall = revolved(lambda t: (9.0 - 9.0 * t, 12.0 * t), (0.0, 1.0), 0.0, 2 * pi)
    rows = rows_of((1.0, 2.0, 3.0), (0.0, -1.0, 0.0), (1.0, 0.0, 0.0))
    return model, body([wall, ring(9.0, 0.0)], 324 * pi, rows)


def ball(radius: float) -> Piece:
    return revolved(lambda t: (radius * np.sin(t), -radius * np.cos(t)), (0.0, pi / 2, pi), 0.0, 2 * pi)


@iges("primitive_158_sphere", "a sphere (158) about a point that is not the origin")
def sphere():
    model = IgesModel("primitive_158_sphere")
    model.add(158, [7.0, *PLACE])
    return model, body([ball(7.0)], 343 * 4 / 3 * pi, rows_of())


@iges("primitive_160_torus", "a torus (160) about a slanting axis")
def torus():
    model = IgesModel("primitive_160_torus")
    model.add(160, [15.0, 4.0, *PLACE, *SLANTING])
    tube = revolved(lambda t: (15.0 + 4.0 * np.cos(t), 4.0 * np.sin(t)), quarters(0.0, 2 * pi), 0.0, 2 * pi)
    return model, body([tube], 2 * pi**2 * 15 * 16, rows_of())


@iges("primitive_168_ellipsoid", "an ellipsoid (168) with slanting axes")
def ellipsoid():
    model = IgesModel("primitive_168_ellipsoid")
    model.add(168, [12.0, 8.0, 5.0, *PLACE, *ACROSS, *SLANTING])
    round_ = ball(1.0)
    shell = Piece(lambda u, v: round_.at(u, v) * np.array((12.0, 8.0, 5.0)), round_.u_breaks, round_.v_breaks)
    return model, body([shell], 4 / 3 * pi * 480, rows_of())


def on_axes(rows, radius: float, height: float) -> tuple:
    """The point in the half plane of angle zero at this radius and height."""
    return tuple(float(c) for c in rows[:, :3] @ (radius, 0.0, height) + rows[:, 3])


def turned_polyline(profile, share: float) -> tuple[list[Piece], float]:
    """The walls that a polyline of (radius, height) sweeps in a share of a turn, and the volume towards the axis."""
    walls, volume = [], 0.0
    for (r0, z0), (r1, z1) in zip(profile, profile[1:]):
        if r0 or r1:
            straight = lambda t, r0=r0, z0=z0, r1=r1, z1=z1: (r0 + t * (r1 - r0), z0 + t * (z1 - z0))  # noqa: E731
            walls.append(revolved(straight, (0.0, 1.0), 0.0, share * 2 * pi))
        volume += share * pi * (z1 - z0) * (r0 * r0 + r0 * r1 + r1 * r1) / 3
    return walls, volume


def end_planes(polygon, share: float) -> list[Piece]:
    """The plane ends of a partial turn of a convex polygon of (radius, height)."""
    return [
        piece
        for angle in (0.0, share * 2 * pi)
        for piece in flat_polygon([(r * cos(angle), r * sin(angle), z) for r, z in polygon])
    ]


STEPS = [(8.0, 0.0), (8.0, 10.0), (3.0, 16.0)]


def revolution_to_axis(name: str, share: float, kind: int):
    """A solid of revolution of form 0 over a polyline."""
    model = IgesModel(name)
    rows = rows_of()
    points = [on_axes(rows, r, z) for r, z in STEPS]
    if kind == 106:
        curve = model.add(106, [2, 3, *(c for p in points for c in p)], form=12, status=PART)
    else:
        curve = model.composite([model.line(a, b) for a, b in zip(points, points[1:])])
    model.add(162, [curve, share, *PLACE, *SLANTING])
    closed = [(0.0, 0.0), *STEPS, (0.0, 16.0)]
    pieces, volume = turned_polyline(closed, share)
    if share < 1.0:
        pieces += end_planes(closed, share)
    return model, body(pieces, volume, rows)


@iges("primitive_162_to_axis", "a solid of revolution (162 form 0): two lines, closed to the axis")
def revolution_whole():
    return revolution_to_axis("primitive_162_to_axis", 1.0, 102)


@iges("primitive_162_to_axis_quarter", "a quarter turn of a polyline that is closed to the axis (162 form 0)")
def revolution_quarter():
    return revolution_to_axis("primitive_162_to_axis_quarter", 0.25, 106)


@iges("primitive_162_arc_to_axis", "half a circle from axis to axis (162 form 0): a ball")
def revolution_ball():
    model = IgesModel("primitive_162_arc_to_axis")
    # The arc's own plane is turned up: its x becomes x, its y becomes z.
    up = model.matrix(((1.0, 0.0, 0.0, 3.0), (0.0, 0.0, -1.0, 4.0), (0.0, 1.0, 0.0, 5.0)))
    curve = model.arc((0.0, 0.0), (0.0, -6.0), (0.0, 6.0), transformation=up)
    model.add(162, [curve, 1.0, 3.0, 4.0, 5.0, 0.0, 0.0, 1.0])
    return model, body([ball(6.0)], 288 * pi, rows_of((3.0, 4.0, 5.0), (0.0, 0.0, 1.0), (1.0, 0.0, 0.0)))


@iges("primitive_162_closed", "a triangle turned about an axis beside it (162 form 1): a ring")
def revolution_ring():
    model = IgesModel("primitive_162_closed")
    rows = rows_of()
    profile = [(6.0, 0.0), (12.0, 2.0), (7.0, 9.0)]
    curve = model.polyline(*(on_axes(rows, r, z) for r, z in profile))
    model.add(162, [curve, 1.0, *PLACE, *SLANTING], form=1)
    pieces, volume = turned_polyline([*profile, profile[0]], 1.0)
    return model, body(pieces, volume, rows)


@iges("primitive_162_closed_part", "two fifths of a turn of a circle beside the axis (162 form 1): a bent rod")
def revolution_rod():
    model = IgesModel("primitive_162_closed_part")
    up = model.matrix(((1.0, 0.0, 0.0, 0.0), (0.0, 0.0, -1.0, 0.0), (0.0, 1.0, 0.0, 0.0)))
    curve = model.circle((15.0, 0.0), 4.0, transformation=up)
    model.add(162, [curve, 0.4, 0.0, 0.0, -9.0, 0.0, 0.0, 1.0], form=1)
    angle = 0.8 * pi
    tube = revolved(lambda t: (15.0 + 4.0 * np.cos(t), 4.0 * np.sin(t)), quarters(0.0, 2 * pi), 0.0, angle)
    ends = [
        Piece(
            lambda r, t, a=a: stacked((15.0 + r * np.cos(t)) * cos(a), (15.0 + r * np.cos(t)) * sin(a), r * np.sin(t)),
            (0.0, 4.0),
            quarters(0.0, 2 * pi),
        )
        for a in (0.0, angle)
    ]
    return model, body([tube, *ends], 16 * pi * 15 * angle)


@iges("primitive_162_closed_by_line", "an open arc that its chord closes (162 form 1)")
def revolution_chord():
    model = IgesModel("primitive_162_closed_by_line")
    up = model.matrix(((1.0, 0.0, 0.0, 0.0), (0.0, 0.0, -1.0, 0.0), (0.0, 1.0, 0.0, 0.0)))
    curve = model.arc((10.0, 0.0), (10.0, -4.0), (10.0, 4.0), transformation=up)
    model.add(162, [curve, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0], form=1)
    outside = revolved(lambda t: (10.0 + 4.0 * np.cos(t), 4.0 * np.sin(t)), (-pi / 2, 0.0, pi / 2), 0.0, 2 * pi)
    inside = revolved(lambda t: (10.0 + 0 * t, t), (-4.0, 4.0), 0.0, 2 * pi)
    # Pappus: half a disk, whose centroid is 4 r / 3 pi off its chord.
    volume = 2 * pi * (10 + 16 / (3 * pi)) * 8 * pi
    return model, body([outside, inside], volume)


@iges("primitive_164_circle", "a circle extruded not at right angles to its plane (164)")
def extrusion_circle():
    model = IgesModel("primitive_164_circle")
    curve = model.circle((3.0, 2.0), 6.0, 1.0)
    model.add(164, [curve, 15.0, 0.6, 0.0, 0.8])
    wall = Piece(
        lambda t, s: stacked(3.0 + 6.0 * np.cos(t) + 9.0 * s, 2.0 + 6.0 * np.sin(t), 1.0 + 12.0 * s),
        quarters(0.0, 2 * pi),
        (0.0, 1.0),
    )
    ends = [
        Piece(
            lambda r, t, x=x, z=z: stacked(x + r * np.cos(t), 2.0 + r * np.sin(t), z),
            (0.0, 6.0),
            quarters(0.0, 2 * pi),
        )
        for x, z in ((3.0, 1.0), (12.0, 13.0))
    ]
    return model, body([wall, *ends], 36 * pi * 12)


@iges("primitive_164_composite", "lines and an arc extruded downwards (164)")
def extrusion_composite():
    model = IgesModel("primitive_164_composite")
    parts = [
        model.line((-5.0, 0.0, 0.0), (5.0, 0.0, 0.0)),
        model.line((5.0, 0.0, 0.0), (5.0, 8.0, 0.0)),
        model.arc((0.0, 8.0), (5.0, 8.0), (-5.0, 8.0)),
        model.line((-5.0, 8.0, 0.0), (-5.0, 0.0, 0.0)),
    ]
    model.add(164, [model.composite(parts), 9.0, 0.0, 0.0, -1.0])
    pieces = []
    for z in (0.0, -9.0):
        pieces += flat_polygon([(-5.0, 0.0, z), (5.0, 0.0, z), (5.0, 8.0, z), (-5.0, 8.0, z)])
        half = lambda r, t, z=z: stacked(r * np.cos(t), 8.0 + r * np.sin(t), z)  # noqa: E731
        pieces.append(Piece(half, (0.0, 5.0), (0.0, pi / 2, pi)))
    for a, b in (((-5.0, 0.0), (5.0, 0.0)), ((5.0, 0.0), (5.0, 8.0)), ((-5.0, 8.0), (-5.0, 0.0))):
        pieces += flat_polygon([(*a, 0.0), (*b, 0.0), (*b, -9.0), (*a, -9.0)])
    pieces.append(Piece(lambda t, z: stacked(5 * np.cos(t), 8.0 + 5 * np.sin(t), z), (0.0, pi / 2, pi), (-9.0, 0.0)))
    return model, body(pieces, (80 + 12.5 * pi) * 9)


@iges("primitive_164_polyline", "a closed polyline (106 form 63) extruded, under a matrix")
def extrusion_polyline():
    model = IgesModel("primitive_164_polyline")
    points = [(0.0, 0.0), (20.0, 0.0), (0.0, 10.0)]
    curve = model.add(106, [1, 4, 2.0, *(c for p in [*points, points[0]] for c in p)], form=63, status=PART)
    rows = ((0.0, 0.0, 1.0, 4.0), (1.0, 0.0, 0.0, 5.0), (0.0, 1.0, 0.0, 6.0))
    model.add(164, [curve, 7.0, 0.0, 0.0, 1.0], transformation=model.matrix(rows))
    pieces = [p for z in (2.0, 9.0) for p in flat_polygon([(x, y, z) for x, y in points])]
    for a, b in zip(points, points[1:] + points[:1]):
        pieces += flat_polygon([(*a, 2.0), (*b, 2.0), (*b, 9.0), (*a, 9.0)])
    return model, body(pieces, 700.0, rows)
