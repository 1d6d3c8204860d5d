"""Shells, faces and loops in the forms that AP203, AP214 and AP242 allow besides the usual one."""

from math import pi, sqrt

from catalogue import hand
from part21 import DERIVED, FALSE, TRUE, Enum, Ref
from step_model import ORIGIN, X, Z, FaceFigures, StepModel, plus, polygon_figures, times, unit

BOX = [[0.0, 0.0, 0.0], [30.0, 20.0, 10.0]]


def box_polygons(low, high) -> list[list]:
    """The corners of a box's six sides, outward."""
    (x0, y0, z0), (x1, y1, z1) = low, high
    corner = [(x, y, z) for x in (x0, x1) for y in (y0, y1) for z in (z0, z1)]
    sides = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return [[corner[i] for i in side] for side in sides]


def facet(model: StepModel, loops, plane: bool) -> Ref:
    """A face over poly loops, the first of them the outer one."""
    bounds = []
    for i, points in enumerate(loops):
        poly = model.add("POLY_LOOP", "", [model.point(p) for p in points])
        bounds.append(model.add("FACE_OUTER_BOUND" if i == 0 else "FACE_BOUND", "", poly, TRUE))
    area, normal, centroid = polygon_figures(loops[0])
    for points in loops[1:]:
        inner, _, at = polygon_figures(points)
        centroid = times(1 / (area - inner), plus(times(area, centroid), times(-inner, at)))
        area -= inner
    if plane:
        x = unit(plus(loops[0][1], times(-1.0, loops[0][0])))
        face = model.add("FACE_SURFACE", "", bounds, model.plane(loops[0][0], normal, x), TRUE)
    else:
        face = model.add("FACE", "", bounds)
    model.faces.append(FaceFigures(face, "plane", area, centroid))
    return face


@hand("faceted_brep", "FACETED_BREP, FACE_SURFACE and POLY_LOOP; one face with a hole")
def faceted_brep():
    # A box with a square well through it.
    model = StepModel()
    outer, well = box_polygons(*BOX), box_polygons((10.0, 5.0, 0.0), (20.0, 15.0, 10.0))
    faces = [facet(model, [side], True) for side in outer[:4]]
    faces += [facet(model, [outer[k], well[k][::-1]], True) for k in (4, 5)]
    faces += [facet(model, [side[::-1]], True) for side in well[:4]]
    brep = model.add("FACETED_BREP", "", model.add("CLOSED_SHELL", "", faces))
    model.product("faceted_brep", [brep], representation="FACETED_BREP_SHAPE_REPRESENTATION")
    return model, model.reference(volume=5000.0, bbox=BOX)


@hand("faceted_brep_bare", "FACETED_BREP whose faces have no surface at all (FACE)")
def faceted_brep_bare():
    model = StepModel()
    corners = [(0.0, 0.0, 0.0), (10.0, 0.0, 0.0), (0.0, 10.0, 0.0), (0.0, 0.0, 10.0)]
    faces = [facet(model, [[corners[i] for i in side]], False) for side in [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]]
    brep = model.add("FACETED_BREP", "", model.add("CLOSED_SHELL", "", faces))
    model.product("faceted_brep_bare", [brep], representation="FACETED_BREP_SHAPE_REPRESENTATION")
    return model, model.reference(volume=1000 / 6, bbox=[[0.0] * 3, [10.0] * 3])


@hand("faceted_brep_with_voids", "FACETED_BREP and BREP_WITH_VOIDS in one complex instance, the void an oriented shell")
def faceted_brep_with_voids():
    model = StepModel()
    outer = [facet(model, [side], True) for side in box_polygons(*BOX)]
    inner = [facet(model, [side], True) for side in box_polygons((10.0, 5.0, 3.0), (20.0, 15.0, 7.0))]
    shell = model.add("CLOSED_SHELL", "", outer)
    void = model.add("ORIENTED_CLOSED_SHELL", "", DERIVED, model.add("CLOSED_SHELL", "", inner), FALSE)
    brep = model.add_complex(
        BREP_WITH_VOIDS=([void],),
        FACETED_BREP=(),
        GEOMETRIC_REPRESENTATION_ITEM=(),
        MANIFOLD_SOLID_BREP=(shell,),
        REPRESENTATION_ITEM=("",),
        SOLID_MODEL=(),
    )
    model.product("faceted_brep_with_voids", [brep], representation="FACETED_BREP_SHAPE_REPRESENTATION")
    return model, model.reference(volume=6000.0 - 400.0, bbox=BOX)


