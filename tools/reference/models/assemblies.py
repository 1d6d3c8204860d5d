"""Product trees: nesting, repetition, colours, names."""

import cadquery as cq
from OCP.Quantity import Quantity_ColorRGBA
from OCP.TCollection import TCollection_ExtendedString
from OCP.XCAFDoc import XCAFDoc_ColorSurf, XCAFDoc_DocumentTool

from catalogue import StepOptions, fixture
from xcaf import new_document, set_name


def bolt() -> cq.Workplane:
    return cq.Workplane().polygon(6, 8).extrude(3).faces("<Z").workplane().circle(2).extrude(12)


def plate() -> cq.Workplane:
    return cq.Workplane().box(40, 30, 4).faces(">Z").workplane().rect(30, 20, forConstruction=True).vertices().hole(4.4)


@fixture("assembly_flat", "two differently coloured parts, one of them turned and moved")
def assembly_flat():
    tree = cq.Assembly(name="flat")
    tree.add(plate(), name="plate", color=cq.Color(0.8, 0.1, 0.1))
    tree.add(bolt(), name="bolt", color=cq.Color(0.2, 0.3, 0.9), loc=cq.Location((15, 10, 2), (1, 1, 0), 40))
    return tree


@fixture("assembly_repeated", "one part placed four times, one product in the file")
def assembly_repeated():
    tree = cq.Assembly(name="repeated")
    tree.add(plate(), name="plate", color=cq.Color("gray"))
    screw = bolt()
    for k, (x, y) in enumerate([(-15, -10), (15, -10), (-15, 10), (15, 10)]):
        tree.add(screw, name=f"bolt {k + 1}", color=cq.Color("gold"), loc=cq.Location((x, y, 2)))
    return tree


@fixture("assembly_nested", "four levels, the inner assembly used twice, turned")
def assembly_nested():
    screw, washer = bolt(), cq.Workplane().circle(4).circle(2.1).extrude(1)
    pair = cq.Assembly(name="pair")
    pair.add(screw, name="screw", color=cq.Color("steelblue"))
    pair.add(washer, name="washer", color=cq.Color("orange"), loc=cq.Location((0, 0, -1)))
    flange = cq.Assembly(name="flange")
    flange.add(plate(), name="plate", color=cq.Color("gray"))
    flange.add(pair, name="pair left", loc=cq.Location((-15, 10, 2), (0, 0, 1), 30))
    flange.add(pair, name="pair right", loc=cq.Location((15, 10, 2), (1, 0, 0), 180))
    machine = cq.Assembly(name="machine")
    machine.add(flange, name="lower")
    machine.add(flange, name="upper", loc=cq.Location((0, 0, 40), (0, 1, 0), 90))
    return machine


@fixture("assembly_transparent", "a half transparent cover over an opaque core")
def assembly_transparent():
    tree = cq.Assembly(name="lantern")
    tree.add(cq.Workplane().sphere(6), name="core", color=cq.Color(1.0, 0.9, 0.2))
    tree.add(cq.Workplane().box(16, 16, 16).faces(">Z").shell(0.5), name="cover", color=cq.Color(0.5, 0.7, 1.0, 0.3))
    return tree


@fixture("assembly_same_names", "different parts of one name, and a part without any")
def assembly_same_names():
    document = new_document()
    tool = XCAFDoc_DocumentTool.ShapeTool_s(document.Main())
    root = tool.NewShape()
    set_name(root, "twins")
    for k, (shape, name) in enumerate(
        [
            (cq.Workplane().box(4, 4, 4), "part"),
            (cq.Workplane().sphere(3), "part"),
            (cq.Workplane().circle(2).extrude(5), ""),
        ]
    ):
        label = tool.AddShape(shape.val().wrapped, False)
        set_name(label, name)
        placed = tool.AddComponent(root, label, cq.Location((10.0 * k, 0, 0)).wrapped)
        set_name(placed, "part")
    tool.UpdateAssemblies()
    return document


def coloured_document(name: str, shape: cq.Shape, body=None, faces=()):
    """A part whose body and single faces have colours: `faces` is pairs of a face and (r, g, b, a), linear."""
    document = new_document()
    shapes = XCAFDoc_DocumentTool.ShapeTool_s(document.Main())
    colours = XCAFDoc_DocumentTool.ColorTool_s(document.Main())
    label = shapes.AddShape(shape.wrapped, False)
    set_name(label, name)
    if body:
        colours.SetColor(label, Quantity_ColorRGBA(*body), XCAFDoc_ColorSurf)
    for face, colour in faces:
        colours.SetColor(shapes.AddSubShape(label, face.wrapped), Quantity_ColorRGBA(*colour), XCAFDoc_ColorSurf)
    return document


