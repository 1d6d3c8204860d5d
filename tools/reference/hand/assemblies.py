"""Product trees in the forms that CAD systems write and OpenCASCADE does not."""

from __future__ import annotations

from math import pi

from catalogue import hand
from part21 import Enum, Ref
from step_model import ORIGIN, X, Y, Z, Product, StepModel, cross

MINUS_X = (-1.0, 0.0, 0.0)
#: The part that is placed: a box in a corner, so that every turn and mirror shows.
LOW, HIGH = (1.0, 2.0, 3.0), (5.0, 4.0, 9.0)
AREA, VOLUME = 2 * (8.0 + 24.0 + 12.0), 48.0

Rows = list[list[float]]


def rows(origin=ORIGIN, axis=Z, x=X, scale: float = 1.0) -> Rows:
    """A placement's three rows: turned axes as columns, then the origin."""
    y = cross(axis, x)
    return [[scale * x[i], scale * y[i], scale * axis[i], origin[i]] for i in range(3)]


def times(a: Rows, b: Rows) -> Rows:
    """The placement that applies b, then a."""
    return [
        [sum(a[i][k] * b[k][j] for k in range(3)) + (a[i][3] if j == 3 else 0.0) for j in range(4)] for i in range(3)
    ]


def placed_box(placements) -> list:
    """The box around all placed parts."""
    corner = [(x, y, z) for x in (LOW[0], HIGH[0]) for y in (LOW[1], HIGH[1]) for z in (LOW[2], HIGH[2])]
    points = [[sum(m[i][k] * c[k] for k in range(3)) + m[i][3] for i in range(3)] for m in placements for c in corner]
    return [[min(p[i] for p in points) for i in range(3)], [max(p[i] for p in points) for i in range(3)]]


def box_part(model: StepModel, name: str = "brick", **options) -> Product:
    return model.product(name, [model.box(LOW, HIGH)], **options)


def reference(model: StepModel, tree, placements, scales=None, name: str = "brick") -> dict:
    """The reference of an assembly of equal boxes, placed in the world by `placements`."""
    scales = scales or [1.0] * len(placements)
    figures = model.reference(bbox=placed_box(placements), volume=VOLUME)
    area = AREA * sum(s**2 for s in scales)
    volume = VOLUME * sum(s**3 for s in scales)
    count = len(placements)
    part = {
        "name": name,
        "instances": count,
        "solids": 1,
        "faces": 6,
        "closed": True,
        "area_mm2": AREA,
        "volume_mm3": VOLUME,
    }
    return {
        **figures,
        "area_mm2": area,
        "volume_mm3": volume,
        "solids": count,
        "faces": 6 * count,
        "colours": {"none": area},
        "tree": tree,
        "parts": [part],
    }


def leaf(instance: str, placement: Rows, name: str = "brick") -> dict:
    return {"name": name, "instance": instance, "placement_mm": placement}


@hand("assembly_usage", "NEXT_ASSEMBLY_USAGE_OCCURRENCE with an item-defined transformation; one part placed twice")
def assembly_usage():
    model = StepModel()
    part = box_part(model)
    top = model.product("wall", representation="SHAPE_REPRESENTATION")
    model.place(part, top, "brick one", (10.0, 0.0, 0.0))
    model.place(part, top, "brick two", (0.0, 20.0, 5.0), X, Y)
    placements = [rows((10.0, 0.0, 0.0)), rows((0.0, 20.0, 5.0), X, Y)]
    tree = [{"name": "wall", "children": [leaf("brick one", placements[0]), leaf("brick two", placements[1])]}]
    return model, reference(model, tree, placements)


@hand(
    "assembly_usage_swapped",
    "the relationship names parent before child, with the transformation's items swapped likewise",
)
def assembly_usage_swapped():
    model = StepModel()
    part = box_part(model)
    top = model.product("wall", representation="SHAPE_REPRESENTATION")
    usage = model.add("NEXT_ASSEMBLY_USAGE_OCCURRENCE", "1", "brick", "", top.definition, part.definition, None)
    shape = model.add("PRODUCT_DEFINITION_SHAPE", "", "", usage)
    target = model.axis2((10.0, 5.0, 0.0), Z, Y)
    transform = model.add("ITEM_DEFINED_TRANSFORMATION", "", "", target, part.axes)
    relation = model.add_complex(
        REPRESENTATION_RELATIONSHIP=("", "", top.representation, part.representation),
        REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION=(transform,),
        SHAPE_REPRESENTATION_RELATIONSHIP=(),
    )
    model.add("CONTEXT_DEPENDENT_SHAPE_REPRESENTATION", relation, shape)
    placement = rows((10.0, 5.0, 0.0), Z, Y)
    return model, reference(model, [{"name": "wall", "children": [leaf("brick", placement)]}], [placement])


