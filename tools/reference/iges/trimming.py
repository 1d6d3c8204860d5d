"""Trimmed and bounded surfaces: boundaries in space, in parameters or both, and which of them counts."""

from __future__ import annotations

from math import cos, pi, sin

import numpy as np

from iges.catalogue import iges
from iges.curves import circle_spline
from iges.surfaces import hill, tube_patch
from iges_deck import IN_PARAMETERS, PART
from iges_model import Boundary, IgesModel
from plane_curves import Spline
from spline_patch import Patch
from surface_figures import Piece, patch_at, quarters, stacked

#: A flat B-spline surface of 40 by 20 whose parameters run from 0 to 1, and a rectangle and circles on it.
WIDTH, DEPTH = 40.0, 20.0
RIM = ((0.1, 0.2), (0.9, 0.2), (0.9, 0.8), (0.1, 0.8))


def ground(model: IgesModel) -> int:
    return model.bilinear((0.0, 0.0, 0.0), (WIDTH, 0.0, 0.0), (0.0, DEPTH, 0.0), status=PART)


def lifted(points) -> list[tuple]:
    return [(WIDTH * u, DEPTH * v, 0.0) for u, v in points]


def flat_piece(u0: float = 0.1, u1: float = 0.9, v0: float = 0.2, v1: float = 0.8) -> Piece:
    return Piece(lambda u, v: stacked(WIDTH * u, DEPTH * v, 0 * u), (u0, u1), (v0, v1))


def sheet(name: str, boundary):
    """The rectangle on the flat surface, bounded as `boundary` says."""
    model = IgesModel(name)
    face = model.trimmed(ground(model), boundary(model))
    model.know_pieces(face, "bspline", flat_piece())
    return model, model.reference()


@iges("trim_model_curve_only", "a boundary without any curve in parameters (BPTR 0)")
def model_only():
    return sheet("trim_model_curve_only", lambda model: Boundary(model.polyline(*lifted(RIM)), 0, 2))


@iges("trim_model_curve_only_no_preference", "a boundary without any curve in parameters, its preference unspecified")
def model_only_unspecified():
    return sheet("trim_model_curve_only_no_preference", lambda model: Boundary(model.polyline(*lifted(RIM)), 0, 0))


@iges("trim_parameter_curve_only", "a boundary that is only a curve in parameters (CPTR 0)")
def parameters_only():
    return sheet("trim_parameter_curve_only", lambda model: Boundary(0, model.polyline_2d(*RIM), 1))


for _preference in (0, 1, 2, 3):

    @iges(f"trim_both_preference_{_preference}", f"a boundary in space and in parameters, preference {_preference}")
    def both(preference=_preference):
        return sheet(
            f"trim_both_preference_{preference}",
            lambda model: Boundary(model.polyline(*lifted(RIM)), model.polyline_2d(*RIM), preference),
        )


WRONG = ((0.3, 0.3), (0.7, 0.3), (0.7, 0.5), (0.3, 0.5))


@iges(
    "trim_parameter_curve_wrong", "the curve in parameters is another rectangle, and the one in space is preferred (2)"
)
def wrong_parameters():
    return sheet(
        "trim_parameter_curve_wrong",
        lambda model: Boundary(model.polyline(*lifted(RIM)), model.polyline_2d(*WRONG), 2),
    )


@iges("trim_model_curve_wrong", "the curve in space is another rectangle, and the one in parameters is preferred (1)")
def wrong_model():
    return sheet(
        "trim_model_curve_wrong",
        lambda model: Boundary(model.polyline(*lifted(WRONG)), model.polyline_2d(*RIM), 1),
    )


@iges(
    "trim_parameter_curve_of_another_range",
    "curves in parameters scaled to another range than the surface's; space is preferred",
)
def other_range():
    far = [(100 * u, 7 + v) for u, v in RIM]
    return sheet(
        "trim_parameter_curve_of_another_range",
        lambda model: Boundary(model.polyline(*lifted(RIM)), model.polyline_2d(*far), 2),
    )


def circles(model: IgesModel, centres, radius: float) -> list[int]:
    return [model.circle(centre, radius) for centre in centres]


def round_hole(centre, radius: float) -> Piece:
    return Piece(
        lambda r, a: stacked(centre[0] + r * np.cos(a), centre[1] + r * np.sin(a), 0 * r),
        (0.0, radius),
        quarters(0.0, 2 * pi),
    )


HOLES = [(8.0, 8.0), (16.0, 12.0), (28.0, 9.0)]


