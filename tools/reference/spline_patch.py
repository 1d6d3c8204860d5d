"""B-spline surfaces as formulas, and as sheets bounded by their four sides."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from part21 import FALSE, UNKNOWN, Enum, Ref
from plane_curves import Spline
from step_model import StepModel

UNSPECIFIED = Enum("UNSPECIFIED")


@dataclass
class Patch:
    """A tensor product; `poles[i][j]`: i along u, j along v."""

    u_degree: int
    v_degree: int
    poles: np.ndarray
    u_knots: list[float]
    v_knots: list[float]
    weights: np.ndarray | None = None

    def __post_init__(self) -> None:
        self.poles = np.array(self.poles, float)
        weights = np.ones(self.poles.shape[:2]) if self.weights is None else np.array(self.weights, float)
        self._homogeneous = np.concatenate([self.poles * weights[..., None], weights[..., None]], axis=2)
        self._u = Spline(self.u_degree, list(range(self.poles.shape[0])), self.u_knots)
        self._v = Spline(self.v_degree, list(range(self.poles.shape[1])), self.v_knots)

    def domain(self) -> tuple[tuple[float, float], tuple[float, float]]:
        return self._u.domain(), self._v.domain()

    def points(self, us, vs) -> np.ndarray:
        """A grid of points, rows along u."""
        bu = np.array([self._u.basis(float(u)) for u in us])
        bv = np.array([self._v.basis(float(v)) for v in vs])
        flat = np.einsum("ai,bj,ijk->abk", bu, bv, self._homogeneous)
        return flat[..., :3] / flat[..., 3:]

    def _derivative_basis(self, spline: Spline, ts) -> np.ndarray:
        """First derivatives of the basis: degree / knot difference times the basis one degree lower."""
        lower = Spline(spline.degree - 1, list(range(len(spline.poles) + 1)), spline.knots)
        count, p, k = len(spline.poles), spline.degree, spline.knots
        rows = []
        for t in ts:
            b = basis_over(lower, float(t))
            row = np.zeros(count)
            for i in range(count):
                left, right = k[i + p] - k[i], k[i + p + 1] - k[i + 1]
                row[i] = p * ((b[i] / left if left else 0.0) - (b[i + 1] / right if right else 0.0))
            rows.append(row)
        return np.array(rows)

    def normals(self, us, vs) -> np.ndarray:
        """Cross products of the first derivatives, a grid like `points`."""
        bu = np.array([self._u.basis(float(u)) for u in us])
        bv = np.array([self._v.basis(float(v)) for v in vs])
        du, dv = self._derivative_basis(self._u, us), self._derivative_basis(self._v, vs)
        h = np.einsum("ai,bj,ijk->abk", bu, bv, self._homogeneous)
        hu = np.einsum("ai,bj,ijk->abk", du, bv, self._homogeneous)
        hv = np.einsum("ai,bj,ijk->abk", bu, dv, self._homogeneous)
        p = h[..., :3] / h[..., 3:]
        su = (hu[..., :3] - p * hu[..., 3:]) / h[..., 3:]
        sv = (hv[..., :3] - p * hv[..., 3:]) / h[..., 3:]
        return np.cross(su, sv)

    def figures(self, offset: float = 0.0) -> tuple[float, tuple[float, float, float]]:
        """Area and centroid, by Gauss quadrature per span; of the parallel surface where `offset` is given."""
        if offset:
            return self._offset_figures(offset)
        area, moment = 0.0, np.zeros(3)
        for us, wu in spans(self._u.breaks()):
            for vs, wv in spans(self._v.breaks()):
                element = np.linalg.norm(self.normals(us, vs), axis=2) * np.outer(wu, wv)
                area += element.sum()
                moment += np.einsum("ab,abk->k", element, self.points(us, vs))
        return float(area), tuple(float(c) for c in moment / area)

    def _offset_figures(self, offset: float) -> tuple[float, tuple[float, float, float]]:
        """The parallel surface's element: differentiate the offset points on a Chebyshev grid of each span."""
        area, moment = 0.0, np.zeros(3)
        for us, wu in spans(self._u.breaks(), 40):
            for vs, wv in spans(self._v.breaks(), 40):
                normal = self.normals(us, vs)
                normal /= np.linalg.norm(normal, axis=2)[..., None]
                points = self.points(us, vs) + offset * normal
                su = np.einsum("ca,abk->cbk", differentiation(us), points)
                sv = np.einsum("cb,abk->ack", differentiation(vs), points)
                element = np.linalg.norm(np.cross(su, sv), axis=2) * np.outer(wu, wv)
                area += element.sum()
                moment += np.einsum("ab,abk->k", element, points)
        return float(area), tuple(float(c) for c in moment / area)

    def box(self, offset: float = 0.0) -> list[list[float]]:
        """The box, from a fine grid refined about its extremes (good to 1e-6 of the size)."""
        (u0, u1), (v0, v1) = self.domain()
        low, high = [], []
        for axis in range(3):
            for sign, found in ((1, low), (-1, high)):
                found.append(sign * self._lowest(axis, sign, u0, u1, v0, v1, offset))
        return [low, high]

    def _lowest(self, axis, sign, u0, u1, v0, v1, offset) -> float:
        best = np.inf
        bounds = (u0, u1, v0, v1)
        for _ in range(12):
            us, vs = np.linspace(u0, u1, 41), np.linspace(v0, v1, 41)
            points = self.points(us, vs)
            if offset:
                normal = self.normals(us, vs)
                points = points + offset * normal / np.linalg.norm(normal, axis=2)[..., None]
            values = sign * points[..., axis]
            i, j = np.unravel_index(np.argmin(values), values.shape)
            best = min(best, float(values[i, j]))
            wu, wv = (u1 - u0) / 8, (v1 - v0) / 8
            u0, u1 = max(bounds[0], us[i] - wu), min(bounds[1], us[i] + wu)
            v0, v1 = max(bounds[2], vs[j] - wv), min(bounds[3], vs[j] + wv)
        return best

    def side(self, which: str) -> Spline:
        """A side as a rational spline: u0, u1 (along v) or v0, v1 (along u)."""
        along_u = which[0] == "v"
        (u0, u1), (v0, v1) = self.domain()
        t = {"u0": u0, "u1": u1, "v0": v0, "v1": v1}[which]
        rows = self._homogeneous if along_u else self._homogeneous.transpose(1, 0, 2)
        across = (self._v if along_u else self._u).basis(t)
        flat = np.einsum("j,ijk->ik", across, rows)
        degree, knots = (self.u_degree, self.u_knots) if along_u else (self.v_degree, self.v_knots)
        weights = None if self.weights is None else [float(w) for w in flat[:, 3]]
        return Spline(degree, [tuple(map(float, p[:3] / p[3])) for p in flat], knots, weights)