@hand("assembly_part_axes", "the part's own placement is not at its origin: the transformation maps axes onto axes")
def assembly_part_axes():
    # Moves what stands at the part's axes (origin 1,2,3, x along y) onto the target's.
    model = StepModel()
    context = model.default_context()
    source = model.axis2(LOW, Z, Y)
    shape = model.add("ADVANCED_BREP_SHAPE_REPRESENTATION", "", [source, model.box(LOW, HIGH)], context)
    part = model.product_of("brick", shape, source, context)
    top = model.product("wall", representation="SHAPE_REPRESENTATION")
    model.place(part, top, "brick", (10.0, 0.0, 0.0), Z, X)
    # Source frame: x' = y, y' = -x. The placement is target times the inverse of source.
    placement = [[0.0, 1.0, 0.0, 10.0 - 2.0], [-1.0, 0.0, 0.0, 1.0], [0.0, 0.0, 1.0, -3.0]]
    return model, reference(model, [{"name": "wall", "children": [leaf("brick", placement)]}], [placement])


@hand("assembly_nested_usage", "three levels, the middle one used twice; every level turned")
def assembly_nested_usage():
    model = StepModel()
    part = box_part(model)
    middle = model.product("row", representation="SHAPE_REPRESENTATION")
    top = model.product("wall", representation="SHAPE_REPRESENTATION")
    inner = [((10.0, 0.0, 0.0), Z, X), ((20.0, 0.0, 0.0), Z, Y)]
    outer = [((0.0, 0.0, 0.0), Z, X), ((0.0, 30.0, 7.0), X, Z)]
    for k, (origin, axis, x) in enumerate(inner):
        model.place(part, middle, f"brick {k}", origin, axis, x)
    for k, (origin, axis, x) in enumerate(outer):
        model.place(middle, top, f"row {k}", origin, axis, x)
    children = [leaf(f"brick {k}", rows(*p)) for k, p in enumerate(inner)]
    tree = [
        {
            "name": "wall",
            "children": [
                {"name": "row", "instance": f"row {k}", "placement_mm": rows(*p), "children": children}
                for k, p in enumerate(outer)
            ],
        }
    ]
    return model, reference(model, tree, [times(rows(*o), rows(*i)) for o in outer for i in inner])


@hand("assembly_deep", "twenty levels of one child each, every one moved by 1 mm and turned by a quarter")
def assembly_deep():
    model = StepModel()
    below = box_part(model)
    step = ((1.0, 0.0, 0.0), Z, Y)
    node = leaf("use 0", rows(*step))
    total = rows(*step)
    for level in range(1, 21):
        above = model.product(f"level {level}", representation="SHAPE_REPRESENTATION")
        model.place(below, above, f"use {level - 1}", *step)
        if level == 20:
            tree = [{"name": "level 20", "children": [node]}]
        else:
            node = {
                "name": f"level {level}",
                "instance": f"use {level}",
                "placement_mm": rows(*step),
                "children": [node],
            }
            total = times(rows(*step), total)
        below = above
    return model, reference(model, tree, [total])


def mapped(model: StepModel, source: Product, target: Ref) -> Ref:
    """A MAPPED_ITEM that puts a product's representation at a placement or transformation operator."""
    key = ("map", source.representation)
    map_ = model._keep(key, lambda: model.add("REPRESENTATION_MAP", source.axes, source.representation))
    return model.add("MAPPED_ITEM", "", map_, target)


def operator(model: StepModel, origin=ORIGIN, x=X, y=Y, z=Z, scale: float | None = None) -> Ref:
    """A CARTESIAN_TRANSFORMATION_OPERATOR_3D."""
    return model.add(
        "CARTESIAN_TRANSFORMATION_OPERATOR_3D",
        "",
        "",
        model.direction(x),
        model.direction(y),
        model.point(origin),
        scale,
        model.direction(z),
    )


def mapped_assembly(name: str, targets, placements, scales=None):
    """One part placed by mapped items only; `targets` write the mapping targets."""
    model = StepModel()
    part = box_part(model)
    items = [mapped(model, part, target(model)) for target in targets]
    top = model.product(name, items, representation="SHAPE_REPRESENTATION")
    for k in range(len(targets)):
        model.add("NEXT_ASSEMBLY_USAGE_OCCURRENCE", str(k), f"use {k}", "", top.definition, part.definition, None)
    tree = [{"name": name, "children": [leaf(f"use {k}", m) for k, m in enumerate(placements)]}]
    return model, reference(model, tree, placements, scales)


