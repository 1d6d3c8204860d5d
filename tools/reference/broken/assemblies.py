"""Placements and usages that lead nowhere."""

from __future__ import annotations


from broken.box import BOX, WHOLE
from broken.expected import broken
from part21 import Ref
from step_model import ORIGIN, X, StepModel


@broken("transformation_singular.step", "a mapping target whose axes lie in one plane", [0, 1], [])
def transformation_singular():
    model = StepModel()
    context, axes = model.default_context(), model.axis2()
    shape = model.add("ADVANCED_BREP_SHAPE_REPRESENTATION", "", [axes, model.box(*BOX)], context)
    map_ = model.add("REPRESENTATION_MAP", axes, shape)
    flat = [model.direction(d) for d in (X, X, X)]
    target = model.add(
        "CARTESIAN_TRANSFORMATION_OPERATOR_3D", "", "", flat[0], flat[1], model.point(ORIGIN), 1.0, flat[2]
    )
    model.product("box", [model.add("MAPPED_ITEM", "", map_, target)], representation="SHAPE_REPRESENTATION")
    return model


@broken("transformation_scale_zero.step", "a transformation operator with scale 0", [0, 1, 2], [])
def transformation_scale_zero():
    model = StepModel()
    context, axes = model.default_context(), model.axis2()
    shape = model.add("ADVANCED_BREP_SHAPE_REPRESENTATION", "", [axes, model.box(*BOX)], context)
    map_ = model.add("REPRESENTATION_MAP", axes, shape)
    target = model.add("CARTESIAN_TRANSFORMATION_OPERATOR_3D", "", "", None, None, model.point(ORIGIN), 0.0, None)
    model.product("box", [model.add("MAPPED_ITEM", "", map_, target)], representation="SHAPE_REPRESENTATION")
    return model


@broken("usage_of_missing_product.step", "an assembly whose second child is not defined", [0, 1], ["#99999"], WHOLE)
def usage_of_missing_product():
    model = StepModel()
    part = model.product("box", [model.box(*BOX)])
    top = model.product("top", representation="SHAPE_REPRESENTATION")
    model.place(part, top, "box")
    model.add("NEXT_ASSEMBLY_USAGE_OCCURRENCE", "2", "ghost", "", top.definition, Ref(99999), None)
    return model