@iges("trim_inner_only", "no outer boundary (N1 = 0): the surface's own sides, and three holes")
def inner_only():
    model = IgesModel("trim_inner_only")
    face = model.trimmed(ground(model), None, circles(model, HOLES, 3.0))
    holes = [round_hole(centre, 3.0) for centre in HOLES]
    model.know_pieces(face, "bspline", flat_piece(0.0, 1.0, 0.0, 1.0), holes=holes)
    return model, model.reference()


@iges(
    "trim_outer_without_curves",
    "an outer boundary of no curves (CPTR and BPTR 0), beside an inner one that runs round the face, as OpenCASCADE writes",
)
def outer_without_curves():
    model = IgesModel("trim_outer_without_curves")
    rim = Boundary(model.polyline(*lifted(RIM)), model.polyline_2d(*RIM), 3)
    face = model.trimmed(ground(model), Boundary(0, 0, 0), [rim])
    model.know_pieces(face, "bspline", flat_piece())
    return model, model.reference()


@iges("trim_nothing", "a trimmed surface without any boundary (N1 = 0, N2 = 0)")
def nothing():
    model = IgesModel("trim_nothing")
    face = model.trimmed(ground(model), None)
    model.know_pieces(face, "bspline", flat_piece(0.0, 1.0, 0.0, 1.0))
    return model, model.reference()


@iges("trim_several_inner", "an outer boundary and three holes, all of them in space")
def several():
    model = IgesModel("trim_several_inner")
    face = model.trimmed(ground(model), model.polyline(*lifted(RIM)), circles(model, HOLES, 3.0))
    holes = [round_hole(centre, 3.0) for centre in HOLES]
    model.know_pieces(face, "bspline", flat_piece(), holes=holes)
    return model, model.reference()


@iges("trim_inner_any_direction", "holes that run the same way round as the outer boundary, and one that does not")
def any_direction():
    model = IgesModel("trim_inner_any_direction")
    squares = [[(5, 6), (9, 6), (9, 10), (5, 10)], [(20, 14), (24, 14), (24, 10), (20, 10)]]
    inner = [model.polyline(*((float(x), float(y), 0.0) for x, y in square)) for square in squares]
    face = model.trimmed(ground(model), model.polyline(*reversed(lifted(RIM))), inner)
    holes = [flat_piece(5 / 40, 9 / 40, 6 / 20, 10 / 20), flat_piece(20 / 40, 24 / 40, 10 / 20, 14 / 20)]
    model.know_pieces(face, "bspline", flat_piece(), holes=holes)
    return model, model.reference()


def circle_2d(model: IgesModel, centre, radius: float) -> int:
    start = (centre[0] + radius, centre[1])
    return model.arc(centre, start, start, status=IN_PARAMETERS)


@iges("trim_hill_by_parameters", "a B-spline surface with an outer boundary and a round hole in its parameters only")
def hill_by_parameters():
    model = IgesModel("trim_hill_by_parameters")
    patch = hill()
    (u0, u1), (v0, v1) = (0.25, 2.5), (0.25, 1.75)
    outer = model.polyline_2d((u0, v0), (u1, v0), (u1, v1), (u0, v1))
    hole = circle_2d(model, (1.4, 1.0), 0.4)
    surface = model.patch(patch, status=PART)
    face = model.trimmed(surface, Boundary(0, outer, 1), [Boundary(0, hole, 1)])
    return model, hill_figures(model, face, patch, (u0, u1), (v0, v1))


def hill_figures(model: IgesModel, face: int, patch: Patch, u, v) -> dict:
    at = patch_at(patch)
    rest = Piece(at, (u[0], 1.0, 2.0, u[1]), (v[0], 1.0, v[1]))
    # The hole crosses knots at v = 1 and u = 1: halves and sectors that meet there.
    hole = sectors(at, (1.4, 1.0), 0.4, cut=1.0)
    model.know_pieces(face, "bspline", rest, holes=hole)
    return model.reference()


def sectors(at, centre, radius: float, cut: float) -> list[Piece]:
    """A disk in parameters, in pieces that end at v = centre and touch u = cut, which bounds the disk at its left."""
    assert abs(centre[0] - radius - cut) < 1e-12
    return [
        Piece(
            lambda r, a: at(centre[0] + r * np.cos(a), centre[1] + r * np.sin(a)),
            (0.0, radius),
            (k * pi / 2, (k + 1) * pi / 2),
        )
        for k in range(4)
    ]