@hand("assembly_mapped", "MAPPED_ITEMs whose targets are AXIS2_PLACEMENT_3Ds, usages without a shape of their own")
def assembly_mapped():
    placements = [((10.0, 0.0, 0.0), Z, X), ((0.0, 15.0, 0.0), X, Y)]
    targets = [lambda model, p=p: model.axis2(*p) for p in placements]
    return mapped_assembly("assembly_mapped", targets, [rows(*p) for p in placements])


@hand("assembly_mapped_operator", "MAPPED_ITEM with a CARTESIAN_TRANSFORMATION_OPERATOR_3D that turns and moves")
def assembly_mapped_operator():
    placement = [[0.0, -1.0, 0.0, 10.0], [1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 1.0, 2.0]]
    target = lambda model: operator(model, (10.0, 0.0, 2.0), Y, MINUS_X, Z)  # noqa: E731
    return mapped_assembly("assembly_mapped_operator", [target], [placement])


@hand("assembly_mapped_scaled", "a transformation operator with scale 2, beside one without")
def assembly_mapped_scaled():
    targets = [
        lambda model: operator(model, (20.0, 0.0, 0.0), scale=2.0),
        lambda model: operator(model, (0.0, 0.0, 20.0), scale=1.0),
    ]
    placements = [rows((20.0, 0.0, 0.0), scale=2.0), rows((0.0, 0.0, 20.0))]
    return mapped_assembly("assembly_mapped_scaled", targets, placements, [2.0, 1.0])


@hand("assembly_mapped_mirrored", "a transformation operator whose axes are left-handed: a mirror image")
def assembly_mapped_mirrored():
    targets = [
        lambda model: operator(model, (20.0, 0.0, 0.0)),
        lambda model: operator(model, (-20.0, 0.0, 0.0), MINUS_X, Y, Z),
    ]
    mirrored = [[-1.0, 0.0, 0.0, -20.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]]
    return mapped_assembly("assembly_mapped_mirrored", targets, [rows((20.0, 0.0, 0.0)), mirrored])


@hand("assembly_mapped_in_part", "one product without an assembly: its body is a MAPPED_ITEM used three times")
def assembly_mapped_in_part():
    model = StepModel()
    context = model.default_context()
    axes = model.axis2()
    body = model.add("ADVANCED_BREP_SHAPE_REPRESENTATION", "body", [axes, model.box(LOW, HIGH)], context)
    map_ = model.add("REPRESENTATION_MAP", axes, body)
    placements = [((10.0 * k, 0.0, 0.0), Z, X) for k in range(3)]
    items = [model.add("MAPPED_ITEM", "", map_, model.axis2(*p)) for p in placements]
    model.product("assembly_mapped_in_part", items, representation="SHAPE_REPRESENTATION")
    figures = reference(model, [{"name": "assembly_mapped_in_part"}], [rows(*p) for p in placements])
    # Whether the body becomes one part placed three times or three bodies of one part is the importer's choice.
    del figures["parts"]
    return model, figures


@hand("assembly_shape_relationship", "the product's SHAPE_REPRESENTATION is empty; a relationship leads to the solid's")
def assembly_shape_relationship():
    model = StepModel()
    product = model.product("brick", representation="SHAPE_REPRESENTATION")
    shape = model.add("ADVANCED_BREP_SHAPE_REPRESENTATION", "", [model.box(LOW, HIGH)], product.context)
    model.add("SHAPE_REPRESENTATION_RELATIONSHIP", "", "", product.representation, shape)
    return model, reference(model, [{"name": "brick"}], [rows()])


@hand("assembly_shape_relationship_swapped", "the same with the relationship's ends swapped, in an assembly")
def assembly_shape_relationship_swapped():
    model = StepModel()
    product = model.product("brick", representation="SHAPE_REPRESENTATION")
    shape = model.add("ADVANCED_BREP_SHAPE_REPRESENTATION", "", [model.box(LOW, HIGH)], product.context)
    model.add("SHAPE_REPRESENTATION_RELATIONSHIP", "", "", shape, product.representation)
    top = model.product("wall", representation="SHAPE_REPRESENTATION")
    model.place(product, top, "brick", (3.0, 0.0, 0.0))
    placement = rows((3.0, 0.0, 0.0))
    return model, reference(model, [{"name": "wall", "children": [leaf("brick", placement)]}], [placement])


