"""AP242 tessellated geometry: triangles as the file gives them."""

from __future__ import annotations

from math import cos, pi, sin, sqrt

import numpy as np

from catalogue import hand
from part21 import Ref
from step_model import AP242, FaceFigures, StepModel

TESSELLATED = "TESSELLATED_SHAPE_REPRESENTATION"
BOX = [[0.0, 0.0, 0.0], [30.0, 20.0, 10.0]]
#: Corner number = 1 + 4 i + 2 j + k for the corner at (i, j, k).
SIDES = [(1, 2, 4, 3), (5, 7, 8, 6), (1, 5, 6, 2), (3, 4, 8, 7), (1, 3, 7, 5), (2, 6, 8, 4)]
NORMALS = [(-1, 0, 0), (1, 0, 0), (0, -1, 0), (0, 1, 0), (0, 0, -1), (0, 0, 1)]


def corners(low=BOX[0], high=BOX[1]) -> list[tuple[float, float, float]]:
    (x0, y0, z0), (x1, y1, z1) = low, high
    return [(x, y, z) for x in (x0, x1) for y in (y0, y1) for z in (z0, z1)]


def coordinates(model: StepModel, points) -> Ref:
    return model.add("COORDINATES_LIST", "", len(points), [tuple(map(float, p)) for p in points])


def triangle_figures(points, triangles) -> tuple[float, tuple[float, ...]]:
    """Area and centroid of triangles over zero-based indices."""
    p = np.array(points, float)
    t = np.array(triangles)
    a, b, c = p[t[:, 0]], p[t[:, 1]], p[t[:, 2]]
    areas = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
    centre = ((a + b + c) / 3 * areas[:, None]).sum(axis=0) / areas.sum()
    return float(areas.sum()), tuple(map(float, centre))


def record(model: StepModel, face: Ref, points, triangles) -> Ref:
    model.faces.append(FaceFigures(face, "facets", *triangle_figures(points, triangles)))
    return face


def box_face(model: StepModel, list_: Ref, points, k: int, indexed: bool = True) -> Ref:
    """One side of a box: over its four points by `pnindex`, or straight over the coordinates."""
    side = SIDES[k]
    local = [(1, 2, 3), (1, 3, 4)]
    triangles = [tuple(side[i - 1] for i in t) for t in local]
    normals = [tuple(map(float, NORMALS[k]))]
    index, used = (list(side), local) if indexed else ([], triangles)
    face = model.add("TRIANGULATED_FACE", "", list_, 4 if indexed else 8, normals, None, index, used)
    return record(model, face, points, [[i - 1 for i in t] for t in triangles])


@hand("tessellated_solid", "TESSELLATED_SOLID of six TRIANGULATED_FACEs over one COORDINATES_LIST, by pnindex")
def tessellated_solid():
    model = StepModel(AP242)
    points = corners()
    list_ = coordinates(model, points)
    solid = model.add("TESSELLATED_SOLID", "", [box_face(model, list_, points, k) for k in range(6)], None)
    model.product("tessellated_solid", [solid], representation=TESSELLATED)
    return model, model.reference(volume=6000.0, bbox=BOX)


@hand("tessellated_shell", "TESSELLATED_SHELL of five faces, without pnindex")
def tessellated_shell():
    model = StepModel(AP242)
    points = corners()
    list_ = coordinates(model, points)
    shell = model.add("TESSELLATED_SHELL", "", [box_face(model, list_, points, k, False) for k in range(5)], None)
    model.product("tessellated_shell", [shell], representation=TESSELLATED)
    return model, model.reference(bbox=BOX, closed=False)


@hand(
    "tessellated_separate_lists",
    "a solid each of whose faces has a coordinates list of its own: corners must be welded",
)
def tessellated_separate_lists():
    model = StepModel(AP242)
    faces = []
    for side, normal in zip(SIDES, NORMALS):
        points = [corners()[i - 1] for i in side]
        list_ = coordinates(model, points)
        face = model.add(
            "TRIANGULATED_FACE", "", list_, 4, [tuple(map(float, normal))], None, [], [(1, 2, 3), (1, 3, 4)]
        )
        faces.append(record(model, face, points, [(0, 1, 2), (0, 2, 3)]))
    model.product(
        "tessellated_separate_lists", [model.add("TESSELLATED_SOLID", "", faces, None)], representation=TESSELLATED
    )
    return model, model.reference(volume=6000.0, bbox=BOX)


