"""Faces on closed surfaces without seam edges, as Parasolid and ACIS write them, and loops of a single vertex."""

from math import atan, cos, pi, sin, sqrt

from catalogue import hand
from part21 import FALSE, TRUE, Enum, Ref
from step_model import ORIGIN, X, Y, Z, StepModel, times


def ball_box(radius: float) -> list:
    return [[-radius] * 3, [radius] * 3]


def sheet(model: StepModel, name: str, faces) -> None:
    """A product whose shape is one open shell."""
    body = model.add("SHELL_BASED_SURFACE_MODEL", "", [model.add("OPEN_SHELL", "", list(faces))])
    model.product(name, [body], representation="MANIFOLD_SURFACE_SHAPE_REPRESENTATION")


def disc(model: StepModel, ring: Ref, forward: bool, origin, normal, x, radius: float) -> Ref:
    """The disc within a ring that is an edge of another face too."""
    return model.face(
        model.plane(origin, normal, x),
        [model.loop((ring, forward))],
        kind="plane",
        area=pi * radius**2,
        centroid=origin,
    )


@hand("sphere_no_bounds", "a whole sphere: a face without bounds")
def sphere_no_bounds():
    model = StepModel()
    model.product(
        "sphere_no_bounds",
        [model.solid([model.face(model.sphere(10.0), [], kind="sphere", area=400 * pi, centroid=ORIGIN)])],
    )
    return model, model.reference(volume=4000 * pi / 3, bbox=ball_box(10.0))


@hand("sphere_vertex_loop", "a whole sphere bounded by a vertex loop at its south pole")
def sphere_vertex_loop():
    model = StepModel()
    loop = model.vertex_loop((0.0, 0.0, -10.0))
    face = model.face(model.sphere(10.0), [loop], kind="sphere", area=400 * pi, centroid=ORIGIN)
    model.product("sphere_vertex_loop", [model.solid([face])])
    return model, model.reference(volume=4000 * pi / 3, bbox=ball_box(10.0))


@hand("sphere_vertex_loop_anywhere", "a whole sphere bounded by a vertex loop that is on no pole and no seam")
def sphere_vertex_loop_anywhere():
    model = StepModel()
    face = model.face(
        model.sphere(10.0), [model.vertex_loop((-6.0, 0.0, 8.0))], kind="sphere", area=400 * pi, centroid=ORIGIN
    )
    model.product("sphere_vertex_loop_anywhere", [model.solid([face])])
    return model, model.reference(volume=4000 * pi / 3, bbox=ball_box(10.0))


@hand("sphere_as_two_halves", "two half spheres that share one circle; each pole is inside its face, no seam")
def sphere_as_two_halves():
    model = StepModel()
    equator = model.ring(ORIGIN, Z, X, 10.0)
    surface = model.sphere(10.0)
    upper = model.face(surface, [model.loop(equator)], kind="sphere", area=200 * pi, centroid=(0.0, 0.0, 5.0))
    lower = model.face(surface, [model.loop((equator, False))], kind="sphere", area=200 * pi, centroid=(0.0, 0.0, -5.0))
    model.product("sphere_as_two_halves", [model.solid([upper, lower])])
    return model, model.reference(volume=4000 * pi / 3, bbox=ball_box(10.0))


@hand("sphere_as_two_halves_askew", "two half spheres that share a great circle through both poles")
def sphere_as_two_halves_askew():
    model = StepModel()
    meridian = model.ring(ORIGIN, X, Y, 10.0)
    surface = model.sphere(10.0)
    front = model.face(surface, [model.loop(meridian)], kind="sphere", area=200 * pi, centroid=(5.0, 0.0, 0.0))
    back = model.face(surface, [model.loop((meridian, False))], kind="sphere", area=200 * pi, centroid=(-5.0, 0.0, 0.0))
    model.product("sphere_as_two_halves_askew", [model.solid([front, back])])
    return model, model.reference(volume=4000 * pi / 3, bbox=ball_box(10.0))


def cap_figures(radius: float, at: float) -> tuple[float, float, float]:
    """Area, height of the centroid, and volume of the part of a sphere above the plane z = `at`."""
    height = radius - at
    return 2 * pi * radius * height, (radius + at) / 2, pi * height**2 * (3 * radius - height) / 3