@hand("assembly_several_roots", "three products that are in no assembly, one of them an assembly")
def assembly_several_roots():
    model = StepModel()
    part = box_part(model)
    top = model.product("wall", representation="SHAPE_REPRESENTATION")
    model.place(part, top, "brick", (10.0, 0.0, 0.0))
    ball = model.face(model.sphere(3.0, (-10.0, 0.0, 0.0)), [], kind="sphere", area=36 * pi, centroid=(-10.0, 0.0, 0.0))
    model.product("ball", [model.solid([ball])])
    plate = [(0.0, 0.0, -5.0), (4.0, 0.0, -5.0), (4.0, 4.0, -5.0), (0.0, 4.0, -5.0)]
    shell = model.add("OPEN_SHELL", "", [model.polygon_face(*plate)])
    body = model.add("SHELL_BASED_SURFACE_MODEL", "", [shell])
    model.product("plate", [body], representation="MANIFOLD_SURFACE_SHAPE_REPRESENTATION")
    area = AREA + 36 * pi + 16
    tree = [{"name": "wall", "children": [leaf("brick", rows((10.0, 0.0, 0.0)))]}, {"name": "ball"}, {"name": "plate"}]
    figures = model.reference(
        bbox=[[-13.0, -3.0, -5.0], [15.0, 4.0, 9.0]], volume=VOLUME + 36 * pi, closed=False, solids=2
    )
    return model, {**figures, "area_mm2": area, "tree": tree}


@hand(
    "assembly_products_without_shape", "an assembly with a child that has no shape at all, and one whose shape is empty"
)
def assembly_products_without_shape():
    model = StepModel()
    part = box_part(model)
    top = model.product("wall", representation="SHAPE_REPRESENTATION")
    hollow = model.product("empty", representation="SHAPE_REPRESENTATION")
    model.place(part, top, "brick", (10.0, 0.0, 0.0))
    model.place(hollow, top, "empty", (0.0, 0.0, 7.0))
    application = model.add("APPLICATION_CONTEXT", "")
    product = model.add("PRODUCT", "ghost", "ghost", "", [model.add("PRODUCT_CONTEXT", "", application, "")])
    formation = model.add("PRODUCT_DEFINITION_FORMATION_WITH_SPECIFIED_SOURCE", "", "", product, Enum("NOT_KNOWN"))
    context = model.add("PRODUCT_DEFINITION_CONTEXT", "", application, "")
    ghost = model.add("PRODUCT_DEFINITION_WITH_ASSOCIATED_DOCUMENTS", "", "", formation, context, [])
    model.add("NEXT_ASSEMBLY_USAGE_OCCURRENCE", "g", "ghost", "", top.definition, ghost, "R12")
    children = [
        leaf("brick", rows((10.0, 0.0, 0.0))),
        leaf("empty", rows((0.0, 0.0, 7.0)), "empty"),
        leaf("ghost", rows(), "ghost"),
    ]
    return model, reference(model, [{"name": "wall", "children": children}], [rows((10.0, 0.0, 0.0))])


@hand("assembly_two_bodies_one_product", "one product definition with two shape representations")
def assembly_two_bodies_one_product():
    model = StepModel()
    product = box_part(model)
    other = model.add(
        "ADVANCED_BREP_SHAPE_REPRESENTATION",
        "",
        [product.axes, model.box((11.0, 2.0, 3.0), (15.0, 4.0, 9.0))],
        product.context,
    )
    model.add("SHAPE_DEFINITION_REPRESENTATION", product.shape_definition, other)
    figures = model.reference(volume=2 * VOLUME, bbox=[list(LOW), [15.0, 4.0, 9.0]], solids=2)
    return model, {**figures, "tree": [{"name": "brick"}]}


@hand(
    "assembly_instance_names", "occurrences named by id, by name, by both, by neither; products with an id but no name"
)
def assembly_instance_names():
    model = StepModel()
    part = model.product("", [model.box(LOW, HIGH)], product_id="4711-B")
    top = model.product("rack", representation="SHAPE_REPRESENTATION", product_id="R1")
    names = [("left", ""), ("", "right"), ("NAUO7", "middle"), ("", "")]
    placements = []
    for k, (usage_id, name) in enumerate(names):
        usage = model.add("NEXT_ASSEMBLY_USAGE_OCCURRENCE", usage_id, name, "", top.definition, part.definition, None)
        shape = model.add("PRODUCT_DEFINITION_SHAPE", "", "", usage)
        origin = (10.0 * k, 0.0, 0.0)
        transform = model.add("ITEM_DEFINED_TRANSFORMATION", "", "", part.axes, model.axis2(origin))
        relation = model.add_complex(
            REPRESENTATION_RELATIONSHIP=("", "", part.representation, top.representation),
            REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION=(transform,),
            SHAPE_REPRESENTATION_RELATIONSHIP=(),
        )
        model.add("CONTEXT_DEPENDENT_SHAPE_REPRESENTATION", relation, shape)
        placements.append(rows(origin))
    shown = ["left", "right", "middle", None]
    children = []
    for instance, placement in zip(shown, placements):
        node = leaf(instance or "", placement, "4711-B")
        if instance is None:
            del node["instance"]
        children.append(node)
    return model, reference(model, [{"name": "rack", "children": children}], placements, name="4711-B")