@hand("brep_with_voids_oriented", "BREP_WITH_VOIDS: an ORIENTED_CLOSED_SHELL used backward as the void")
def brep_with_voids_oriented():
    model = StepModel()
    shell = model.add("CLOSED_SHELL", "", model.box_faces(*BOX))
    ball = model.face(model.sphere(4.0, (15.0, 10.0, 5.0)), [], kind="sphere", area=64 * pi, centroid=(15.0, 10.0, 5.0))
    void = model.add("ORIENTED_CLOSED_SHELL", "", DERIVED, model.add("CLOSED_SHELL", "", [ball]), FALSE)
    model.product("brep_with_voids_oriented", [model.add("BREP_WITH_VOIDS", "", shell, [void])])
    return model, model.reference(volume=6000 - 256 * pi / 3, bbox=BOX)


@hand("face_based_surface_model", "FACE_BASED_SURFACE_MODEL over two CONNECTED_FACE_SETs, faces as FACE_SURFACE")
def face_based_surface_model():
    model = StepModel()
    sides = box_polygons(*BOX)
    first = [model.polygon_face(*sides[k], keyword="FACE_SURFACE") for k in (0, 2, 4)]
    second = [model.polygon_face(*sides[k]) for k in (1,)]
    sets = [model.add("CONNECTED_FACE_SET", "", faces) for faces in (first, second)]
    body = model.add("FACE_BASED_SURFACE_MODEL", "", sets)
    model.product("face_based_surface_model", [body], representation="NON_MANIFOLD_SURFACE_SHAPE_REPRESENTATION")
    return model, model.reference(bbox=BOX, closed=False)


@hand("shell_based_open", "SHELL_BASED_SURFACE_MODEL with an open and a closed shell")
def shell_based_open():
    model = StepModel()
    open_shell = model.add("OPEN_SHELL", "", model.box_faces(*BOX, 5))
    closed_shell = model.add("CLOSED_SHELL", "", model.box_faces((40.0, 0.0, 0.0), (50.0, 10.0, 10.0)))
    body = model.add("SHELL_BASED_SURFACE_MODEL", "", [open_shell, closed_shell])
    model.product("shell_based_open", [body], representation="MANIFOLD_SURFACE_SHAPE_REPRESENTATION")
    return model, model.reference(bbox=[[0.0, 0.0, 0.0], [50.0, 20.0, 10.0]], closed=False)


@hand("oriented_open_shell", "ORIENTED_OPEN_SHELL used backward")
def oriented_open_shell():
    model = StepModel()
    shell = model.add("OPEN_SHELL", "", model.box_faces(*BOX, 5))
    turned = model.add("ORIENTED_OPEN_SHELL", "", DERIVED, shell, FALSE)
    body = model.add("SHELL_BASED_SURFACE_MODEL", "", [turned])
    model.product("oriented_open_shell", [body], representation="MANIFOLD_SURFACE_SHAPE_REPRESENTATION")
    return model, model.reference(bbox=BOX, closed=False)


@hand("oriented_face", "a closed shell one face of which is an ORIENTED_FACE used backward")
def oriented_face():
    model = StepModel()
    sides = box_polygons(*BOX)
    faces = [model.polygon_face(*side) for side in sides[:5]]
    # The last face points inward; ORIENTED_FACE turns it.
    inward = model.polygon_face(*sides[5][::-1])
    faces.append(model.add("ORIENTED_FACE", "", DERIVED, inward, FALSE))
    model.product("oriented_face", [model.solid(faces)])
    return model, model.reference(volume=6000.0, bbox=BOX)


@hand("bounds_backward", "face bounds with orientation .F. and faces with same_sense .F., still a good box")
def bounds_backward():
    model = StepModel()
    faces = []
    for side in box_polygons(*BOX):
        area, normal, centroid = polygon_figures(side)
        x = unit(plus(side[1], times(-1.0, side[0])))
        plane = model.plane(side[0], times(-1.0, normal), x)
        bound = model.add("FACE_OUTER_BOUND", "", model.polygon(*side[::-1]), FALSE)
        face = model.add("ADVANCED_FACE", "", [bound], plane, FALSE)
        model.faces.append(FaceFigures(face, "plane", area, centroid))
        faces.append(face)
    model.product("bounds_backward", [model.solid(faces)])
    return model, model.reference(volume=6000.0, bbox=BOX)


