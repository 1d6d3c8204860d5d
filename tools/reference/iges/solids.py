"""Manifold solid B-rep objects (186) over vertex lists, edge lists, loops, faces and shells."""

from __future__ import annotations

from math import pi, sqrt

from iges.catalogue import iges
from iges_brep import Brep, box_solid
from iges_deck import PART
from iges_model import IgesModel
from spline_patch import Patch
from step_model import X, Z

BOX = ((0.0, 0.0, 0.0), (30.0, 20.0, 10.0))


@iges("solid_box", "a box as a solid (186) of six plane faces")
def box():
    model = IgesModel("solid_box")
    box_solid(model, *BOX)
    return model, model.reference(volume=6000.0)


@iges("solid_box_metres", "a box as a solid in a file of metres")
def box_metres():
    model = IgesModel("solid_box_metres", unit=6, unit_name="M", resolution=1e-8, largest=1.0)
    box_solid(model, (0.0, 0.0, 0.0), (0.03, 0.02, 0.01))
    return model, model.reference(volume=6e-6, scale=1000.0)


@iges("solid_box_bounds_unordered", "faces that do not say which of their loops is the outer one; one has a hole")
def box_unordered():
    model = IgesModel("solid_box_bounds_unordered")
    brep = Brep(model)
    sides = [(0.0, 0.0), (30.0, 0.0), (30.0, 20.0), (0.0, 20.0)]
    hole = [(10.0, 5.0), (10.0, 15.0), (20.0, 15.0), (20.0, 5.0)]
    faces = []
    for ring in (sides, hole):
        for (x0, y0), (x1, y1) in zip(ring, ring[1:] + ring[:1]):
            faces.append(brep.polygon((x0, y0, 0.0), (x1, y1, 0.0), (x1, y1, 10.0), (x0, y0, 10.0)))
    for z, normal in ((0.0, (0.0, 0.0, -1.0)), (10.0, Z)):
        loops = []
        for ring in (hole, sides):
            points = [(x, y, z) for x, y in ring]
            loops.append(brep.polygon_loop(*(points if z else points[::-1])))
        face = brep.face(model.flat((0.0, 0.0, z), normal), loops, outer=False)
        model.know(face, "plane", 500.0, (15.0, 10.0, z), [[0.0, 0.0, z], [30.0, 20.0, z]])
        faces.append(face)
    brep.solid(faces)
    return model, model.reference(volume=5000.0)


@iges("solid_box_faces_reversed", "a box whose shell uses each face against its surface's normal")
def box_reversed():
    model = IgesModel("solid_box_faces_reversed")
    brep = Brep(model)
    low, high = BOX
    faces = []
    for face in brep.box_faces(low, high):
        surface = model[model[face].parameters[0]]
        # The plane is turned round; the loop still runs counter-clockwise about the outward normal.
        axis = surface.parameters[1]
        direction = [-c + 0.0 for c in model[axis].parameters]
        surface.parameters[1] = model.direction(direction)
        loop = model[model[face].parameters[3]]
        turned = [loop.parameters[1 + 5 * k : 6 + 5 * k] for k in range(4)][::-1]
        for use in turned:
            use[3] = 1 - use[3]
        loop.parameters[1:] = [value for use in turned for value in use]
        faces.append((face, False))
    brep.solid(faces)
    return model, model.reference(volume=6000.0)


@iges("solid_box_with_void", "a box with a box-shaped void: a second shell that is used reversed")
def box_with_void():
    model = IgesModel("solid_box_with_void")
    outer, inner = Brep(model), Brep(model)
    void = inner.shell(inner.box_faces((10.0, 5.0, 2.0), (20.0, 15.0, 8.0)))
    outer.solid(outer.box_faces(*BOX), [(void, False)])
    return model, model.reference(volume=5400.0)