@hand("sphere_cap", "a cap with a single circle as its edge: the pole is inside")
def sphere_cap():
    model = StepModel()
    area, height, volume = cap_figures(10.0, 6.0)
    ring = model.ring((0.0, 0.0, 6.0), Z, X, 8.0)
    dome = model.face(model.sphere(10.0), [model.loop(ring)], kind="sphere", area=area, centroid=(0.0, 0.0, height))
    floor = disc(model, ring, False, (0.0, 0.0, 6.0), (0.0, 0.0, -1.0), X, 8.0)
    model.product("sphere_cap", [model.solid([dome, floor])])
    return model, model.reference(volume=volume, bbox=[[-8.0, -8.0, 6.0], [8.0, 8.0, 10.0]])


@hand("sphere_without_cap", "the large rest of a sphere: a single circle as its edge, the other pole inside")
def sphere_without_cap():
    model = StepModel()
    area, height, volume = cap_figures(10.0, -6.0)
    ring = model.ring((0.0, 0.0, 6.0), Z, X, 8.0)
    bowl = model.face(
        model.sphere(10.0), [model.loop((ring, False))], kind="sphere", area=area, centroid=(0.0, 0.0, -height)
    )
    lid = disc(model, ring, True, (0.0, 0.0, 6.0), Z, X, 8.0)
    model.product("sphere_without_cap", [model.solid([bowl, lid])])
    return model, model.reference(volume=volume, bbox=[[-10.0] * 3, [10.0, 10.0, 6.0]])


SLANT = (0.6, 0.48, 0.64)
SLANT_X = (0.8, -0.36, -0.48)


@hand("sphere_cap_slanting", "a cap with one circle as its edge, away from pole and seam: nothing but the loop")
def sphere_cap_slanting():
    model = StepModel()
    area, height, volume = cap_figures(10.0, 9.0)
    centre = times(9.0, SLANT)
    ring = model.ring(centre, SLANT, SLANT_X, sqrt(19.0))
    dome = model.face(model.sphere(10.0), [model.loop(ring)], kind="sphere", area=area, centroid=times(height, SLANT))
    floor = disc(model, ring, False, centre, times(-1.0, SLANT), SLANT_X, sqrt(19.0))
    model.product("sphere_cap_slanting", [model.solid([dome, floor])])
    return model, model.reference(volume=volume, bbox=cap_box(SLANT, 10.0, 9.0))


def cap_box(axis, radius: float, at: float) -> list:
    """Box of the cap about a unit axis: the sphere's extreme where it lies in the cap, else the rim's."""
    low, high = [], []
    rim = sqrt(radius**2 - at**2)
    for c in axis:
        spread = rim * sqrt(1 - c * c)
        high.append(radius if radius * c >= at else at * c + spread)
        low.append(-radius if -radius * c >= at else at * c - spread)
    return [low, high]


@hand("sphere_with_small_hole", "a sphere whose only edge is a small circle: the face is everything outside it")
def sphere_with_small_hole():
    model = StepModel()
    area, height, volume = cap_figures(10.0, 9.9)
    radius = sqrt(100 - 9.9**2)
    centre = times(9.9, SLANT)
    ring = model.ring(centre, SLANT, SLANT_X, radius)
    rest = 400 * pi - area
    ball = model.face(
        model.sphere(10.0),
        [model.loop((ring, False))],
        kind="sphere",
        area=rest,
        centroid=times(-area * height / rest, SLANT),
    )
    lid = disc(model, ring, True, centre, SLANT, SLANT_X, radius)
    model.product("sphere_with_small_hole", [model.solid([ball, lid])])
    return model, model.reference(volume=4000 * pi / 3 - volume, bbox=ball_box(10.0))


@hand("sphere_zone_two_circles", "a zone between two circles of latitude, no seam")
def sphere_zone_two_circles():
    model = StepModel()
    low = model.ring((0.0, 0.0, -6.0), Z, X, 8.0)
    high = model.ring((0.0, 0.0, 8.0), Z, X, 6.0)
    zone = model.face(
        model.sphere(10.0),
        [model.loop(low), model.loop((high, False))],
        kind="sphere",
        area=280 * pi,
        centroid=(0.0, 0.0, 1.0),
    )
    floor = disc(model, low, False, (0.0, 0.0, -6.0), (0.0, 0.0, -1.0), X, 8.0)
    lid = disc(model, high, True, (0.0, 0.0, 8.0), Z, X, 6.0)
    model.product("sphere_zone_two_circles", [model.solid([zone, floor, lid])])
    volume = pi * 14 / 6 * (3 * 64 + 3 * 36 + 14**2)
    return model, model.reference(volume=volume, bbox=[[-10.0, -10.0, -6.0], [10.0, 10.0, 8.0]])


