"""Integrals over a face's exact surface, by Green's theorem along its boundary in the parameters.

OpenCASCADE's own integrals are wrong in the third digit on some spline faces, and on planes with spline edges. Here, with
`G(u, v)` the integrand times the surface element, the integral over the face is the boundary integral of
`(integral of G from the surface's first u to u) dv`. Both are Gauss quadratures between the knots, refined until they
agree to eleven digits.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from math import pi

import cadquery as cq
import numpy as np
from OCP.BRep import BRep_Tool
from OCP.BRepAdaptor import BRepAdaptor_Surface
from OCP.Geom2dAdaptor import Geom2dAdaptor_Curve
from OCP.GeomAbs import GeomAbs_CN, GeomAbs_Plane
from OCP.gp import gp_Pnt, gp_Pnt2d, gp_Vec, gp_Vec2d
from OCP.TColStd import TColStd_Array1OfReal
from OCP.TopAbs import TopAbs_EDGE, TopAbs_FORWARD, TopAbs_REVERSED
from OCP.TopExp import TopExp_Explorer
from OCP.TopLoc import TopLoc_Location
from OCP.TopoDS import TopoDS, TopoDS_Shape
from scipy.integrate import quad_vec

#: Gauss points per knot span across the surface.
NODES, WEIGHTS = np.polynomial.legendre.leggauss(16)
#: Spans of surfaces that turn are no longer than this, so that sixteen points suffice.
LONGEST_SPAN = pi / 2


#: Error allowed, as a part of what the boundary contributes in all.
PRECISION = 1e-11


@dataclass
class FaceIntegrals:
    """What is known of a face."""

    area_mm2: float
    centroid_mm: list[float]
    #: Flux of (x, y, z) / 3 through the face along its own normal: the volumes of a solid are their sums.
    flux_mm3: float


class _Strip:
    """The integrals over u from the surface's first u on, at a given v."""

    def __init__(self, surface: BRepAdaptor_Surface):
        self.surface = surface
        self.flat = surface.GetType() == GeomAbs_Plane
        self.first = surface.FirstUParameter()
        knots = TColStd_Array1OfReal(1, surface.NbUIntervals(GeomAbs_CN) + 1)
        surface.UIntervals(knots, GeomAbs_CN)
        self.knots = [knots.Value(i) for i in range(1, knots.Length() + 1)]
        self.point, self.du, self.dv = gp_Pnt(), gp_Vec(), gp_Vec()

    def density(self, u: float, v: float) -> np.ndarray:
        """Area, its moments, and flux per unit of u and v."""
        self.surface.D1(u, v, self.point, self.du, self.dv)
        normal = self.du.Crossed(self.dv)
        area = normal.Magnitude()
        x, y, z = self.point.X(), self.point.Y(), self.point.Z()
        flux = (x * normal.X() + y * normal.Y() + z * normal.Z()) / 3
        return np.array((area, x * area, y * area, z * area, flux))

    def upto(self, u: float, v: float) -> np.ndarray:
        """The integral of the density from the first u to `u` at `v`."""
        if self.flat:
            middle = self.density((self.first + u) / 2, v)
            return middle * (u - self.first)  # The density of a plane is linear in u.
        total = np.zeros(5)
        low, sign = (self.first, 1.0) if u >= self.first else (u, -1.0)
        high = max(u, self.first)
        inner = [knot for knot in self.knots if low < knot < high]
        for start, end in zip([low, *inner], [*inner, high]):
            pieces = max(1, int(np.ceil((end - start) / LONGEST_SPAN))) if self.turns() else 1
            bounds = np.linspace(start, end, pieces + 1)
            for a, b in zip(bounds, bounds[1:]):
                half = (b - a) / 2
                for node, weight in zip(NODES, WEIGHTS):
                    total += weight * half * self.density(a + half * (node + 1), v)
        return sign * total

    def turns(self) -> bool:
        """Whether u is an angle, or the surface is not made of polynomials."""
        return self.surface.GetType().name not in ("GeomAbs_BSplineSurface", "GeomAbs_BezierSurface")


def integrate(face: TopoDS_Shape) -> FaceIntegrals:
    """Area, centroid and flux of a face; the flux follows the face's orientation."""
    return _integrate(cq.Face(face))