def cylinder_faces(model: IgesModel, wall: int) -> list[int]:
    """A cylinder of radius 10 and height 30 about z; its wall uses the seam twice."""
    brep = Brep(model)
    low, high = (10.0, 0.0, 0.0), (10.0, 0.0, 30.0)
    bottom = brep.edge(model.circle((0.0, 0.0), 10.0, 0.0), low, low)
    top = brep.edge(model.circle((0.0, 0.0), 10.0, 30.0), high, high)
    seam, _ = brep.straight(low, high)
    side = brep.face(wall, [brep.loop((bottom, True), (seam, True), (top, False), (seam, False))])
    model.know(side, "cylinder", 600 * pi, (0.0, 0.0, 15.0), [[-10.0, -10.0, 0.0], [10.0, 10.0, 30.0]])
    caps = []
    for z, edge, normal in ((0.0, (bottom, False), (0.0, 0.0, -1.0)), (30.0, (top, True), Z)):
        cap = brep.face(model.flat((0.0, 0.0, z), normal), [brep.loop(edge)])
        model.know(cap, "plane", 100 * pi, (0.0, 0.0, z), [[-10.0, -10.0, z], [10.0, 10.0, z]])
        caps.append(cap)
    brep.solid([side, *caps])
    return [side, *caps]


@iges("solid_cylinder_seam", "a cylinder whose wall (192) uses its seam edge twice")
def cylinder_seam():
    model = IgesModel("solid_cylinder_seam")
    cylinder_faces(model, model.elementary(192, (0.0, 0.0, 0.0), 10.0, axis=Z))
    return model, model.reference(volume=3000 * pi)


@iges("solid_cylinder_revolved", "a cylinder whose wall is a surface of revolution (120) with a seam edge")
def cylinder_revolved():
    model = IgesModel("solid_cylinder_revolved")
    axis = model.line((0.0, 0.0, 0.0), (0.0, 0.0, 1.0))
    generatrix = model.line((10.0, 0.0, -5.0), (10.0, 0.0, 35.0))
    cylinder_faces(model, model.add(120, [axis, generatrix, 0.0, 2 * pi], status=PART))
    return model, model.reference(volume=3000 * pi)


@iges("solid_sphere_two_halves", "a sphere (196) as two half faces that share the equator")
def sphere_halves():
    model = IgesModel("solid_sphere_two_halves")
    brep = Brep(model)
    start = (10.0, 0.0, 0.0)
    equator = brep.edge(model.circle((0.0, 0.0), 10.0), start, start)
    faces = []
    for side in (1.0, -1.0):
        surface = model.elementary(196, (0.0, 0.0, 0.0), 10.0, axis=Z, x=X)
        face = brep.face(surface, [brep.loop((equator, side > 0))])
        box = [[-10.0, -10.0, min(0.0, 10 * side)], [10.0, 10.0, max(0.0, 10 * side)]]
        model.know(face, "sphere", 200 * pi, (0.0, 0.0, 5.0 * side), box)
        faces.append(face)
    brep.solid(faces)
    return model, model.reference(volume=4000 / 3 * pi)


@iges("solid_sphere_with_poles", "a sphere of one face: a meridian used twice, and vertex uses at both poles")
def sphere_poles():
    model = IgesModel("solid_sphere_with_poles")
    brep = Brep(model)
    south, north = (0.0, 0.0, -10.0), (0.0, 0.0, 10.0)
    # The arc's plane is turned up: its y becomes z.
    up = model.matrix(((1.0, 0.0, 0.0, 0.0), (0.0, 0.0, -1.0, 0.0), (0.0, 1.0, 0.0, 0.0)))
    meridian = brep.edge(model.arc((0.0, 0.0), (0.0, -10.0), (0.0, 10.0), transformation=up), south, north)
    surface = model.elementary(196, (0.0, 0.0, 0.0), 10.0, axis=Z, x=X)
    loop = brep.loop(south, (meridian, True), north, (meridian, False))
    face = brep.face(surface, [loop])
    model.know(face, "sphere", 400 * pi, (0.0, 0.0, 0.0), [[-10.0] * 3, [10.0] * 3])
    brep.solid([face])
    return model, model.reference(volume=4000 / 3 * pi)