@hand("cylinder_two_circles", "a cylinder as Parasolid writes it: two circles that wrap round, no seam")
def cylinder_two_circles():
    model = StepModel()
    low = model.ring(ORIGIN, Z, X, 10.0)
    high = model.ring((0.0, 0.0, 30.0), Z, X, 10.0)
    wall = model.face(
        model.cylinder(10.0),
        [model.loop(low), model.loop((high, False))],
        kind="cylinder",
        area=600 * pi,
        centroid=(0.0, 0.0, 15.0),
    )
    faces = [
        wall,
        disc(model, low, False, ORIGIN, (0.0, 0.0, -1.0), X, 10.0),
        disc(model, high, True, (0.0, 0.0, 30.0), Z, X, 10.0),
    ]
    model.product("cylinder_two_circles", [model.solid(faces)])
    return model, model.reference(volume=3000 * pi, bbox=[[-10.0, -10.0, 0.0], [10.0, 10.0, 30.0]])


@hand("cylinder_turned_vertices", "two circles whose vertices stand at different angles, neither on the seam")
def cylinder_turned_vertices():
    model = StepModel()
    low = model.ring(ORIGIN, Z, (-0.6, 0.8, 0.0), 10.0)
    high = model.ring((0.0, 0.0, 30.0), Z, (0.0, -1.0, 0.0), 10.0)
    wall = model.face(
        model.cylinder(10.0),
        [model.loop((high, False)), model.loop(low)],
        kind="cylinder",
        area=600 * pi,
        centroid=(0.0, 0.0, 15.0),
        outer=False,
    )
    faces = [
        wall,
        disc(model, low, False, ORIGIN, (0.0, 0.0, -1.0), X, 10.0),
        disc(model, high, True, (0.0, 0.0, 30.0), Z, X, 10.0),
    ]
    model.product("cylinder_turned_vertices", [model.solid(faces)])
    return model, model.reference(volume=3000 * pi, bbox=[[-10.0, -10.0, 0.0], [10.0, 10.0, 30.0]])


@hand("cylinder_split_circles", "wrapping loops of two and three arcs each, no seam")
def cylinder_split_circles():
    model = StepModel()

    def arcs(z: float, angles) -> list[Ref]:
        points = [(10 * cos(a), 10 * sin(a), z) for a in angles]
        return [
            model.edge(a, b, model.circle((0.0, 0.0, z), Z, X, 10.0)) for a, b in zip(points, points[1:] + points[:1])
        ]

    low, high = arcs(0.0, [1.0, 4.0]), arcs(30.0, [0.5, 2.0, 5.0])
    back = [(edge, False) for edge in reversed(high)]
    wall = model.face(
        model.cylinder(10.0),
        [model.loop(*low), model.loop(*back)],
        kind="cylinder",
        area=600 * pi,
        centroid=(0.0, 0.0, 15.0),
    )
    floor = model.face(
        model.plane(ORIGIN, (0.0, 0.0, -1.0)),
        [model.loop(*((e, False) for e in reversed(low)))],
        kind="plane",
        area=100 * pi,
        centroid=ORIGIN,
    )
    lid = model.face(
        model.plane((0.0, 0.0, 30.0)), [model.loop(*high)], kind="plane", area=100 * pi, centroid=(0.0, 0.0, 30.0)
    )
    model.product("cylinder_split_circles", [model.solid([wall, floor, lid])])
    return model, model.reference(volume=3000 * pi, bbox=[[-10.0, -10.0, 0.0], [10.0, 10.0, 30.0]])