def octagon_points() -> list:
    """Eight points below, eight above, then both centres."""
    ring = [(10 * cos(k * pi / 4), 10 * sin(k * pi / 4)) for k in range(8)]
    return [(*p, 0.0) for p in ring] + [(*p, 6.0) for p in ring] + [(0.0, 0.0, 0.0), (0.0, 0.0, 6.0)]


def strip_triangles(strip) -> list:
    """A strip's triangles, all turning the same way."""
    return [
        (strip[i], strip[i + 1], strip[i + 2]) if i % 2 == 0 else (strip[i + 1], strip[i], strip[i + 2])
        for i in range(len(strip) - 2)
    ]


def fan_triangles(fan) -> list:
    return [(fan[0], fan[i], fan[i + 1]) for i in range(1, len(fan) - 1)]


def octagon_parts() -> list[tuple[list, list]]:
    """(strips, fans) of the wall, the floor and the lid, one-based."""
    wall = [i for k in range(9) for i in (9 + k % 8, 1 + k % 8)]
    floor = [17] + [1 + (-k) % 8 for k in range(9)]
    lid = [18] + [9 + k % 8 for k in range(9)]
    return [([wall], []), ([], [floor]), ([], [lid])]


OCTAGON = {"volume": 6 * 200 * sqrt(2), "bbox": [[-10.0, -10.0, 0.0], [10.0, 10.0, 6.0]]}


def as_triangles(strips, fans) -> list:
    found = [t for strip in strips for t in strip_triangles(strip)] + [t for fan in fans for t in fan_triangles(fan)]
    return [[i - 1 for i in t] for t in found]


@hand("tessellated_strips_and_fans", "COMPLEX_TRIANGULATED_FACE: a strip round an octagonal prism, a fan on each end")
def tessellated_strips_and_fans():
    model = StepModel(AP242)
    points = octagon_points()
    list_ = coordinates(model, points)
    faces = []
    for strips, fans in octagon_parts():
        face = model.add("COMPLEX_TRIANGULATED_FACE", "", list_, 18, [], None, list(range(1, 19)), strips, fans)
        faces.append(record(model, face, points, as_triangles(strips, fans)))
    model.product(
        "tessellated_strips_and_fans", [model.add("TESSELLATED_SOLID", "", faces, None)], representation=TESSELLATED
    )
    return model, model.reference(**OCTAGON)


@hand(
    "tessellated_surface_sets",
    "TRIANGULATED_SURFACE_SET and COMPLEX_TRIANGULATED_SURFACE_SET in a TESSELLATED_GEOMETRIC_SET",
)
def tessellated_surface_sets():
    model = StepModel(AP242)
    points = octagon_points()
    list_ = coordinates(model, points)
    strips, fans = octagon_parts()[0]
    complex_set = model.add("COMPLEX_TRIANGULATED_SURFACE_SET", "", list_, 18, [], [], strips, fans)
    record(model, complex_set, points, as_triangles(strips, fans))
    flat = fan_triangles(octagon_parts()[2][1][0])
    plain_set = model.add("TRIANGULATED_SURFACE_SET", "", list_, 18, [(0.0, 0.0, 1.0)], [], flat)
    record(model, plain_set, points, [[i - 1 for i in t] for t in flat])
    items = model.add("TESSELLATED_GEOMETRIC_SET", "", [complex_set, plain_set])
    model.product("tessellated_surface_sets", [items], representation=TESSELLATED)
    return model, model.reference(bbox=OCTAGON["bbox"], closed=False)


@hand("tessellated_repositioned", "a complex instance of REPOSITIONED_TESSELLATED_ITEM and TESSELLATED_GEOMETRIC_SET")
def tessellated_repositioned():
    model = StepModel(AP242)
    points = corners()
    list_ = coordinates(model, points)
    triangles = [(a, b, c) for s in SIDES for a, b, c in ((s[0], s[1], s[2]), (s[0], s[2], s[3]))]
    surface = model.add("TRIANGULATED_SURFACE_SET", "", list_, 8, [], [], triangles)
    # Turned by 90 degrees about z and moved: x runs along +y.
    location = model.axis2((100.0, 50.0, 5.0), (0.0, 0.0, 1.0), (0.0, 1.0, 0.0))
    moved = [(100 - y, 50 + x, 5 + z) for x, y, z in points]
    record(model, surface, moved, [[i - 1 for i in t] for t in triangles])
    items = model.add_complex(
        GEOMETRIC_REPRESENTATION_ITEM=(),
        REPOSITIONED_TESSELLATED_ITEM=(location,),
        REPRESENTATION_ITEM=("",),
        TESSELLATED_GEOMETRIC_SET=([surface],),
        TESSELLATED_ITEM=(),
    )
    model.product("tessellated_repositioned", [items], representation=TESSELLATED)
    return model, model.reference(bbox=[[80.0, 50.0, 5.0], [100.0, 80.0, 15.0]], closed=False)