def basis_over(spline: Spline, t: float) -> np.ndarray:
    """The basis of one degree lower over the same knots, in the original domain."""
    knots, degree = spline.knots, spline.degree
    count = len(knots) - degree - 1
    inner = [i for i in range(degree, len(knots) - 1) if knots[i] <= t < knots[i + 1]]
    span = inner[-1] if inner else max(i for i in range(len(knots) - 1) if knots[i] < knots[i + 1])
    values = np.zeros(len(knots) - 1)
    values[span] = 1.0
    for p in range(1, degree + 1):
        lower = values.copy()
        for i in range(len(knots) - 1 - p):
            left, right = knots[i + p] - knots[i], knots[i + p + 1] - knots[i + 1]
            values[i] = ((t - knots[i]) / left * lower[i] if left else 0.0) + (
                (knots[i + p + 1] - t) / right * lower[i + 1] if right else 0.0
            )
    return values[:count]


def spans(breaks, order: int = 24):
    """Gauss nodes and weights over each knot span."""
    nodes, weights = np.polynomial.legendre.leggauss(order)
    return [((a + b) / 2 + (b - a) / 2 * nodes, (b - a) / 2 * weights) for a, b in zip(breaks, breaks[1:])]


def differentiation(t: np.ndarray) -> np.ndarray:
    """Matrix that differentiates the interpolating polynomial at its own nodes (barycentric form)."""
    gap = t[:, None] - t[None, :]
    np.fill_diagonal(gap, 1.0)
    scale = np.prod(gap / np.abs(t[-1] - t[0]) * 4, axis=1)
    matrix = (scale[:, None] / scale[None, :]) / gap
    np.fill_diagonal(matrix, 0.0)
    np.fill_diagonal(matrix, -matrix.sum(axis=1))
    return matrix