@hand("cylinder_with_window", "two wrapping circles and a window across the seam, no seam edge")
def cylinder_with_window():
    # The window spans 60 degrees about the seam, z from 10 to 20; it is closed by a plane and the cylinder's piece is taken off.
    model = StepModel()
    low, high = model.ring(ORIGIN, Z, X, 10.0), model.ring((0.0, 0.0, 30.0), Z, X, 10.0)
    a = pi / 6
    corner = {(s, z): (10 * cos(a), s * 10 * sin(a), z) for s in (-1, 1) for z in (10.0, 20.0)}
    bottom = model.edge(corner[-1, 10.0], corner[1, 10.0], model.circle((0.0, 0.0, 10.0), Z, X, 10.0))
    top = model.edge(corner[-1, 20.0], corner[1, 20.0], model.circle((0.0, 0.0, 20.0), Z, X, 10.0))
    left = model.straight(corner[-1, 10.0], corner[-1, 20.0])
    right = model.straight(corner[1, 10.0], corner[1, 20.0])
    window = model.loop(left, top, (right[0], False), (bottom, False))
    piece = 10 * 10 * 2 * a
    wall_area = 600 * pi - piece
    x_moment = -piece * 10 * sin(a) / a
    wall = model.face(
        model.cylinder(10.0),
        [model.loop(low), model.loop((high, False)), window],
        kind="cylinder",
        area=wall_area,
        centroid=(x_moment / wall_area, 0.0, 15.0),
    )
    segment = 100 * (a - sin(a) * cos(a))
    glass = model.polygon_face(corner[-1, 10.0], corner[1, 10.0], corner[1, 20.0], corner[-1, 20.0])
    chord_low, chord_high = (
        model.straight(corner[-1, 10.0], corner[1, 10.0])[0],
        model.straight(corner[1, 20.0], corner[-1, 20.0])[0],
    )
    at = (2 * 10 * sin(a)) ** 3 / (12 * segment)
    sill = model.face(
        model.plane((0.0, 0.0, 10.0)),
        [model.loop(bottom, (chord_low, False))],
        kind="plane",
        area=segment,
        centroid=(at, 0.0, 10.0),
    )
    lintel = model.face(
        model.plane((0.0, 0.0, 20.0), (0.0, 0.0, -1.0)),
        [model.loop((top, False), (chord_high, False))],
        kind="plane",
        area=segment,
        centroid=(at, 0.0, 20.0),
    )
    faces = [wall, glass, sill, lintel]
    faces += [
        disc(model, low, False, ORIGIN, (0.0, 0.0, -1.0), X, 10.0),
        disc(model, high, True, (0.0, 0.0, 30.0), Z, X, 10.0),
    ]
    model.product("cylinder_with_window", [model.solid(faces)])
    return model, model.reference(volume=3000 * pi - 10 * segment, bbox=[[-10.0, -10.0, 0.0], [10.0, 10.0, 30.0]])


@hand("frustum_two_circles", "a cone between two wrapping circles, no seam")
def frustum_two_circles():
    model = StepModel()
    low, high = model.ring(ORIGIN, Z, X, 10.0), model.ring((0.0, 0.0, 20.0), Z, X, 4.0)
    slope = sqrt(36 + 400)
    side = pi * 14 * slope
    height = 20 * (10 + 2 * 4) / (3 * 14)
    # The radius grows against the axis, so the cone is written about -z from the upper circle.

    wall = model.face(
        model.cone(4.0, atan(6 / 20), (0.0, 0.0, 20.0), (0.0, 0.0, -1.0)),
        [model.loop(low), model.loop((high, False))],
        kind="cone",
        area=side,
        centroid=(0.0, 0.0, height),
    )
    faces = [
        wall,
        disc(model, low, False, ORIGIN, (0.0, 0.0, -1.0), X, 10.0),
        disc(model, high, True, (0.0, 0.0, 20.0), Z, X, 4.0),
    ]
    model.product("frustum_two_circles", [model.solid(faces)])
    return model, model.reference(volume=pi * 20 * 156 / 3, bbox=[[-10.0, -10.0, 0.0], [10.0, 10.0, 20.0]])


def cone_with_tip(name: str, tip):
    """A cone from a circle up to its apex; `tip` gives the loops besides the circle."""

    model = StepModel()
    low = model.ring(ORIGIN, Z, X, 10.0)
    wall = model.face(
        model.cone(10.0, atan(10 / 25), ORIGIN, (0.0, 0.0, -1.0)),
        [model.loop(low), *tip(model)],
        kind="cone",
        area=pi * 10 * sqrt(725),
        centroid=(0.0, 0.0, 25 / 3),
    )
    model.product(name, [model.solid([wall, disc(model, low, False, ORIGIN, (0.0, 0.0, -1.0), X, 10.0)])])
    return model, model.reference(volume=2500 * pi / 3, bbox=[[-10.0, -10.0, 0.0], [10.0, 10.0, 25.0]])


