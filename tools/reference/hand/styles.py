"""Colours, transparency, visibility and layers in the forms that files use."""

from __future__ import annotations

from catalogue import hand
from hand.assemblies import leaf, rows
from part21 import Enum, Ref, Typed
from step_model import AP242, ORIGIN, Z, StepModel

BOX = [[0.0, 0.0, 0.0], [30.0, 20.0, 10.0]]
RED, GREEN, BLUE, GREY = (1.0, 0.0, 0.0), (0.0, 0.6, 0.2), (0.0, 0.2, 1.0), (0.6, 0.6, 0.6)
#: Areas of the sides of the box, in the order of `box_faces`.
SIDES = [200.0, 200.0, 300.0, 300.0, 600.0, 600.0]


def hexadecimal(colour, alpha: float = 1.0) -> str:
    return "#" + "".join(f"{round(255 * c):02x}" for c in (*colour, alpha))


def colour_rgb(model: StepModel, colour) -> Ref:
    return model.add("COLOUR_RGB", "", *map(float, colour))


def fill(model: StepModel, colour: Ref) -> Ref:
    area = model.add("FILL_AREA_STYLE", "", [model.add("FILL_AREA_STYLE_COLOUR", "", colour)])
    return model.add("SURFACE_STYLE_FILL_AREA", area)


def assignment(model: StepModel, *elements, side: str = "BOTH") -> Ref:
    """A presentation style from the elements of a surface's side."""
    sides = model.add("SURFACE_SIDE_STYLE", "", list(elements))
    return model.add("PRESENTATION_STYLE_ASSIGNMENT", [model.add("SURFACE_STYLE_USAGE", Enum(side), sides)])


def paint(model: StepModel, item: Ref, colour, **options) -> Ref:
    return model.add(
        "STYLED_ITEM", "color", [assignment(model, fill(model, colour_rgb(model, colour)), **options)], item
    )


def present(model: StepModel, *styled) -> None:
    """Gathers styled items, as most files do."""
    model.add("MECHANICAL_DESIGN_GEOMETRIC_PRESENTATION_REPRESENTATION", "", list(styled), model.default_context())


def boxed(model: StepModel, name: str):
    """A box as product; returns its solid, shell, faces and product."""
    faces = model.box_faces(*BOX)
    shell = model.add("CLOSED_SHELL", "", faces)
    solid = model.add("MANIFOLD_SOLID_BREP", name, shell)
    return solid, shell, faces, model.product(name, [solid])


def reference(model: StepModel, colours: dict, **more) -> dict:
    return {**model.reference(volume=6000.0, bbox=BOX), "colours": colours, **more}


@hand("style_face_over_solid", "one face red on a blue solid; the edges' own curve style must not show on the faces")
def style_face_over_solid():
    model = StepModel()
    solid, _, faces, _ = boxed(model, "style_face_over_solid")
    font = model.add("DRAUGHTING_PRE_DEFINED_CURVE_FONT", "continuous")
    curve = model.add("CURVE_STYLE", "", font, Typed("POSITIVE_LENGTH_MEASURE", 0.1), colour_rgb(model, GREEN))
    lines = model.add("STYLED_ITEM", "", [model.add("PRESENTATION_STYLE_ASSIGNMENT", [curve])], faces[0])
    present(model, paint(model, solid, BLUE), paint(model, faces[5], RED), lines)
    return model, reference(model, {hexadecimal(BLUE): 1600.0, hexadecimal(RED): 600.0})


@hand("style_shell_between", "solid grey, its shell blue, one face red: the innermost wins")
def style_shell_between():
    model = StepModel()
    solid, shell, faces, _ = boxed(model, "style_shell_between")
    present(model, paint(model, faces[4], RED), paint(model, shell, BLUE), paint(model, solid, GREY))
    return model, reference(model, {hexadecimal(BLUE): 1600.0, hexadecimal(RED): 600.0})


@hand("style_product", "the whole shape representation is styled")
def style_product():
    model = StepModel()
    _, _, faces, product = boxed(model, "style_product")
    present(model, paint(model, product.representation, GREEN), paint(model, faces[0], RED))
    return model, reference(model, {hexadecimal(GREEN): 2000.0, hexadecimal(RED): 200.0})


@hand("style_over_riding", "OVER_RIDING_STYLED_ITEM: a face's blue stands over its earlier red")
def style_over_riding():
    model = StepModel()
    solid, _, faces, _ = boxed(model, "style_over_riding")
    base = paint(model, solid, GREY)
    first = paint(model, faces[5], RED)
    style = assignment(model, fill(model, colour_rgb(model, BLUE)))
    over = model.add("OVER_RIDING_STYLED_ITEM", "", [style], faces[5], first)
    green = assignment(model, fill(model, colour_rgb(model, GREEN)))
    second = model.add("OVER_RIDING_STYLED_ITEM", "", [green], faces[0], base)
    present(model, base, first, over, second)
    colours = {hexadecimal(GREY): 1400.0, hexadecimal(BLUE): 600.0, hexadecimal(GREEN): 200.0}
    return model, reference(model, colours)