@fixture("colour_per_face", "a box with six colours, its body's colour hidden by them all")
def colour_per_face():
    box = cq.Solid.makeBox(30, 20, 10)
    palette = [(1, 0, 0, 1), (0, 1, 0, 1), (0, 0, 1, 1), (1, 1, 0, 1), (0, 1, 1, 1), (1, 0, 1, 1)]
    return coloured_document("colour_per_face", box, (0.5, 0.5, 0.5, 1), list(zip(box.Faces(), palette)))


@fixture("colour_face_over_body", "one face red on a grey body, one face transparent")
def colour_face_over_body():
    box = cq.Workplane().box(30, 20, 10).faces(">Z").workplane().hole(6).val()
    top = cq.Workplane(box).faces(">Z").val()
    bottom = cq.Workplane(box).faces("<Z").val()
    return coloured_document(
        "colour_face_over_body", box, (0.4, 0.4, 0.4, 1), [(top, (1, 0, 0, 1)), (bottom, (0, 0.2, 0.8, 0.25))]
    )


@fixture("colour_dark_and_half", "colours whose sRGB and linear values differ most, next to black and white")
def colour_dark_and_half():
    box = cq.Solid.makeBox(10, 10, 10)
    levels = [0.0, 0.003, 0.02, 0.2, 0.5, 1.0]
    return coloured_document(
        "colour_dark_and_half", box, None, [(f, (v, v, v, 1)) for f, v in zip(box.Faces(), levels)]
    )


@fixture("colour_on_sheet", "a coloured sheet body with a face of another colour")
def colour_on_sheet():
    shell = cq.Shell.makeShell([f for f in cq.Workplane().box(30, 20, 10).faces().vals() if f.Center().z < 4.9])
    return coloured_document("colour_on_sheet", shell, (0.1, 0.6, 0.2, 1), [(shell.Faces()[0], (0.9, 0.4, 0.0, 1))])


@fixture("assembly_instance_colours", "one part placed three times, twice with a colour of its own")
def assembly_instance_colours():
    document = new_document()
    shapes = XCAFDoc_DocumentTool.ShapeTool_s(document.Main())
    colours = XCAFDoc_DocumentTool.ColorTool_s(document.Main())
    root = shapes.NewShape()
    set_name(root, "traffic light")
    lamp = shapes.AddShape(cq.Workplane().sphere(4).val().wrapped, False)
    set_name(lamp, "lamp")
    colours.SetColor(lamp, Quantity_ColorRGBA(0, 0.5, 0, 1), XCAFDoc_ColorSurf)
    for k, colour in enumerate([None, (1, 0.6, 0, 1), (1, 0, 0, 1)]):
        placed = shapes.AddComponent(root, lamp, cq.Location((0, 0, 10.0 * k)).wrapped)
        set_name(placed, ["go", "wait", "stop"][k])
        if colour:
            colours.SetColor(placed, Quantity_ColorRGBA(*colour), XCAFDoc_ColorSurf)
    shapes.UpdateAssemblies()
    return document


@fixture("assembly_mirrored", "a part and its mirror image, as OpenCASCADE writes a mirrored placement")
def assembly_mirrored():
    hand = cq.Workplane().box(20, 10, 4).faces(">Z").workplane().center(6, 2).rect(5, 3).extrude(6)
    tree = cq.Assembly(name="pair of hands")
    tree.add(hand, name="right", color=cq.Color("salmon"))
    tree.add(hand.mirror("YZ", (-15, 0, 0)), name="left", color=cq.Color("skyblue"))
    return tree


@fixture("names_unicode", "names in Greek, Chinese, with quotes, and beyond the basic plane")
def names_unicode():
    tree = cq.Assembly(name="Прибор 装置")
    for k, name in enumerate(["Größe Ø12", "歯車", "it's 'quoted'", "back\\slash", "𝔘nit 🙂"]):
        tree.add(cq.Workplane().box(4, 4, 4), name=name, loc=cq.Location((6.0 * k, 0, 0)))
    return tree


@fixture("names_unicode_ap242", "the same kind of names in AP242", step=StepOptions(schema="AP242"))
def names_unicode_ap242():
    tree = cq.Assembly(name="Καλημέρα")
    tree.add(cq.Workplane().box(4, 4, 4), name="écrou à oreilles")
    return tree


@fixture("layers", "two layers in one file")
def layers():
    document = new_document()
    shapes = XCAFDoc_DocumentTool.ShapeTool_s(document.Main())
    tool = XCAFDoc_DocumentTool.LayerTool_s(document.Main())
    root = shapes.NewShape()
    set_name(root, "layers")
    for k, layer in enumerate(["BODY", "HELPER"]):
        part = shapes.AddShape(cq.Workplane().box(5, 5, 5 + k).val().wrapped, False)
        set_name(part, f"on {layer.lower()}")
        tool.SetLayer(part, TCollection_ExtendedString(layer), False)
        shapes.AddComponent(root, part, cq.Location((8.0 * k, 0, 0)).wrapped)
    shapes.UpdateAssemblies()
    return document