@hand("cone_vertex_loop", "a cone to its apex: a circle and a vertex loop")
def cone_vertex_loop():
    return cone_with_tip("cone_vertex_loop", lambda model: [model.vertex_loop((0.0, 0.0, 25.0))])


@hand("cone_circle_only", "a cone to its apex: a circle and nothing else")
def cone_circle_only():
    return cone_with_tip("cone_circle_only", lambda model: [])


@hand("cone_seam_to_apex", "a cone to its apex: circle and seam line in one loop, the apex an ordinary vertex")
def cone_seam_to_apex():

    model = StepModel()
    low = model.ring(ORIGIN, Z, X, 10.0)
    seam = model.straight((10.0, 0.0, 0.0), (0.0, 0.0, 25.0))[0]
    wall = model.face(
        model.cone(10.0, atan(10 / 25), ORIGIN, (0.0, 0.0, -1.0)),
        [model.loop(low, (seam, True), (seam, False))],
        kind="cone",
        area=pi * 10 * sqrt(725),
        centroid=(0.0, 0.0, 25 / 3),
    )
    model.product(
        "cone_seam_to_apex", [model.solid([wall, disc(model, low, False, ORIGIN, (0.0, 0.0, -1.0), X, 10.0)])]
    )
    return model, model.reference(volume=2500 * pi / 3, bbox=[[-10.0, -10.0, 0.0], [10.0, 10.0, 25.0]])


TORUS_BOX = [[-25.0, -25.0, -5.0], [25.0, 25.0, 5.0]]


@hand("torus_no_bounds", "a whole torus: a face without bounds")
def torus_no_bounds():
    model = StepModel()
    face = model.face(model.torus(20.0, 5.0), [], kind="torus", area=400 * pi**2, centroid=ORIGIN)
    model.product("torus_no_bounds", [model.solid([face])])
    return model, model.reference(volume=1000 * pi**2, bbox=TORUS_BOX)


@hand("torus_vertex_loop", "a whole torus bounded by a vertex loop")
def torus_vertex_loop():
    model = StepModel()
    face = model.face(
        model.torus(20.0, 5.0), [model.vertex_loop((25.0, 0.0, 0.0))], kind="torus", area=400 * pi**2, centroid=ORIGIN
    )
    model.product("torus_vertex_loop", [model.solid([face])])
    return model, model.reference(volume=1000 * pi**2, bbox=TORUS_BOX)


@hand("torus_half_two_circles", "half a torus ring between two circles round its tube, no seam")
def torus_half_two_circles():
    # The half with y >= 0: both circles turn about +y, so that it lies to the left of both.
    model = StepModel()
    start = model.ring((20.0, 0.0, 0.0), Y, X, 5.0)
    end = model.ring((-20.0, 0.0, 0.0), Y, X, 5.0)
    area = 200 * pi**2
    y = (2 * (20**2 + 5**2 / 2) * 2 * pi * 5) / area
    tube = model.face(
        model.torus(20.0, 5.0),
        [model.loop(start), model.loop(end)],
        kind="torus",
        area=area,
        centroid=(0.0, y, 0.0),
        outer=False,
    )
    near = disc(model, start, False, (20.0, 0.0, 0.0), (0.0, -1.0, 0.0), X, 5.0)
    far = disc(model, end, False, (-20.0, 0.0, 0.0), (0.0, -1.0, 0.0), X, 5.0)
    model.product("torus_half_two_circles", [model.solid([tube, near, far])])
    return model, model.reference(volume=500 * pi**2, bbox=[[-25.0, 0.0, -5.0], [25.0, 25.0, 5.0]])