@iges("solid_cone_with_apex", "a cone (194): its wall's loop has a vertex use at the apex")
def cone_apex():
    model = IgesModel("solid_cone_with_apex")
    brep = Brep(model)
    start, apex = (6.0, 0.0, 0.0), (0.0, 0.0, 8.0)
    bottom = brep.edge(model.circle((0.0, 0.0), 6.0), start, start)
    seam, _ = brep.straight(start, apex)
    # The surface's radius grows along its axis, so that the axis points down.
    surface = model.elementary(194, (0.0, 0.0, 0.0), 6.0, 36.86989764584402, axis=(0.0, 0.0, -1.0), x=X)
    wall = brep.face(surface, [brep.loop((bottom, True), (seam, True), apex, (seam, False))])
    model.know(wall, "cone", 60 * pi, (0.0, 0.0, 8 / 3), [[-6.0, -6.0, 0.0], [6.0, 6.0, 8.0]])
    cap = brep.face(model.flat((0.0, 0.0, 0.0), (0.0, 0.0, -1.0)), [brep.loop((bottom, False))])
    model.know(cap, "plane", 36 * pi, (0.0, 0.0, 0.0), [[-6.0, -6.0, 0.0], [6.0, 6.0, 0.0]])
    brep.solid([wall, cap])
    return model, model.reference(volume=96 * pi)


@iges("solid_torus", "a torus (198) of one face whose loop is its two seams, each used twice")
def torus():
    model = IgesModel("solid_torus")
    brep = Brep(model)
    start = (20.0, 0.0, 0.0)
    around = brep.edge(model.circle((0.0, 0.0), 20.0), start, start)
    up = model.matrix(((1.0, 0.0, 0.0, 0.0), (0.0, 0.0, -1.0, 0.0), (0.0, 1.0, 0.0, 0.0)))
    across = brep.edge(model.circle((15.0, 0.0), 5.0, transformation=up), start, start)
    surface = model.elementary(198, (0.0, 0.0, 0.0), 15.0, 5.0, axis=Z, x=X)
    loop = brep.loop((around, True), (across, True), (around, False), (across, False))
    face = brep.face(surface, [loop])
    box = [[-20.0, -20.0, -5.0], [20.0, 20.0, 5.0]]
    model.know(face, "torus", 4 * pi**2 * 75, (0.0, 0.0, 0.0), box)
    brep.solid([face])
    return model, model.reference(volume=2 * pi**2 * 15 * 25)


