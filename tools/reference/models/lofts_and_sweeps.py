"""Lofts, sweeps along curves, helices."""

from math import pi

import cadquery as cq

from catalogue import fixture


@fixture("loft_circle_to_square", "a ruled loft: the surface changes from round to straight")
def loft_circle_to_square():
    return cq.Workplane().rect(20, 20).workplane(offset=25).circle(6).loft(combine=True)


@fixture("loft_smooth", "a smooth loft through five sections: B-splines of high degree")
def loft_smooth():
    wires = [
        cq.Workplane("XY", origin=(0, 0, z)).ellipse(a, b).wires().vals()[0]
        for z, a, b in [(0, 10, 6), (8, 7, 9), (16, 12, 5), (24, 6, 6), (32, 9, 4)]
    ]
    return cq.Solid.makeLoft(wires, False)


@fixture("loft_to_point", "a loft that ends in a point")
def loft_to_point():
    return cq.Solid.makeLoft(
        [
            cq.Workplane("XY", origin=(0, 0, 0)).rect(20, 12).wires().val(),
            cq.Workplane("XY", origin=(0, 0, 20)).rect(2, 1).wires().val(),
        ],
        True,
    )


@fixture("loft_airfoil", "a wing: a loft over two spline profiles with a sharp trailing edge")
def loft_airfoil():
    def section(y: float, chord: float, twist: float):
        upper = [(1, 0), (0.7, 0.05), (0.3, 0.09), (0.05, 0.05), (0, 0)]
        lower = [(0, 0), (0.05, -0.03), (0.3, -0.04), (0.7, -0.02), (1, 0)]
        points = [(chord * x, chord * z) for x, z in upper]
        back = [(chord * x, chord * z) for x, z in lower]
        plane = cq.Plane((0, y, 0), (1, 0, 0), (0, -1, 0)).rotated((0, 0, twist))
        return cq.Workplane(plane).spline(points).spline(back, includeCurrent=False).close().wires().val()

    return cq.Solid.makeLoft([section(0, 40, 0), section(30, 32, 3), section(80, 18, 7)], False)


@fixture("sweep_along_spline", "a circle swept along a spline")
def sweep_along_spline():
    path = cq.Workplane("XZ").spline([(0, 0), (10, 15), (-5, 30), (8, 45)])
    return cq.Workplane("XY").circle(3).sweep(path, transition="round")


@fixture("sweep_square_along_arc", "a square swept along an arc")
def sweep_square_along_arc():
    path = cq.Workplane("XZ").moveTo(0, 0).threePointArc((20 * (1 - 0.70710678), 14.1421356), (20, 20))
    return cq.Workplane("XY").rect(6, 4).sweep(path)


@fixture("sweep_round_corners", "a pipe with bends: cylinders and tori")
def sweep_round_corners():
    path = cq.Workplane("XZ").lineTo(0, 20).radiusArc((8, 28), 8).lineTo(30, 28).radiusArc((38, 20), 8).lineTo(38, 0)
    return cq.Workplane("XY").circle(4).circle(3).sweep(path)


@fixture("spring", "a circle swept along a helix of three turns", deflection=0.01, angular=1.0)
def spring():
    helix = cq.Wire.makeHelix(pitch=6, height=18, radius=8)
    return cq.Workplane("XZ").center(8, 0).circle(1.2).sweep(cq.Workplane(helix), isFrenet=True)


@fixture("spring_conical", "a square swept along a conical helix", angular=0.6)
def spring_conical():
    helix = cq.Wire.makeHelix(pitch=5, height=15, radius=9, angle=15)
    return cq.Workplane("XZ").center(9, 0).rect(1.6, 1.6).sweep(cq.Workplane(helix), isFrenet=True)


@fixture("thread", "a helical thread on a core: helicoids between two helices", angular=0.6)
def thread():
    helix = cq.Wire.makeHelix(pitch=3, height=9, radius=5)
    tooth = (
        cq.Workplane("XZ")
        .polyline([(4.9, -1.0), (6.2, -0.3), (6.2, 0.3), (4.9, 1.0)])
        .close()
        .sweep(cq.Workplane(helix), isFrenet=True)
    )
    core = cq.Workplane().circle(5).extrude(15).translate((0, 0, -3))
    return core.union(tooth)


@fixture("twisted_bar", "a square twisted by 120 degrees while it is extruded")
def twisted_bar():
    return cq.Workplane().rect(10, 6).twistExtrude(30, 120)


@fixture("tapered_prism", "an extrusion with draft")
def tapered_prism():
    return cq.Workplane().rect(20, 14).extrude(10, taper=8)


@fixture(
    "bent_rod",
    "a quarter of a torus between two cylinders",
    closed_form={"volume_mm3": pi * 9 * (20 + 10 + 12 * pi / 2)},
)
def bent_rod():
    path = cq.Workplane("XZ").lineTo(0, 20).radiusArc((12, 32), 12).lineTo(22, 32)
    return cq.Workplane("XY").circle(3).sweep(path)