def counted(knots) -> tuple[list[int], list[float]]:
    """Multiplicities and distinct values of a full knot vector."""
    values = sorted(set(knots))
    return [knots.count(value) for value in values], values


def write_curve(model: StepModel, spline: Spline, form: str = "WITH_KNOTS") -> Ref:
    """A B-spline curve in space: WITH_KNOTS, or the name of a subtype that implies its knots."""
    poles = [model.point(p) for p in spline.poles]
    counts, values = counted(spline.knots)
    base = (spline.degree, poles, UNSPECIFIED, FALSE, UNKNOWN)
    if spline.weights is None:
        if form == "WITH_KNOTS":
            return model.add("B_SPLINE_CURVE_WITH_KNOTS", "", *base, counts, values, UNSPECIFIED)
        return model.add(form, "", *base)
    parts: dict = {
        "BOUNDED_CURVE": (),
        "B_SPLINE_CURVE": base,
        "CURVE": (),
        "GEOMETRIC_REPRESENTATION_ITEM": (),
        "RATIONAL_B_SPLINE_CURVE": (spline.weights,),
        "REPRESENTATION_ITEM": ("",),
    }
    if form == "WITH_KNOTS":
        parts["B_SPLINE_CURVE_WITH_KNOTS"] = (counts, values, UNSPECIFIED)
    else:
        parts[form] = ()
    return model.add_complex(**dict(sorted(parts.items())))


def write_surface(model: StepModel, patch: Patch, form: str = "WITH_KNOTS") -> Ref:
    """A B-spline surface: WITH_KNOTS, or the name of a subtype that implies its knots."""
    poles = [[model.point(tuple(map(float, p))) for p in row] for row in patch.poles]
    (u_counts, u_values), (v_counts, v_values) = counted(patch.u_knots), counted(patch.v_knots)
    base = (patch.u_degree, patch.v_degree, poles, UNSPECIFIED, FALSE, FALSE, UNKNOWN)
    knots = (u_counts, v_counts, u_values, v_values, UNSPECIFIED)
    if patch.weights is None:
        if form == "WITH_KNOTS":
            return model.add("B_SPLINE_SURFACE_WITH_KNOTS", "", *base, *knots)
        return model.add(form, "", *base)
    parts: dict = {
        "BOUNDED_SURFACE": (),
        "B_SPLINE_SURFACE": base,
        "GEOMETRIC_REPRESENTATION_ITEM": (),
        "RATIONAL_B_SPLINE_SURFACE": ([list(map(float, row)) for row in np.array(patch.weights)],),
        "REPRESENTATION_ITEM": ("",),
        "SURFACE": (),
    }
    if form == "WITH_KNOTS":
        parts["B_SPLINE_SURFACE_WITH_KNOTS"] = knots
    else:
        parts[form] = ()
    return model.add_complex(**dict(sorted(parts.items())))


def sides_loop(model: StepModel, patch: Patch) -> Ref:
    """The loop round the whole patch, counter-clockwise about its normal, over B-spline edges."""
    uses = []
    for which, forward in (("v0", True), ("u1", True), ("v1", False), ("u0", False)):
        spline = patch.side(which)
        low, high = spline.domain()
        start, end = (tuple(map(float, spline.point(t))) for t in (low, high))
        uses.append((model.edge(rounded(start), rounded(end), write_curve(model, spline)), forward))
    return model.loop(*uses)


def rounded(point) -> tuple[float, ...]:
    """A point whose last digits do not depend on the way it was computed, so that corners coincide."""
    return tuple(round(c, 12) + 0.0 for c in point)
