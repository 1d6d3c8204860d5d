"""IGES models written by hand: words over `Deck` for curves, surfaces and faces, and the reference beside them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from iges_deck import BLANKED, IN_PARAMETERS, PART, Deck
from plane_curves import Spline
from spline_patch import Patch
from step_model import ORIGIN, Z, Point, plus, polygon_figures
from surface_figures import Piece

IDENTITY = ((1.0, 0.0, 0.0, 0.0), (0.0, 1.0, 0.0, 0.0), (0.0, 0.0, 1.0, 0.0))


@dataclass
class FaceFigures:
    """What is known of one face, in the file's unit."""

    entity: int
    surface: str
    area: float
    centroid: Point | None
    box: list
    #: How often the file places it.
    instances: int = 1
    hidden: bool = False

    def line(self, scale: float) -> dict:
        entry = {"entity": f"D{self.entity}", "surface": self.surface, "area_mm2": self.area * scale**2}
        if self.centroid is not None:
            entry["centroid_mm"] = [scale * c for c in self.centroid]
        return entry


@dataclass
class Boundary:
    """A closed curve: its entity in space, in parameters, or both."""

    model: int = 0
    parameter: int = 0
    preference: int = 2


class IgesModel(Deck):
    """An IGES file that grows, and the figures of what is in it."""

    def __init__(self, name: str, *arguments, **fields):
        super().__init__(name, *arguments, **fields)
        self.faces: list[FaceFigures] = []
        self._cache: dict = {}

    # Curves

    def line(self, start, end, **options) -> int:
        return self.add(110, [*map(float, start), *map(float, end)], status=PART, **options)

    def line_2d(self, start, end) -> int:
        return self.add(110, [*map(float, start), 0.0, *map(float, end), 0.0], status=IN_PARAMETERS)

    def arc(self, centre, start, end, z: float = 0.0, **options) -> int:
        """A circular arc, counter-clockwise in its own plane; a whole circle where start and end are one."""
        points = [float(c) for point in (centre, start, end) for c in point]
        return self.add(100, [float(z), *points], **{"status": PART, **options})

    def circle(self, centre, radius: float, z: float = 0.0, **options) -> int:
        start = (centre[0] + radius, centre[1])
        return self.arc(centre, start, start, z, **options)

    def composite(self, parts, **options) -> int:
        return self.add(102, [len(parts), *parts], **{"status": PART, **options})

    def polyline(self, *points, **options) -> int:
        """Lines round a polygon, composed."""
        return self.composite([self.line(a, b) for a, b in zip(points, (*points[1:], points[0]))], **options)

    def polyline_2d(self, *points) -> int:
        lines = [self.line_2d(a, b) for a, b in zip(points, (*points[1:], points[0]))]
        return self.composite(lines, status=IN_PARAMETERS)

    def spline(self, spline: Spline, *, part=None, normal=None, closed=False, periodic=False, **options) -> int:
        """A rational B-spline curve; poles of two coordinates lie at z = 0."""
        poles = [(*map(float, pole), 0.0)[:3] for pole in spline.poles]
        weights = spline.weights or [1.0] * len(poles)
        plane = normal is not None
        flags = [int(plane), int(closed), int(spline.weights is None), int(periodic)]
        values = [*map(float, spline.knots), *map(float, weights), *(c for pole in poles for c in pole)]
        low, high = part or spline.domain()
        return self.add(
            126,
            [len(poles) - 1, spline.degree, *flags, *values, float(low), float(high), *map(float, normal or ORIGIN)],
            **{"status": PART, **options},
        )

    # Points, directions, placements

    def point(self, p, **options) -> int:
        return self._once(116, [*map(float, p), 0], **{"status": PART, **options})

    def direction(self, d) -> int:
        return self._once(123, list(map(float, d)), status=PART)

    def matrix(self, rows, form: int = 0, **options) -> int:
        return self.add(124, [float(v) for row in rows for v in row], form=form, **options)

    # Surfaces

    def plane(self, origin=ORIGIN, normal=Z, **options) -> int:
        """The unbounded plane, type 108."""
        distance = sum(o * n for o, n in zip(origin, normal))
        values = [*map(float, normal), float(distance), 0, *map(float, origin), 0.0]
        return self.add(108, values, **{"status": PART, **options})

    def elementary(self, kind: int, origin, *values, axis=None, x=None, **options) -> int:
        """Types 190 to 198; form 1 where a reference direction is given. A sphere without has no axis either."""
        axes = [self.direction(axis)] if axis is not None else []
        tail = [self.direction(x)] if x is not None else []
        start = self.point(origin)
        if kind == 196:
            parameters = [start, *map(float, values), *axes, *tail]
        else:
            parameters = [start, *axes, *map(float, values), *tail]
        return self.add(kind, parameters, form=int(x is not None), **{"status": PART, **options})

    def flat(self, origin=ORIGIN, normal=Z, x=None, **options) -> int:
        """The plane as type 190."""
        return self.elementary(190, origin, axis=normal, x=x, **options)

    def patch(self, patch: Patch, *, part=None, closed=(False, False), periodic=(False, False), **options) -> int:
        """A rational B-spline surface, type 128."""
        rows, columns = patch.poles.shape[:2]
        weights = np.ones((rows, columns)) if patch.weights is None else np.array(patch.weights, float)
        (u0, u1), (v0, v1) = part or patch.domain()
        flags = [*map(int, closed), int(patch.weights is None), *map(int, periodic)]
        poles = [float(c) for j in range(columns) for i in range(rows) for c in patch.poles[i, j]]
        return self.add(
            128,
            [
                rows - 1,
                columns - 1,
                patch.u_degree,
                patch.v_degree,
                *flags,
                *map(float, patch.u_knots),
                *map(float, patch.v_knots),
                *(float(weights[i, j]) for j in range(columns) for i in range(rows)),
                *poles,
                *map(float, (u0, u1, v0, v1)),
            ],
            **options,
        )

    def bilinear(self, corner, along_u, along_v, **options) -> int:
        """A flat piece as a B-spline of degree 1 whose parameters run from 0 to 1."""
        poles = [
            [corner, plus(corner, along_v)],
            [plus(corner, along_u), plus(corner, along_u, along_v)],
        ]
        return self.patch(Patch(1, 1, poles, [0.0, 0.0, 1.0, 1.0], [0.0, 0.0, 1.0, 1.0]), **options)

    # Faces

    def on_surface(self, surface: int, boundary: Boundary | int) -> int:
        """Type 142; a plain pointer is a curve in space and nothing else."""
        if isinstance(boundary, int):
            boundary = Boundary(boundary)
        return self.add(142, [0, surface, boundary.parameter, boundary.model, boundary.preference], status=PART)

    def trimmed(self, surface: int, outer: Boundary | int | None, inner=(), **options) -> int:
        """Type 144; without an outer boundary the surface's own sides are it."""
        bound = 0 if outer is None else self.on_surface(surface, outer)
        holes = [self.on_surface(surface, hole) for hole in inner]
        return self.add(144, [surface, int(outer is not None), len(holes), bound, *holes], **options)

    def bounded(self, surface: int, boundaries, **options) -> int:
        """Type 143 over type 141. Each boundary: a list of (curve, sense, curves in parameters)."""
        kind = int(any(parameters for boundary in boundaries for _, _, parameters in boundary))
        made = []
        for boundary in boundaries:
            values = [part for c, sense, parameters in boundary for part in (c, sense, len(parameters), *parameters)]
            made.append(self.add(141, [kind, 2 if kind else 1, surface, len(boundary), *values], status=PART))
        return self.add(143, [kind, surface, len(made), *made], **options)

    def know(self, entity: int, surface: str, area: float, centroid, box, **more) -> int:
        """Notes the figures of a face."""
        self.faces.append(FaceFigures(entity, surface, float(area), centroid, box, **more))
        return entity

    def know_pieces(self, entity: int, surface: str, *pieces: Piece, holes=(), **more) -> int:
        """Notes the figures of a face that is these pieces without those holes (which lie within)."""
        signed = [(1.0, piece) for piece in pieces] + [(-1.0, hole) for hole in holes]
        area = sum(sign * piece.area for sign, piece in signed)
        centroid = tuple(
            float(c) for c in sum(sign * piece.area * np.array(piece.centroid) for sign, piece in signed) / area
        )
        return self.know(entity, surface, area, centroid, around(piece.box for piece in pieces), **more)

    def polygon(self, *points, surface: int | None = None, face=None, hidden: bool = False, **options) -> int:
        """A plane face over a polygon: type 144 over type 108, or what `face` makes of surface and boundary."""
        area, normal, centroid = polygon_figures(points)
        surface = surface or self.plane(points[0], normal)
        if hidden:
            options["status"] = BLANKED
        entity = (face or self.trimmed)(surface, self.polyline(*points), **options)
        return self.know(entity, "plane", area, centroid, around([points]), hidden=hidden)

    # The reference

    def reference(self, *, volume: float | None = None, bbox=None, solids=None, scale: float = 1.0, **more) -> dict:
        """The reference; `scale` is the file's unit in millimetres, `bbox` in that unit."""
        shown = [face for face in self.faces if not face.hidden]
        area = sum(face.area * face.instances for face in shown)
        bbox = bbox or (around(face.box for face in shown) if shown else None)
        figures = {
            "area_mm2": area * scale**2,
            "volume_mm3": None if volume is None else volume * scale**3,
            "bbox_mm": None if bbox is None else [[scale * float(c) for c in corner] for corner in bbox],
            "closed": volume is not None,
            "solids": (1 if volume is not None else 0) if solids is None else solids,
            "faces": sum(face.instances for face in shown),
        }
        if shown and all(face.centroid is not None and face.instances == 1 for face in shown):
            figures["area_centroid_mm"] = [
                scale * sum(face.area * face.centroid[k] for face in shown) / area for k in range(3)
            ]
        figures["face_areas_mm2"] = [face.line(scale) for face in self.faces if not face.hidden]
        hidden = [face.line(scale) for face in self.faces if face.hidden]
        if hidden:
            figures["hidden_faces"] = hidden
        figures["colours"] = {"none": area * scale**2}
        return {**figures, **more}

    def _once(self, kind: int, parameters: list, **options) -> int:
        key = (kind, tuple(parameters), tuple(sorted(options.items())))
        if key not in self._cache:
            self._cache[key] = self.add(kind, parameters, **options)
        return self._cache[key]