@iges(
    "trim_hill_by_splines", "the same B-spline surface bounded by B-splines in parameters, rational ones round the hole"
)
def hill_by_splines():
    model = IgesModel("trim_hill_by_splines")
    patch = hill()
    (u0, u1), (v0, v1) = (0.25, 2.5), (0.25, 1.75)
    corners = [(u0, v0), (u1, v0), (u1, v1), (u0, v1), (u0, v0)]
    outer = model.spline(Spline(1, corners, [0.0, 0.0, 1.0, 2.0, 3.0, 4.0, 4.0]), status=IN_PARAMETERS, closed=True)
    ring = circle_spline(0.4)
    moved = Spline(2, [(x + 1.4, y + 1.0) for x, y in ring.poles], ring.knots, ring.weights)
    hole = model.spline(moved, status=IN_PARAMETERS, closed=True)
    face = model.trimmed(model.patch(patch, status=PART), Boundary(0, outer, 1), [Boundary(0, hole, 1)])
    return model, hill_figures(model, face, patch, (u0, u1), (v0, v1))


@iges("trim_closed_patch", "a tube as a closed B-spline surface, trimmed between its seams in parameters")
def closed_patch():
    model = IgesModel("trim_closed_patch")
    patch = tube_patch(10.0, 25.0)
    outer = model.polyline_2d((0.0, 0.2), (1.0, 0.2), (1.0, 0.8), (0.0, 0.8))
    face = model.trimmed(model.patch(patch, closed=(True, False), status=PART), Boundary(0, outer, 1))
    model.know(face, "bspline", 300 * pi, (0.0, 0.0, 12.5), [[-10.0, -10.0, 5.0], [10.0, 10.0, 20.0]])
    return model, model.reference()


@iges("trim_closed_patch_window", "a window in a closed B-spline surface away from its seam: a quarter of a tube")
def closed_patch_window():
    model = IgesModel("trim_closed_patch_window")
    patch = tube_patch(10.0, 25.0)
    outer = model.polyline_2d((0.25, 0.2), (0.5, 0.2), (0.5, 0.8), (0.25, 0.8))
    face = model.trimmed(model.patch(patch, closed=(True, False), status=PART), Boundary(0, outer, 1))
    centre = (-20 / pi, 20 / pi, 12.5)
    model.know(face, "bspline", 75 * pi, centre, [[-10.0, 0.0, 5.0], [0.0, 10.0, 20.0]])
    return model, model.reference()


@iges(
    "trim_revolved_by_parameters",
    "a surface of revolution (120) trimmed in its parameters: the generatrix's, then the angle",
)
def revolved_by_parameters():
    model = IgesModel("trim_revolved_by_parameters")
    axis = model.line((0.0, 0.0, 0.0), (0.0, 0.0, 1.0))
    generatrix = model.line((10.0, 0.0, 0.0), (10.0, 0.0, 20.0))
    surface = model.add(120, [axis, generatrix, 0.0, 2 * pi], status=PART)
    outer = model.polyline_2d((0.25, 0.5), (0.75, 0.5), (0.75, 2.0), (0.25, 2.0))
    face = model.trimmed(surface, Boundary(0, outer, 1))
    piece = Piece(lambda a, z: stacked(10 * np.cos(a), 10 * np.sin(a), z), (0.5, 2.0), (5.0, 15.0))
    model.know_pieces(face, "cylinder", piece)
    return model, model.reference()


@iges(
    "trim_tabulated_by_parameters", "a tabulated cylinder (122) of a spline trimmed in its parameters: both from 0 to 1"
)
def tabulated_by_parameters():
    model = IgesModel("trim_tabulated_by_parameters")
    spline = Spline(3, [(0.0, 0.0), (6.0, 8.0), (14.0, -8.0), (20.0, 0.0)], [0.0] * 4 + [1.0] * 4)
    surface = model.add(122, [model.spline(spline), 0.0, 0.0, 12.0], status=PART)
    outer = model.polyline_2d((0.25, 0.25), (0.75, 0.25), (0.75, 0.75), (0.25, 0.75))
    face = model.trimmed(surface, Boundary(0, outer, 1))

    def at(t, s):
        points = np.array([spline.point(float(x)) for x in np.ravel(t)])
        return stacked(points[:, 0].reshape(t.shape), points[:, 1].reshape(t.shape), 12 * s)

    model.know_pieces(face, "extrusion", Piece(at, (0.25, 0.75), (0.25, 0.75)))
    return model, model.reference()


