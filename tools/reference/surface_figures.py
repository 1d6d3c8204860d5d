"""Surfaces as formulas: exact areas, centroids, boxes and fluxes, by Gauss quadrature."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Callable

import numpy as np

from spline_patch import differentiation, spans

#: Gauss points per span and direction.
ORDER = 40


@dataclass
class Piece:
    """`at` takes arrays u and v of one shape and returns points of that shape and three, smooth between breaks."""

    at: Callable[[np.ndarray, np.ndarray], np.ndarray]
    u_breaks: tuple
    v_breaks: tuple

    @cached_property
    def _integrals(self) -> np.ndarray:
        """Area, its moments and the flux of (x, y, z) / 3 along du x dv."""
        total = np.zeros(5)
        for us, wu in spans(self.u_breaks, ORDER):
            for vs, wv in spans(self.v_breaks, ORDER):
                points = self.grid(us, vs)
                su = np.einsum("ca,abk->cbk", differentiation(us), points)
                sv = np.einsum("cb,abk->ack", differentiation(vs), points)
                normal = np.cross(su, sv)
                weight = np.outer(wu, wv)
                element = np.linalg.norm(normal, axis=2) * weight
                flux = np.einsum("abk,abk->ab", points, normal) * weight / 3
                total += np.array([element.sum(), *np.einsum("ab,abk->k", element, points), flux.sum()])
        return total

    def grid(self, us, vs) -> np.ndarray:
        u, v = np.meshgrid(us, vs, indexing="ij")
        return self.at(u, v)

    @property
    def area(self) -> float:
        return float(self._integrals[0])

    @property
    def centroid(self) -> tuple:
        return tuple(float(c) for c in self._integrals[1:4] / self._integrals[0])

    @property
    def flux(self) -> float:
        return float(self._integrals[4])

    @cached_property
    def box(self) -> list:
        """From a fine grid refined about its extremes."""
        return [[s * self._lowest(axis, s) for axis in range(3)] for s in (1, -1)]

    def _lowest(self, axis: int, sign: int) -> float:
        bounds = (self.u_breaks[0], self.u_breaks[-1], self.v_breaks[0], self.v_breaks[-1])
        u0, u1, v0, v1 = bounds
        best = np.inf
        for _ in range(14):
            us, vs = np.linspace(u0, u1, 61), np.linspace(v0, v1, 61)
            values = sign * self.grid(us, vs)[..., axis]
            i, j = np.unravel_index(np.argmin(values), values.shape)
            best = min(best, float(values[i, j]))
            wu, wv = (u1 - u0) / 12, (v1 - v0) / 12
            u0, u1 = max(bounds[0], us[i] - wu), min(bounds[1], us[i] + wu)
            v0, v1 = max(bounds[2], vs[j] - wv), min(bounds[3], vs[j] + wv)
        return best


def stacked(x, y, z) -> np.ndarray:
    """Points from coordinates, each an array or a number."""
    return np.stack(np.broadcast_arrays(x, y, z), axis=-1).astype(float)


def quarters(first: float, last: float) -> tuple:
    """Breaks at most a quarter turn apart."""
    count = max(1, int(np.ceil(abs(last - first) / (np.pi / 2) - 1e-9)))
    return tuple(np.linspace(first, last, count + 1))


def frame(axis, x) -> np.ndarray:
    """Columns x, y and z of a frame about an axis."""
    z = np.array(axis, float) / np.linalg.norm(axis)
    x = np.array(x, float) - np.dot(x, z) * z
    x = x / np.linalg.norm(x)
    return np.column_stack([x, np.cross(z, x), z])


def revolved(profile, t_breaks, first: float, last: float, origin=(0.0, 0.0, 0.0), axis=(0.0, 0.0, 1.0), x=None):
    """A profile (radius, height) of t, turned about an axis; u is t, v the angle from `x`."""
    axes = frame(axis, (1.0, 0.0, 0.0) if x is None else x)

    def at(t, angle):
        radius, height = profile(t)
        local = stacked(radius * np.cos(angle), radius * np.sin(angle), height)
        return np.array(origin) + local @ axes.T

    return Piece(at, tuple(t_breaks), quarters(first, last))


def extruded(curve, t_breaks, direction) -> Piece:
    """A curve t -> (x, y, z) along a vector."""
    d = np.array(direction, float)
    return Piece(lambda t, s: stacked(*curve(t)) + s[..., None] * d, tuple(t_breaks), (0.0, 1.0))


def disk(surface, centre, a: float, b: float) -> Piece:
    """What an ellipse in a surface's parameters (half axes a and b) encloses on it."""
    return Piece(
        lambda r, angle: surface(centre[0] + a * r * np.cos(angle), centre[1] + b * r * np.sin(angle)),
        (0.0, 1.0),
        quarters(0.0, 2 * np.pi),
    )


def of_spline(spline) -> Callable:
    """A spline's x, y and z over arrays of t."""

    def curve(t):
        points = np.array([(*spline.point(float(s)), 0.0)[:3] for s in np.ravel(t)])
        return tuple(points[:, k].reshape(np.shape(t)) for k in range(3))

    return curve


def of_patch(patch) -> Piece:
    """A B-spline surface over its domain; `at` takes grids only."""
    return Piece(patch_at(patch), tuple(patch._u.breaks()), tuple(patch._v.breaks()))


def patch_at(patch) -> Callable:
    """A B-spline surface at arrays of u and v."""

    def at(u, v):
        if u.ndim == 2 and np.all(u == u[:, :1]) and np.all(v == v[:1, :]):
            return patch.points(u[:, 0], v[0, :])
        found = [patch.points([a], [b])[0, 0] for a, b in zip(np.ravel(u), np.ravel(v))]
        return np.array(found).reshape((*np.shape(u), 3))

    return at


def placed(piece: Piece, rows) -> Piece:
    """A piece under a transformation of three rows of four."""
    matrix, shift = np.array(rows, float)[:, :3], np.array(rows, float)[:, 3]
    return Piece(lambda u, v: piece.at(u, v) @ matrix.T + shift, piece.u_breaks, piece.v_breaks)


def flat_polygon(points) -> list[Piece]:
    """A plane polygon that is convex, as triangles."""
    corners = [np.array(p, float) for p in points]
    fans = []
    for b, c in zip(corners[1:], corners[2:]):
        at = lambda u, v, a=corners[0], b=b, c=c: a + u[..., None] * ((b - a) + v[..., None] * (c - b))  # noqa: E731
        fans.append(Piece(at, (0.0, 1.0), (0.0, 1.0)))
    return fans