@iges(
    "solid_quarter_cylinder", "a quarter of a cylinder with curves in the surface's parameters (128) beside the edges"
)
def quarter():
    model = IgesModel("solid_quarter_cylinder")
    brep = Brep(model)
    a, b = (10.0, 0.0), (0.0, 10.0)
    edges = {}
    for z in (0.0, 30.0):
        edges[z] = brep.edge(model.arc((0.0, 0.0), a, b, z), (*a, z), (*b, z))
    poles = [
        [(10.0, 0.0, z) for z in (0.0, 30.0)],
        [(10.0, 10.0, z) for z in (0.0, 30.0)],
        [(0.0, 10.0, z) for z in (0.0, 30.0)],
    ]
    half = sqrt(0.5)
    patch = Patch(2, 1, poles, [0.0] * 3 + [1.0] * 3, [0.0, 0.0, 1.0, 1.0], [[1.0, 1.0], [half, half], [1.0, 1.0]])
    up, up_forward = brep.straight((*b, 0.0), (*b, 30.0))
    down, down_forward = brep.straight((*a, 30.0), (*a, 0.0))
    lines = [model.line_2d(p, q) for p, q in (((0, 0), (1, 0)), ((1, 0), (1, 1)), ((1, 1), (0, 1)), ((0, 1), (0, 0)))]
    uses = [(edges[0.0], True), (up, up_forward), (edges[30.0], False), (down, down_forward)]
    loop = brep.loop(*((*use, [line]) for use, line in zip(uses, lines)))
    wall = brep.face(model.patch(patch, status=PART), [loop])
    model.know(wall, "bspline", 150 * pi, (20 / pi, 20 / pi, 15.0), [[0.0, 0.0, 0.0], [10.0, 10.0, 30.0]])
    faces = [wall]
    for p, q in ((a, (0.0, 0.0)), ((0.0, 0.0), b)):
        faces.append(brep.polygon((*p, 0.0), (*p, 30.0), (*q, 30.0), (*q, 0.0)))
    for z, normal in ((0.0, (0.0, 0.0, -1.0)), (30.0, Z)):
        sides = [brep.straight((*b, z), (0.0, 0.0, z)), brep.straight((0.0, 0.0, z), (*a, z))]
        uses = [(edges[z], True), *sides]
        if not z:
            uses = [(edge, not forward) for edge, forward in reversed(uses)]
        face = brep.face(model.flat((0.0, 0.0, z), normal), [brep.loop(*uses)])
        centre = 40 / (3 * pi)
        model.know(face, "plane", 25 * pi, (centre, centre, z), [[0.0, 0.0, z], [10.0, 10.0, z]])
        faces.append(face)
    brep.solid(faces)
    return model, model.reference(volume=750 * pi)


@iges("solids_two", "two solids in one file")
def two():
    model = IgesModel("solids_two")
    box_solid(model, *BOX)
    box_solid(model, (40.0, 0.0, 0.0), (45.0, 5.0, 5.0))
    return model, model.reference(volume=6125.0, solids=2)


@iges("shell_open", "an open shell (514 form 2) on its own: a box without its top")
def shell_open():
    model = IgesModel("shell_open")
    brep = Brep(model)
    brep.shell(brep.box_faces(*BOX, 5), form=2, status="00000000")
    return model, model.reference()


@iges("shell_open_single_face", "an open shell of one face with a hole")
def shell_single():
    model = IgesModel("shell_open_single_face")
    brep = Brep(model)
    rim = [(0.0, 0.0, 0.0), (30.0, 0.0, 0.0), (30.0, 20.0, 0.0), (0.0, 20.0, 0.0)]
    start = (19.0, 10.0, 0.0)
    hole = brep.edge(model.circle((15.0, 10.0), 4.0), start, start)
    loops = [brep.polygon_loop(*rim), brep.loop((hole, False))]
    face = brep.face(model.flat(), loops)
    model.know(face, "plane", 600 - 16 * pi, (15.0, 10.0, 0.0), [[0.0, 0.0, 0.0], [30.0, 20.0, 0.0]])
    brep.shell([face], form=2, status="00000000")
    return model, model.reference()


@iges("face_alone", "faces (510) that no shell uses, one of which calls itself dependent all the same")
def face_alone():
    model = IgesModel("face_alone")
    brep = Brep(model)
    brep.polygon((0.0, 0.0, 0.0), (30.0, 0.0, 0.0), (30.0, 20.0, 0.0), (0.0, 20.0, 0.0), status="00000000")
    brep.polygon((0.0, 0.0, 9.0), (30.0, 0.0, 9.0), (30.0, 20.0, 9.0), (0.0, 20.0, 9.0))
    return model, model.reference()


@iges("shell_closed_alone", "a closed shell (514 form 1) that no solid uses")
def shell_closed():
    model = IgesModel("shell_closed_alone")
    brep = Brep(model)
    brep.shell(brep.box_faces(*BOX), status="00000000")
    reference = model.reference(volume=6000.0)
    # A closed shell is a body to some readers, a sheet to others.
    del reference["solids"]
    return model, reference