@hand(
    "style_transparent", "SURFACE_STYLE_RENDERING_WITH_PROPERTIES with SURFACE_STYLE_TRANSPARENT 0.6, on one face 1.0"
)
def style_transparent():
    model = StepModel()
    solid, _, faces, _ = boxed(model, "style_transparent")

    def glass(colour, transparency: float) -> Ref:
        rgb = colour_rgb(model, colour)
        clear = model.add("SURFACE_STYLE_TRANSPARENT", transparency)
        rendering = model.add("SURFACE_STYLE_RENDERING_WITH_PROPERTIES", Enum("NORMAL_SHADING"), rgb, [clear])
        return assignment(model, fill(model, rgb), rendering)

    present(
        model,
        model.add("STYLED_ITEM", "", [glass(BLUE, 0.6)], solid),
        model.add("STYLED_ITEM", "", [glass(RED, 0.25)], faces[0]),
    )
    return model, reference(model, {hexadecimal(BLUE, 0.4): 2000.0, hexadecimal(RED, 0.75): 200.0})


@hand("style_rendering_only", "SURFACE_STYLE_RENDERING gives the colour; there is no fill area style")
def style_rendering_only():
    model = StepModel()
    solid, _, _, _ = boxed(model, "style_rendering_only")
    rendering = model.add("SURFACE_STYLE_RENDERING", Enum("NORMAL_SHADING"), colour_rgb(model, GREEN))
    present(model, model.add("STYLED_ITEM", "", [assignment(model, rendering)], solid))
    return model, reference(model, {hexadecimal(GREEN): 2200.0})


@hand("style_predefined_colours", "DRAUGHTING_PRE_DEFINED_COLOUR: the eight names")
def style_predefined_colours():
    model = StepModel()
    solid, _, faces, _ = boxed(model, "style_predefined_colours")
    named = {
        "red": (1, 0, 0),
        "green": (0, 1, 0),
        "blue": (0, 0, 1),
        "yellow": (1, 1, 0),
        "magenta": (1, 0, 1),
        "cyan": (0, 1, 1),
    }
    styled = []
    for face, name in zip(faces, named):
        colour = model.add("DRAUGHTING_PRE_DEFINED_COLOUR", name)
        styled.append(model.add("STYLED_ITEM", "", [assignment(model, fill(model, colour))], face))
    colour = model.add("DRAUGHTING_PRE_DEFINED_COLOUR", "black")
    styled.append(model.add("STYLED_ITEM", "", [assignment(model, fill(model, colour))], solid))
    present(model, *styled)
    return model, reference(model, {hexadecimal(c): area for c, area in zip(named.values(), SIDES)})


@hand("style_one_side", "surface style usages for the positive and the negative side; the outer (positive) one is seen")
def style_one_side():
    model = StepModel()
    solid, _, _, _ = boxed(model, "style_one_side")
    usages = []
    for side, colour in (("NEGATIVE", RED), ("POSITIVE", GREEN)):
        sides = model.add("SURFACE_SIDE_STYLE", "", [fill(model, colour_rgb(model, colour))])
        usages.append(model.add("SURFACE_STYLE_USAGE", Enum(side), sides))
    style = model.add("PRESENTATION_STYLE_ASSIGNMENT", usages)
    present(model, model.add("STYLED_ITEM", "", [style], solid))
    return model, reference(model, {hexadecimal(GREEN): 2200.0})


@hand("style_null", "a NULL_STYLE beside the real one, and a styled item without any style")
def style_null():
    model = StepModel()
    solid, _, faces, _ = boxed(model, "style_null")
    nothing = model.add("PRESENTATION_STYLE_ASSIGNMENT", [Typed("NULL_STYLE", Enum("NULL"))])
    style = assignment(model, fill(model, colour_rgb(model, BLUE)))
    present(model, model.add("STYLED_ITEM", "", [nothing, style], solid), model.add("STYLED_ITEM", "", [], faces[0]))
    return model, reference(model, {hexadecimal(BLUE): 2200.0})


@hand("style_invisible", "INVISIBILITY hides the second of two solids")
def style_invisible():
    model = StepModel()
    shown, hidden = model.box(*BOX), model.box((40.0, 0.0, 0.0), (50.0, 10.0, 10.0))
    model.product("style_invisible", [shown, hidden])
    styles = [paint(model, shown, BLUE), paint(model, hidden, RED)]
    present(model, *styles)
    model.add("INVISIBILITY", [styles[1]])
    return model, hidden_reference(model, 6, {hexadecimal(BLUE): 2200.0})


def hidden_reference(model: StepModel, count: int, colours: dict) -> dict:
    """The reference of what is shown: the last `count` faces are hidden, and listed apart."""
    faces = model.faces
    model.faces = faces[:-count]
    figures = model.reference(volume=6000.0, bbox=BOX)
    lines = [face.line() for face in faces[-count:]]
    return {**figures, "colours": colours, "hidden_faces": lines}