def around(boxes) -> list:
    """The box around boxes or sets of points."""
    corners = [corner for box in boxes for corner in box]
    return [
        [float(min(c[k] for c in corners)) for k in range(3)],
        [float(max(c[k] for c in corners)) for k in range(3)],
    ]


def box_sides(low, high) -> list[tuple]:
    """The six polygons of a box, outward, in the order low x, high x, low y, high y, low z, high z."""
    (x0, y0, z0), (x1, y1, z1) = low, high
    corner = [(float(x), float(y), float(z)) for x in (x0, x1) for y in (y0, y1) for z in (z0, z1)]
    sides = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return [tuple(corner[k] for k in side) for side in sides]


def moved(rows, point) -> Point:
    """A point under a transformation of three rows of four."""
    return tuple(sum(row[k] * point[k] for k in range(3)) + row[3] for row in rows)


def after(outer, inner) -> tuple:
    """The transformation that does `inner` first."""
    square = [np.vstack([np.array(rows, float), [0.0, 0.0, 0.0, 1.0]]) for rows in (outer, inner)]
    return tuple(tuple(float(v) for v in row) for row in (square[0] @ square[1])[:3])


def shift(x: float, y: float, z: float) -> tuple:
    return ((1.0, 0.0, 0.0, float(x)), (0.0, 1.0, 0.0, float(y)), (0.0, 0.0, 1.0, float(z)))
