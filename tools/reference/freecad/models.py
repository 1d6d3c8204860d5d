"""Models made in FreeCAD 0.20: `freecadcmd models.py </dev/null`, with the folder to write to in TRIMLOOP_OUT.

Each function returns the objects to export from a document of its own. STEP files carry the objects' labels; meshes are
MeshPart's, over all of a document's placed shapes.
"""

import math
import os
import traceback

import FreeCAD
import Import
import MeshPart
import Part
from FreeCAD import Placement, Rotation, Vector

OUT = os.environ["TRIMLOOP_OUT"]
MODELS = {}


def model(shows):
    """Registers a function as the maker of the model of its name."""

    def register(make):
        MODELS[make.__name__] = (make, shows)
        return make

    return register


def feature(document, name, shape):
    """An object that holds a fixed shape."""
    thing = document.addObject("Part::Feature", name)
    thing.Shape = shape
    return thing


@model("a tube, a prism and a wedge of Part, as three roots")
def primitives(document):
    tube = Part.makeCylinder(10, 25).cut(Part.makeCylinder(7, 25))
    prism = document.addObject("Part::Prism", "Prism")
    prism.Polygon, prism.Circumradius, prism.Height = 7, 8, 12
    prism.Placement = Placement(Vector(30, 0, 0), Rotation())
    wedge = document.addObject("Part::Wedge", "Wedge")
    wedge.Placement = Placement(Vector(-30, 0, 0), Rotation(Vector(0, 0, 1), 30))
    return [feature(document, "Tube", tube), prism, wedge]


@model("Part's ellipsoid: a stretched sphere as B-splines")
def ellipsoid(document):
    thing = document.addObject("Part::Ellipsoid", "Ellipsoid")
    thing.Radius1, thing.Radius2, thing.Radius3 = 4, 10, 7
    return [thing]


@model("part of Part's ellipsoid, 250 degrees round, from -30 to 60 degrees of latitude")
def ellipsoid_partial(document):
    thing = document.addObject("Part::Ellipsoid", "Ellipsoid")
    thing.Radius1, thing.Radius2, thing.Radius3 = 4, 10, 7
    thing.Angle1, thing.Angle2, thing.Angle3 = -30, 60, 250
    return [thing]


@model("part of Part's torus, in both directions")
def torus_partial(document):
    thing = document.addObject("Part::Torus", "Torus")
    thing.Radius1, thing.Radius2 = 15, 4
    thing.Angle1, thing.Angle2, thing.Angle3 = -120, 100, 280
    return [thing]


@model("a bolt with a cut thread")
def thread(document):
    helix = Part.makeLongHelix(2.0, 8.0, 5.0)
    corner = [Vector(5.3, 0, -0.75), Vector(4.2, 0, -0.1), Vector(4.2, 0, 0.1), Vector(5.3, 0, 0.75)]
    profile = Part.makePolygon([*corner, corner[0]])
    groove = Part.Wire(helix).makePipeShell([profile], True, True)
    rod = Part.makeCylinder(5, 14, Vector(0, 0, -3))
    return [feature(document, "Bolt", rod.cut(groove))]


@model("a ruled surface between two splines")
def ruled_surface(document):
    first = Part.BSplineCurve()
    first.interpolate([Vector(0, 0, 0), Vector(10, 4, 2), Vector(20, -3, 1), Vector(30, 0, 0)])
    second = Part.BSplineCurve()
    second.interpolate([Vector(0, 20, 5), Vector(12, 22, -4), Vector(30, 18, 3)])
    return [feature(document, "Ruled", Part.makeRuledSurface(first.toShape(), second.toShape()))]


@model("a loft over three profiles with different numbers of corners")
def loft(document):
    sections = []
    for z, corners, radius in ((0, 4, 10), (12, 6, 7), (25, 8, 9)):
        turn = [2 * math.pi * k / corners for k in range(corners)]
        points = [Vector(radius * math.cos(a), radius * math.sin(a), z) for a in turn]
        sections.append(Part.makePolygon([*points, points[0]]))
    return [feature(document, "Loft", Part.makeLoft(sections, True, False))]