def octahedron_sphere(levels: int) -> tuple[np.ndarray, list]:
    """A sphere of radius 1 as a refined octahedron."""
    points = [np.array(p, float) for p in [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]]
    faces = [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)]
    for _ in range(levels):
        middles: dict = {}

        def middle(a: int, b: int) -> int:
            key = (min(a, b), max(a, b))
            if key not in middles:
                point = points[a] + points[b]
                points.append(point / np.linalg.norm(point))
                middles[key] = len(points) - 1
            return middles[key]

        refined = []
        for a, b, c in faces:
            ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
            refined += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
        faces = refined
    return np.array(points), faces


@hand("tessellated_vertex_normals", "a sphere of triangles with one normal per point")
def tessellated_vertex_normals():
    model = StepModel(AP242)
    sphere, faces = octahedron_sphere(2)
    points = [tuple(round(float(c), 9) for c in 10 * p) for p in sphere]
    normals = [tuple(round(float(c), 9) for c in p) for p in sphere]
    list_ = coordinates(model, points)
    triangles = [tuple(i + 1 for i in f) for f in faces]
    face = model.add("TRIANGULATED_FACE", "", list_, len(points), normals, None, [], triangles)
    record(model, face, points, faces)
    model.product(
        "tessellated_vertex_normals", [model.add("TESSELLATED_SOLID", "", [face], None)], representation=TESSELLATED
    )
    p = np.array(points)
    volume = float(sum(np.dot(p[a], np.cross(p[b], p[c])) for a, b, c in faces) / 6)
    return model, model.reference(volume=volume, bbox=[[-10.0] * 3, [10.0] * 3])


@hand("tessellated_curves_and_points", "TESSELLATED_CURVE_SET and TESSELLATED_POINT_SET: lines, no face")
def tessellated_curves_and_points():
    model = StepModel(AP242)
    points = [(0.0, 0.0, 0.0), (10.0, 0.0, 0.0), (10.0, 10.0, 0.0), (0.0, 10.0, 0.0), (5.0, 5.0, 9.0)]
    list_ = coordinates(model, points)
    lines = model.add("TESSELLATED_CURVE_SET", "", list_, [(1, 2, 3, 4, 1), (1, 5)])
    dots = model.add("TESSELLATED_POINT_SET", "", list_, [(5,)])
    items = model.add("TESSELLATED_GEOMETRIC_SET", "", [lines, dots])
    model.product("tessellated_curves_and_points", [items], representation=TESSELLATED)
    reference = model.reference(bbox=[[0.0] * 3, [10.0, 10.0, 9.0]], closed=False)
    return model, {**reference, "free_curves": {"count": 2, "length_mm": 40 + sqrt(131)}}


@hand("tessellated_beside_brep", "an exact solid and its tessellation, linked: the exact one counts, once")
def tessellated_beside_brep():
    model = StepModel(AP242)
    faces = model.box_faces(*BOX)
    solid = model.solid(faces)
    product = model.product("tessellated_beside_brep", [solid])
    points = corners()
    list_ = coordinates(model, points)
    twins = []
    for side, normal, exact in zip(SIDES, NORMALS, faces):
        args = [list_, 4, [tuple(map(float, normal))], exact, list(side), [(1, 2, 3), (1, 3, 4)]]
        twins.append(model.add("TRIANGULATED_FACE", "", *args))
    tessellation = model.add("TESSELLATED_SOLID", "", twins, solid)
    shape = model.add(TESSELLATED, "", [tessellation], product.context)
    model.add("SHAPE_REPRESENTATION_RELATIONSHIP", "", "", product.representation, shape)
    return model, model.reference(volume=6000.0, bbox=BOX)


@hand("tessellated_inch", "a tessellated solid in a file of inches")
def tessellated_inch():
    model = StepModel(AP242)
    context = model.context(length=model.converted_length("INCH", 25.4, model.millimetre()))
    points = corners((0.0, 0.0, 0.0), (1.0, 2.0, 0.5))
    list_ = coordinates(model, points)
    solid = model.add("TESSELLATED_SOLID", "", [box_face(model, list_, points, k) for k in range(6)], None)
    model.product("tessellated_inch", [solid], representation=TESSELLATED, context=context)
    return model, model.reference(volume=1.0, bbox=[[0.0] * 3, [1.0, 2.0, 0.5]], scale=25.4)