@hand("style_layers", "PRESENTATION_LAYER_ASSIGNMENT of two solids; the layer of the second is invisible")
def style_layers():
    model = StepModel()
    shown, hidden = model.box(*BOX), model.box((40.0, 0.0, 0.0), (50.0, 10.0, 10.0))
    model.product("style_layers", [shown, hidden])
    model.add("PRESENTATION_LAYER_ASSIGNMENT", "BODY", "what is made", [shown])
    helpers = model.add("PRESENTATION_LAYER_ASSIGNMENT", "HELPER", "", [hidden])
    model.add("INVISIBILITY", [helpers])
    return model, {**hidden_reference(model, 6, {"none": 2200.0}), "layers": ["BODY", "HELPER"]}


@hand("style_instance", "CONTEXT_DEPENDENT_OVER_RIDING_STYLED_ITEM: the second of three instances is red")
def style_instance():
    name = "style_instance"
    model = StepModel(AP242)
    part_faces = model.box_faces(*BOX)
    solid = model.solid(part_faces)
    part = model.product("brick", [solid])
    base = paint(model, solid, GREY)
    top = model.product(name, representation="SHAPE_REPRESENTATION")
    for k in range(3):
        model.place(part, top, f"brick {k}", (40.0 * k, 0.0, 0.0))
    relations = [ref for ref, keyword in model.keywords.items() if keyword == "CONTEXT_DEPENDENT_SHAPE_REPRESENTATION"]
    style = assignment(model, fill(model, colour_rgb(model, RED)))
    over = model.add("CONTEXT_DEPENDENT_OVER_RIDING_STYLED_ITEM", "", [style], solid, base, [relations[1]])
    present(model, base, over)
    placements = [rows((40.0 * k, 0.0, 0.0), Z) for k in range(3)]
    tree = [{"name": name, "children": [leaf(f"brick {k}", m) for k, m in enumerate(placements)]}]
    figures = model.reference(volume=18000.0, bbox=[[0.0, 0.0, 0.0], [110.0, 20.0, 10.0]], solids=3)
    colours = {hexadecimal(GREY): 4400.0, hexadecimal(RED): 2200.0}
    return model, {**figures, "area_mm2": 6600.0, "faces": 18, "colours": colours, "tree": tree}


@hand("style_mapped_item", "a styled MAPPED_ITEM: one use of a body is red, the other takes the body's grey")
def style_mapped_item():
    model = StepModel()
    context = model.default_context()
    axes = model.axis2()
    solid = model.box(*BOX)
    body = model.add("ADVANCED_BREP_SHAPE_REPRESENTATION", "body", [axes, solid], context)
    map_ = model.add("REPRESENTATION_MAP", axes, body)
    uses = [model.add("MAPPED_ITEM", "", map_, model.axis2((40.0 * k, 0.0, 0.0))) for k in range(2)]
    model.product("style_mapped_item", uses, representation="SHAPE_REPRESENTATION")
    present(model, paint(model, solid, GREY), paint(model, uses[1], RED))
    figures = model.reference(volume=12000.0, bbox=[[0.0, 0.0, 0.0], [70.0, 20.0, 10.0]], solids=2)
    colours = {hexadecimal(GREY): 2200.0, hexadecimal(RED): 2200.0}
    return model, {**figures, "area_mm2": 4400.0, "faces": 12, "colours": colours}


@hand("style_sheet", "a styled SHELL_BASED_SURFACE_MODEL")
def style_sheet():
    model = StepModel()
    shell = model.add("OPEN_SHELL", "", model.box_faces(*BOX, 5))
    body = model.add("SHELL_BASED_SURFACE_MODEL", "", [shell])
    model.product("style_sheet", [body], representation="MANIFOLD_SURFACE_SHAPE_REPRESENTATION")
    present(model, paint(model, body, GREEN))
    return model, {**model.reference(bbox=BOX, closed=False), "colours": {hexadecimal(GREEN): 1600.0}}


@hand("style_curves", "free curves with colours of their own")
def style_curves():
    model = StepModel()
    line = model.add("POLYLINE", "", [model.point(ORIGIN), model.point((10.0, 0.0, 0.0))])
    circle = model.circle((0.0, 0.0, 5.0), Z, (1.0, 0.0, 0.0), 4.0)
    items = model.add("GEOMETRIC_CURVE_SET", "", [line, circle])
    model.product("style_curves", [items], representation="GEOMETRICALLY_BOUNDED_WIREFRAME_SHAPE_REPRESENTATION")
    font = model.add("DRAUGHTING_PRE_DEFINED_CURVE_FONT", "continuous")
    for item, colour in ((line, RED), (circle, BLUE)):
        style = model.add("CURVE_STYLE", "", font, Typed("POSITIVE_LENGTH_MEASURE", 0.1), colour_rgb(model, colour))
        present(model, model.add("STYLED_ITEM", "", [model.add("PRESENTATION_STYLE_ASSIGNMENT", [style])], item))
    figures = model.reference(bbox=[[-4.0, -4.0, 0.0], [10.0, 4.0, 5.0]], closed=False)
    lengths = {hexadecimal(RED): 10.0, hexadecimal(BLUE): 8 * 3.141592653589793}
    return model, {
        **figures,
        "colours": {},
        "free_curves": {"count": 2, "length_mm": sum(lengths.values()), "colours": lengths},
    }