@model("a pipe along a rounded path, swept with round corners, hollow")
def sweep(document):
    path = [Vector(0, 0, 0), Vector(0, 0, 20), Vector(0, 25, 20)]
    line = Part.makePolygon(path)
    outer = line.makePipeShell([Part.Wire(Part.makeCircle(4))], True, False, 2)
    inner = line.makePipeShell([Part.Wire(Part.makeCircle(3))], True, False, 2)
    return [feature(document, "Pipe", outer.cut(inner))]


@model("a rational B-spline surface interpolated through a grid, as a sheet")
def interpolated_surface(document):
    grid = [[Vector(5 * i, 5 * j, 3 * math.sin(0.9 * i) * math.cos(0.7 * j)) for j in range(6)] for i in range(6)]
    surface = Part.BSplineSurface()
    surface.interpolate(grid)
    surface.setWeight(3, 3, 4.0)
    return [feature(document, "Sheet", surface.toShape())]


@model("Bézier curves of degree 2 to 5 as the rim of a plate")
def bezier_plate(document):
    corners = [Vector(0, 0, 0), Vector(30, 0, 0), Vector(34, 22, 0), Vector(-4, 20, 0)]
    edges = []
    for k, degree in enumerate((2, 3, 4, 5)):
        start, end = corners[k], corners[(k + 1) % 4]
        out = (end - start).cross(Vector(0, 0, 1)).normalize()
        poles = [start + (end - start) * (i / degree) + out * (3 if i % 2 else -1) for i in range(1, degree)]
        curve = Part.BezierCurve()
        curve.setPoles([start, *poles, end])
        edges.append(curve.toShape())
    face = Part.Face(Part.Wire(edges))
    return [feature(document, "Plate", face.extrude(Vector(0, 0, 4)))]


@model("fillets of growing radius, and chamfers, on one block")
def fillets(document):
    block = Part.makeBox(30, 20, 12)
    upright = [e for e in block.Edges if abs(e.tangentAt(e.FirstParameter).z) > 0.9]
    block = block.makeFillet(1.0, 4.0, upright[:2])
    low = [e for e in block.Edges if e.BoundBox.ZMax < 1e-6]
    return [feature(document, "Block", block.makeChamfer(0.8, low))]


@model("an offset shell: a thick-walled half open vessel")
def thickness(document):
    cone = Part.makeCone(12, 7, 20)
    lid = max(cone.Faces, key=lambda face: face.CenterOfMass.z)
    return [feature(document, "Vessel", cone.makeThickness([lid], -1.5, 1e-4))]


@model("nested App::Part groups with one part linked three times")
def assembly(document):
    pin = feature(document, "Pin", Part.makeCylinder(2, 12))
    plate = feature(document, "Plate", Part.makeBox(30, 20, 3, Vector(-15, -10, -3)))
    inner = document.addObject("App::Part", "Pins")
    inner.addObject(pin)
    for k, (x, y) in enumerate([(10, 0), (0, 6)]):
        link = document.addObject("App::Link", f"Pin_{k + 2}")
        link.LinkedObject = pin
        link.LinkPlacement = Placement(Vector(x, y, 0), Rotation(Vector(1, 0, 0), 20 * k))
        inner.addObject(link)
    outer = document.addObject("App::Part", "Machine")
    outer.addObject(plate)
    outer.addObject(inner)
    inner.Placement = Placement(Vector(1, 2, 0), Rotation(Vector(0, 0, 1), 15))
    return [outer]


def export(name, make):
    """Writes one model's STEP, STL and OBJ files."""
    document = FreeCAD.newDocument(name)
    things = make(document)
    document.recompute()
    Import.export(things, os.path.join(OUT, name + ".step"))
    shape = Part.makeCompound([Part.getShape(thing) for thing in things])
    deflection = 0.003 * shape.BoundBox.DiagonalLength
    mesh = MeshPart.meshFromShape(Shape=shape, LinearDeflection=deflection, AngularDeflection=0.6, Relative=False)
    for extension in ("stl", "obj"):
        mesh.write(os.path.join(OUT, f"{name}.{extension}"))
    FreeCAD.closeDocument(name)


wanted = os.environ.get("TRIMLOOP_NAMES", "").split()
for name, (make, shows) in MODELS.items():
    if wanted and name not in wanted:
        continue
    try:
        export(name, make)
        print(f"MADE\t{name}\t{shows}")
    except Exception:
        traceback.print_exc()
        print(f"FAILED\t{name}\t{shows}")
