"""Curves in the plane as formulas: their exact lengths, the areas beside them, their boxes."""

from __future__ import annotations

from dataclasses import dataclass

from typing import Callable

import numpy as np
from numpy.polynomial import Chebyshev

#: Polynomials of this degree stand for a piece of a curve to sixteen digits.
DEGREE = 40


@dataclass
class Piece:
    """A smooth piece: `at` takes an array of parameters and returns x and y."""

    at: Callable[[np.ndarray], tuple[np.ndarray, np.ndarray]]
    first: float
    last: float

    def _polynomials(self) -> tuple[Chebyshev, Chebyshev]:
        domain = [min(self.first, self.last), max(self.first, self.last)]
        x = Chebyshev.interpolate(lambda t: np.broadcast_to(self.at(t)[0], np.shape(t)) + 0.0 * t, DEGREE, domain)
        y = Chebyshev.interpolate(lambda t: np.broadcast_to(self.at(t)[1], np.shape(t)) + 0.0 * t, DEGREE, domain)
        return x, y

    def quadrature(self, integrand) -> float:
        """The integral of integrand(x, y, x', y') from first to last."""
        x, y = self._polynomials()
        nodes, weights = np.polynomial.legendre.leggauss(60)
        half, middle = (self.last - self.first) / 2, (self.last + self.first) / 2
        t = middle + half * nodes
        return float(half * np.sum(weights * integrand(x(t), y(t), x.deriv()(t), y.deriv()(t))))

    def length(self) -> float:
        return abs(self.quadrature(lambda x, y, dx, dy: np.hypot(dx, dy)))

    def moments(self) -> np.ndarray:
        """What the piece contributes to the area left of a closed outline, and to the area's moments in x and y."""
        return np.array(
            [
                self.quadrature(lambda x, y, dx, dy: (x * dy - y * dx) / 2),
                self.quadrature(lambda x, y, dx, dy: x * x * dy / 2),
                self.quadrature(lambda x, y, dx, dy: -y * y * dx / 2),
            ]
        )

    def length_moments(self) -> np.ndarray:
        """The integrals of x and y along the piece."""
        signs = 1.0 if self.last >= self.first else -1.0
        return signs * np.array(
            [
                self.quadrature(lambda x, y, dx, dy: x * np.hypot(dx, dy)),
                self.quadrature(lambda x, y, dx, dy: y * np.hypot(dx, dy)),
            ]
        )

    def box(self) -> np.ndarray:
        """Rows of lowest and highest x and y."""
        corners = []
        for polynomial in self._polynomials():
            roots = polynomial.deriv().roots()
            low, high = polynomial.domain
            real = [r.real for r in roots if abs(r.imag) < 1e-9 and low < r.real < high]
            values = polynomial(np.array([low, high, *real]))
            corners.append((values.min(), values.max()))
        return np.array(corners).T


def line_piece(a, b) -> Piece:
    """From a to b."""
    return Piece(lambda t: (a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])), 0.0, 1.0)


def ellipse_pieces(centre, a: float, b: float, first: float, last: float) -> list[Piece]:
    """An arc about `centre` with half axes along x and y, in pieces of at most a quarter turn."""
    count = max(1, int(np.ceil(abs(last - first) / (np.pi / 2) - 1e-9)))
    bounds = np.linspace(first, last, count + 1)
    at = lambda t: (centre[0] + a * np.cos(t), centre[1] + b * np.sin(t))  # noqa: E731
    return [Piece(at, float(p), float(q)) for p, q in zip(bounds, bounds[1:])]


def parabola_piece(focal: float, first: float, last: float) -> Piece:
    """ISO 10303-42: f t^2 along x, 2 f t along y."""
    return Piece(lambda t: (focal * t * t, 2 * focal * t), first, last)


def hyperbola_piece(a: float, b: float, first: float, last: float) -> Piece:
    """ISO 10303-42: a cosh t along x, b sinh t along y."""
    return Piece(lambda t: (a * np.cosh(t), b * np.sinh(t)), first, last)


@dataclass
class Spline:
    """A B-spline, rational where weights are given, over its full knot vector."""

    degree: int
    poles: list
    knots: list[float]
    weights: list[float] | None = None

    def domain(self) -> tuple[float, float]:
        return self.knots[self.degree], self.knots[-self.degree - 1]

    def breaks(self) -> list[float]:
        low, high = self.domain()
        return sorted({k for k in self.knots if low <= k <= high})

    def basis(self, t: float) -> np.ndarray:
        """All basis functions at t (Cox and de Boor)."""
        knots, degree, count = self.knots, self.degree, len(self.poles)
        t = min(max(t, self.domain()[0]), self.domain()[1])
        span = max(i for i in range(degree, count) if knots[i] <= t and knots[i] < knots[i + 1])
        values = np.zeros(len(knots) - 1)
        values[span] = 1.0
        for p in range(1, degree + 1):
            lower = values.copy()
            for i in range(len(knots) - 1 - p):
                left = knots[i + p] - knots[i]
                right = knots[i + p + 1] - knots[i + 1]
                values[i] = ((t - knots[i]) / left * lower[i] if left else 0.0) + (
                    (knots[i + p + 1] - t) / right * lower[i + 1] if right else 0.0
                )
        return values[:count]

    def point(self, t: float) -> np.ndarray:
        basis = self.basis(t)
        if self.weights is not None:
            basis = basis * np.array(self.weights)
            basis = basis / basis.sum()
        return basis @ np.array(self.poles, float)

    def pieces(self) -> list[Piece]:
        """One piece per knot span (of the first two coordinates)."""

        def at(t):
            points = np.array([self.point(float(s)) for s in np.ravel(t)])
            return points[:, 0].reshape(np.shape(t)), points[:, 1].reshape(np.shape(t))

        breaks = self.breaks()
        return [Piece(at, a, b) for a, b in zip(breaks, breaks[1:])]


def uniform_knots(poles: int, degree: int) -> list[float]:
    """ISO 10303-42 uniform_curve: -degree, 1 - degree, ... in steps of one; the domain starts at 0."""
    return [float(k - degree) for k in range(poles + degree + 1)]


def quasi_uniform_knots(poles: int, degree: int) -> list[float]:
    """Steps of one, full multiplicity at both ends."""
    return [0.0] * degree + [float(k) for k in range(poles - degree + 1)] + [float(poles - degree)] * degree


def bezier_knots(poles: int, degree: int) -> list[float]:
    """Piecewise Bézier: every inner knot as often as the degree."""
    spans = (poles - 1) // degree
    assert spans * degree + 1 == poles
    return [0.0] + [float(k) for k in range(spans + 1) for _ in range(degree)] + [float(spans)]