@lru_cache(maxsize=None)
def _integrate(key: cq.Face) -> FaceIntegrals:
    face = TopoDS.Face_s(key.wrapped)
    if BRep_Tool.Surface_s(face) is None:
        return _over_triangles(face)
    forward = TopoDS.Face_s(face.Oriented(TopAbs_FORWARD))
    strip = _Strip(BRepAdaptor_Surface(forward, True))
    v_knots = TColStd_Array1OfReal(1, strip.surface.NbVIntervals(GeomAbs_CN) + 1)
    strip.surface.VIntervals(v_knots, GeomAbs_CN)
    breaks = [v_knots.Value(i) for i in range(1, v_knots.Length() + 1)]
    runs = [run for edge in _edges(forward) for run in _runs(edge, forward, strip, breaks)]
    # Parts of the boundary may contribute nothing: what is precise enough is measured against the whole.
    scale = sum(
        abs(b - a) * abs(speed(a + (b - a) * t)[0]) / 4 for speed, a, b, _ in runs for t in (0.1, 0.4, 0.6, 0.9)
    )
    total = np.zeros(5)
    for speed, a, b, sign in runs:
        value, _ = quad_vec(speed, a, b, epsabs=PRECISION * scale, epsrel=0.0, norm=_leading, limit=60)
        total += sign * value
    area = total[0]
    flux = total[4] * (-1.0 if face.Orientation() == TopAbs_REVERSED else 1.0)
    if area < 0:  # The boundary runs the wrong way round: the face is the inside all the same.
        area, flux, total = -area, -flux, -total
    centroid = total[1:4] / area if area else np.zeros(3)
    return FaceIntegrals(float(area), [float(c) for c in centroid], float(flux))


def _over_triangles(face) -> FaceIntegrals:
    """A face that is nothing but triangles (AP242)."""
    location = TopLoc_Location()
    mesh = BRep_Tool.Triangulation_s(face, location)
    total = np.zeros(5)
    sign = -1.0 if face.Orientation() == TopAbs_REVERSED else 1.0
    for k in range(1, mesh.NbTriangles() + 1):
        corners = [mesh.Node(i).Transformed(location.Transformation()) for i in mesh.Triangle(k).Get()]
        a, b, c = (np.array((p.X(), p.Y(), p.Z())) for p in corners)
        normal = np.cross(b - a, c - a) / 2
        area, centre = np.linalg.norm(normal), (a + b + c) / 3
        total += np.array((area, *(area * centre), sign * float(normal @ a) / 3))
    centroid = total[1:4] / total[0] if total[0] else np.zeros(3)
    return FaceIntegrals(float(total[0]), [float(c) for c in centroid], float(total[4]))


def _edges(face) -> list:
    """Every use of an edge by the face; a seam is used twice."""
    found, explorer = [], TopExp_Explorer(face, TopAbs_EDGE)
    while explorer.More():
        found.append(TopoDS.Edge_s(explorer.Current()))
        explorer.Next()
    return found


def _runs(edge, face, strip: _Strip, v_breaks: list[float]) -> list[tuple]:
    """The smooth parts of an edge: integrand, first and last parameter, and sign."""
    curve = BRep_Tool.CurveOnSurface_s(edge, face, 0.0, 0.0)
    if curve is None:
        return []
    first, last = BRep_Tool.Range_s(edge, face)
    adaptor = Geom2dAdaptor_Curve(curve, first, last)
    knots = TColStd_Array1OfReal(1, adaptor.NbIntervals(GeomAbs_CN) + 1)
    adaptor.Intervals(knots, GeomAbs_CN)
    points = [knots.Value(i) for i in range(1, knots.Length() + 1)]
    uv, tangent = gp_Pnt2d(), gp_Vec2d()

    def speed(t: float) -> np.ndarray:
        adaptor.D1(t, uv, tangent)
        if abs(tangent.Y()) < 1e-14:
            return np.zeros(5)
        return strip.upto(uv.X(), uv.Y()) * tangent.Y()

    sign = -1.0 if edge.Orientation() == TopAbs_REVERSED else 1.0
    found = []
    for start, end in zip(points, points[1:]):
        crossings = _crossings(adaptor, start, end, v_breaks) + _crossings(adaptor, start, end, strip.knots, 0)
        cuts = sorted({start, *crossings, end})
        found += [(speed, a, b, sign) for a, b in zip(cuts, cuts[1:])]
    return found


def _leading(integrals: np.ndarray) -> float:
    """What decides convergence: the area, so that moments about a far origin do not."""
    return abs(float(np.ravel(integrals)[0]))


def _crossings(adaptor, start: float, end: float, breaks: list[float], axis: int = 1) -> list[float]:
    """Where a curve crosses the surface's knots: the integrand has kinks there."""
    coordinate = lambda t: adaptor.Value(t).Y() if axis else adaptor.Value(t).X()  # noqa: E731
    found = []
    samples = np.linspace(start, end, 65)
    values = [coordinate(float(t)) for t in samples]
    for knot in breaks:
        for (a, fa), (b, fb) in zip(zip(samples, values), zip(samples[1:], values[1:])):
            if (fa - knot) * (fb - knot) < 0:
                found.append(_bisect(coordinate, knot, float(a), float(b)))
    return found


def _bisect(coordinate, knot: float, a: float, b: float) -> float:
    rising = coordinate(b) > coordinate(a)
    for _ in range(60):
        middle = (a + b) / 2
        if (coordinate(middle) > knot) == rising:
            b = middle
        else:
            a = middle
    return (a + b) / 2