@iges("trim_cylinder_hole", "a tube of revolution with a rectangular window whose boundary is in space: arcs and lines")
def cylinder_window():
    model = IgesModel("trim_cylinder_hole")
    axis = model.line((0.0, 0.0, 0.0), (0.0, 0.0, 1.0))
    generatrix = model.line((10.0, 0.0, 0.0), (10.0, 0.0, 20.0))
    surface = model.add(120, [axis, generatrix, 0.0, 2 * pi], status=PART)
    a, b = ((10 * cos(t), 10 * sin(t)) for t in (1.0, 2.0))
    # Half a turn about x makes the second arc run backward.
    turn = model.matrix(((1.0, 0.0, 0.0, 0.0), (0.0, -1.0, 0.0, 0.0), (0.0, 0.0, -1.0, 0.0)))
    window = model.composite(
        [
            model.arc((0.0, 0.0), a, b, 6.0),
            model.line((*b, 6.0), (*b, 14.0)),
            model.arc((0.0, 0.0), (b[0], -b[1]), (a[0], -a[1]), -14.0, transformation=turn),
            model.line((*a, 14.0), (*a, 6.0)),
        ]
    )
    face = model.trimmed(surface, None, [window])
    tube = Piece(lambda t, z: stacked(10 * np.cos(t), 10 * np.sin(t), z), quarters(0.0, 2 * pi), (0.0, 20.0))
    hole = Piece(lambda t, z: stacked(10 * np.cos(t), 10 * np.sin(t), z), (1.0, 2.0), (6.0, 14.0))
    model.know_pieces(face, "cylinder", tube, holes=[hole])
    return model, model.reference()


@iges("bounded_type_0", "a bounded surface (143) of type 0: an outer boundary and a hole, both in space")
def bounded_model():
    model = IgesModel("bounded_type_0")
    lines = [(model.line(a, b), 1, []) for a, b in zip(lifted(RIM), lifted(RIM)[1:] + lifted(RIM)[:1])]
    hole = [(model.circle((16.0, 10.0), 3.0), 1, [])]
    face = model.bounded(ground(model), [lines, hole])
    model.know_pieces(face, "bspline", flat_piece(), holes=[round_hole((16.0, 10.0), 3.0)])
    return model, model.reference()


@iges("bounded_type_0_senses", "a bounded surface whose curves partly run against its boundary (sense 2)")
def bounded_senses():
    model = IgesModel("bounded_type_0_senses")
    corners = lifted(RIM)
    sides = list(zip(corners, corners[1:] + corners[:1]))
    lines = [(model.line(b, a), 2, []) if k % 2 else (model.line(a, b), 1, []) for k, (a, b) in enumerate(sides)]
    face = model.bounded(ground(model), [lines])
    model.know_pieces(face, "bspline", flat_piece())
    return model, model.reference()


@iges("bounded_type_1", "a bounded surface (143) of type 1: each curve in space with one or two in parameters")
def bounded_parameters():
    model = IgesModel("bounded_type_1")
    corners = lifted(RIM)
    sides = list(zip(corners, corners[1:] + corners[:1]))
    boundary = []
    for k, (a, b) in enumerate(sides):
        p, q = RIM[k], RIM[(k + 1) % 4]
        if k == 1:
            middle = tuple((s + t) / 2 for s, t in zip(p, q))
            flat = [model.line_2d(p, middle), model.line_2d(middle, q)]
        else:
            flat = [model.line_2d(p, q)]
        boundary.append((model.line(a, b), 1, flat))
    face = model.bounded(ground(model), [boundary])
    model.know_pieces(face, "bspline", flat_piece())
    return model, model.reference()


@iges("bounded_one_curve", "a bounded surface whose boundary is one composite curve")
def bounded_one():
    model = IgesModel("bounded_one_curve")
    face = model.bounded(ground(model), [[(model.polyline(*lifted(RIM)), 1, [])]])
    model.know_pieces(face, "bspline", flat_piece())
    return model, model.reference()


@iges("trim_bounded_plane", "a hole in a bounded plane (108 form 1): no outer boundary but the plane's own")
def bounded_plane():
    model = IgesModel("trim_bounded_plane")
    rim = model.circle((0.0, 0.0), 10.0)
    plane = model.add(108, [0.0, 0.0, 1.0, 0.0, rim, 0.0, 0.0, 0.0, 0.0], form=1, status=PART)
    hole = model.on_surface(plane, model.circle((3.0, 0.0), 2.0))
    face = model.add(144, [plane, 1, 1, 0, hole])
    centroid = (-3.0 * 4.0 / 96.0, 0.0, 0.0)
    model.know(face, "plane", 96.0 * pi, centroid, [[-10.0, -10.0, 0.0], [10.0, 10.0, 0.0]])
    return model, model.reference()