@hand("bounds_without_outer", "a plane with holes whose bounds are all FACE_BOUND, the outer one last")
def bounds_without_outer():
    model = StepModel()
    holes = [model.loop((model.ring((x, 10.0, 0.0), Z, X, 3.0), False)) for x in (8.0, 20.0)]
    rim = model.polygon(ORIGIN, (30.0, 0.0, 0.0), (30.0, 20.0, 0.0), (0.0, 20.0, 0.0))
    area = 600 - 18 * pi
    centre = ((600 * 15 - 9 * pi * 28) / area, 10.0, 0.0)
    face = model.face(model.plane(), [*holes, rim], kind="plane", area=area, centroid=centre, outer=False)
    body = model.add("SHELL_BASED_SURFACE_MODEL", "", [model.add("OPEN_SHELL", "", [face])])
    model.product("bounds_without_outer", [body], representation="MANIFOLD_SURFACE_SHAPE_REPRESENTATION")
    return model, model.reference(bbox=[[0.0, 0.0, 0.0], [30.0, 20.0, 0.0]], closed=False)


@hand("geometric_set", "GEOMETRIC_SET with a point, a curve and a bounded surface")
def geometric_set():
    model = StepModel()
    patch = model.add("RECTANGULAR_TRIMMED_SURFACE", "", model.plane(), 0.0, 12.0, 0.0, 7.0, TRUE, TRUE)
    model.faces.append(FaceFigures(patch, "plane", 84.0, (6.0, 3.5, 0.0)))
    arc = model.add("CIRCLE", "", model.axis2((20.0, 0.0, 0.0)), 3.0)
    items = model.add("GEOMETRIC_SET", "", [model.point((5.0, 5.0, 5.0)), arc, patch])
    model.product("geometric_set", [items], representation="GEOMETRICALLY_BOUNDED_SURFACE_SHAPE_REPRESENTATION")
    reference = model.reference(bbox=[[0.0, 0.0, 0.0], [12.0, 7.0, 0.0]], closed=False)
    return model, {**reference, "free_curves": {"count": 1, "length_mm": 6 * pi}}


@hand("geometric_curve_set", "GEOMETRIC_CURVE_SET: a polyline, a whole circle, an arc and a point; no face")
def geometric_curve_set():
    model = StepModel()
    corners = [(0.0, 0.0, 0.0), (10.0, 0.0, 0.0), (10.0, 10.0, 5.0), (0.0, 10.0, 5.0)]
    polyline = model.add("POLYLINE", "", [model.point(p) for p in corners])
    circle = model.circle((20.0, 5.0, 0.0), Z, X, 5.0)
    arc = model.add(
        "TRIMMED_CURVE",
        "",
        model.circle((40.0, 5.0, 0.0), Z, X, 5.0),
        [model.point((45.0, 5.0, 0.0))],
        [model.point((40.0, 10.0, 0.0))],
        TRUE,
        Enum("CARTESIAN"),
    )
    items = model.add("GEOMETRIC_CURVE_SET", "", [polyline, circle, arc, model.point((5.0, 5.0, 20.0))])
    model.product("geometric_curve_set", [items], representation="GEOMETRICALLY_BOUNDED_WIREFRAME_SHAPE_REPRESENTATION")
    reference = model.reference(bbox=[[0.0, 0.0, 0.0], [45.0, 10.0, 5.0]], closed=False)
    length = 20 + sqrt(125) + 10 * pi + 2.5 * pi
    return model, {**reference, "free_curves": {"count": 3, "length_mm": length}}


@hand("wireframe_models", "EDGE_BASED_WIREFRAME_MODEL and SHELL_BASED_WIREFRAME_MODEL")
def wireframe_models():
    model = StepModel(schema="CONFIG_CONTROL_DESIGN")
    corners = [(0.0, 0.0, 0.0), (10.0, 0.0, 0.0), (10.0, 10.0, 0.0), (0.0, 10.0, 0.0)]
    edges = [model.straight(a, b)[0] for a, b in zip(corners, corners[1:] + corners[:1])]
    first = model.add("EDGE_BASED_WIREFRAME_MODEL", "", [model.add("CONNECTED_EDGE_SET", "", edges)])
    shifted = [plus(p, (0.0, 0.0, 5.0)) for p in corners]
    second = model.add("SHELL_BASED_WIREFRAME_MODEL", "", [model.add("WIRE_SHELL", "", [model.polygon(*shifted)])])
    model.product("wireframe_models", [first, second], representation="EDGE_BASED_WIREFRAME_SHAPE_REPRESENTATION")
    reference = model.reference(bbox=[[0.0, 0.0, 0.0], [10.0, 10.0, 5.0]], closed=False)
    return model, {**reference, "free_curves": {"count": 8, "length_mm": 80.0}}