@hand("torus_half_tube_two_circles", "the lower half of a torus between its two equators, no seam")
def torus_half_tube_two_circles():
    model = StepModel()
    outer = model.ring(ORIGIN, Z, X, 25.0)
    inner = model.ring(ORIGIN, Z, X, 15.0)
    area = 200 * pi**2
    # Seen from outside, the material of the lower half lies to the left of the outer circle run backward.
    trough = model.face(
        model.torus(20.0, 5.0),
        [model.loop((outer, False)), model.loop(inner)],
        kind="torus",
        area=area,
        centroid=(0.0, 0.0, -10 / pi),
        outer=False,
    )
    lid = model.face(
        model.plane(), [model.loop(outer), model.loop((inner, False))], kind="plane", area=400 * pi, centroid=ORIGIN
    )
    model.product("torus_half_tube_two_circles", [model.solid([trough, lid])])
    return model, model.reference(volume=500 * pi**2, bbox=[[-25.0, -25.0, -5.0], [25.0, 25.0, 0.0]])


@hand(
    "bspline_tube_two_circles", "a rational B-spline cylinder, closed in u, between two wrapping circles without a seam"
)
def bspline_tube_two_circles():
    model = StepModel()
    low, high = model.ring(ORIGIN, Z, X, 10.0), model.ring((0.0, 0.0, 30.0), Z, X, 10.0)
    square = [(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1), (1, 0)]
    poles = [[model.point((10.0 * x, 10.0 * y, z)) for z in (0.0, 30.0)] for x, y in square]
    weights = [[1.0 if k % 2 == 0 else sqrt(0.5)] * 2 for k in range(9)]

    surface = model.add_complex(
        BOUNDED_SURFACE=(),
        B_SPLINE_SURFACE=(2, 1, poles, Enum("UNSPECIFIED"), TRUE, FALSE, FALSE),
        B_SPLINE_SURFACE_WITH_KNOTS=(
            [3, 2, 2, 2, 3],
            [2, 2],
            [0.0, 0.25, 0.5, 0.75, 1.0],
            [0.0, 1.0],
            Enum("UNSPECIFIED"),
        ),
        GEOMETRIC_REPRESENTATION_ITEM=(),
        RATIONAL_B_SPLINE_SURFACE=(weights,),
        REPRESENTATION_ITEM=("",),
        SURFACE=(),
    )
    wall = model.face(
        surface, [model.loop(low), model.loop((high, False))], kind="bspline", area=600 * pi, centroid=(0.0, 0.0, 15.0)
    )
    faces = [
        wall,
        disc(model, low, False, ORIGIN, (0.0, 0.0, -1.0), X, 10.0),
        disc(model, high, True, (0.0, 0.0, 30.0), Z, X, 10.0),
    ]
    model.product("bspline_tube_two_circles", [model.solid(faces)])
    return model, model.reference(volume=3000 * pi, bbox=[[-10.0, -10.0, 0.0], [10.0, 10.0, 30.0]])


@hand("cylinder_reversed", "a bore seen from inside: same_sense .F. with wrapping circles, no seam")
def cylinder_reversed():
    model = StepModel()
    z = 10.0
    rings = {(r, h): model.ring((0.0, 0.0, h), Z, X, r) for r in (6.0, 10.0) for h in (0.0, z)}
    outer = model.face(
        model.cylinder(10.0),
        [model.loop(rings[10.0, 0.0]), model.loop((rings[10.0, z], False))],
        kind="cylinder",
        area=200 * pi,
        centroid=(0.0, 0.0, 5.0),
    )
    bore = model.face(
        model.cylinder(6.0),
        [model.loop((rings[6.0, 0.0], False)), model.loop(rings[6.0, z])],
        kind="cylinder",
        area=120 * pi,
        centroid=(0.0, 0.0, 5.0),
        same_sense=False,
    )
    floor = model.face(
        model.plane(ORIGIN, (0.0, 0.0, -1.0)),
        [model.loop((rings[10.0, 0.0], False)), model.loop(rings[6.0, 0.0])],
        kind="plane",
        area=64 * pi,
        centroid=ORIGIN,
    )
    lid = model.face(
        model.plane((0.0, 0.0, z)),
        [model.loop(rings[10.0, z]), model.loop((rings[6.0, z], False))],
        kind="plane",
        area=64 * pi,
        centroid=(0.0, 0.0, z),
    )
    model.product("cylinder_reversed", [model.solid([outer, bore, floor, lid])])
    return model, model.reference(volume=640 * pi, bbox=[[-10.0, -10.0, 0.0], [10.0, 10.0, z]])
