"""Units: per context, converted, prefixed, mixed, missing."""

from math import pi, sqrt

from catalogue import hand
from hand.assemblies import leaf, rows
from part21 import DERIVED, Enum, Typed
from step_model import ORIGIN, X, Y, Z, StepModel


def unit_box(name: str, context, scale: float, model: StepModel):
    """A box of 1 x 2 x 0.5 in the context's unit."""
    model.product(name, [model.box((0.0, 0.0, 0.0), (1.0, 2.0, 0.5))], context=context)
    return model, model.reference(volume=1.0, bbox=[[0.0] * 3, [1.0, 2.0, 0.5]], scale=scale)


@hand("unit_metre", "SI_UNIT without a prefix: metres")
def unit_metre():
    model = StepModel()
    return unit_box("unit_metre", model.context(model.si_length(None)), 1000.0, model)


@hand("unit_micrometre", "SI_UNIT with the prefix MICRO")
def unit_micrometre():
    model = StepModel()
    return unit_box("unit_micrometre", model.context(model.si_length("MICRO")), 1e-3, model)


@hand("unit_kilometre", "SI_UNIT with the prefix KILO")
def unit_kilometre():
    model = StepModel()
    return unit_box("unit_kilometre", model.context(model.si_length("KILO")), 1e6, model)


@hand("unit_inch", "CONVERSION_BASED_UNIT of 25.4 mm")
def unit_inch():
    model = StepModel()
    return unit_box("unit_inch", model.context(model.converted_length("INCH", 25.4, model.millimetre())), 25.4, model)


@hand("unit_inch_of_centimetre", "an inch given as 2.54 centimetres, named otherwise")
def unit_inch_of_centimetre():
    model = StepModel()
    unit = model.converted_length("in", 2.54, model.si_length("CENTI"))
    return unit_box("unit_inch_of_centimetre", model.context(unit), 25.4, model)


@hand("unit_foot_of_inches", "a foot of 12 inches of 25.4 mm: conversions in a chain")
def unit_foot_of_inches():
    model = StepModel()
    inch = model.converted_length("INCH", 25.4, model.millimetre())
    return unit_box("unit_foot_of_inches", model.context(model.converted_length("FOOT", 12.0, inch)), 304.8, model)


@hand("unit_measure_with_prefix", "MEASURE_WITH_UNIT as a complex instance, the factor typed POSITIVE_LENGTH_MEASURE")
def unit_measure_with_prefix():
    model = StepModel()
    base = model.si_length("MILLI")
    measure = model.add_complex(
        LENGTH_MEASURE_WITH_UNIT=(), MEASURE_WITH_UNIT=(Typed("POSITIVE_LENGTH_MEASURE", 25.4), base)
    )
    exponents = model.add("DIMENSIONAL_EXPONENTS", 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    unit = model.add_complex(CONVERSION_BASED_UNIT=("INCH", measure), LENGTH_UNIT=(), NAMED_UNIT=(exponents,))
    return unit_box("unit_measure_with_prefix", model.context(unit), 25.4, model)


@hand("unit_missing", "a context without any unit: millimetres and radians are assumed")
def unit_missing():
    model = StepModel()
    context = model.add_complex(GEOMETRIC_REPRESENTATION_CONTEXT=(3,), REPRESENTATION_CONTEXT=("", ""))
    return unit_box("unit_missing", context, 1.0, model)


@hand("unit_degree", "a cone whose half angle is given in degrees")
def unit_degree():
    model = StepModel()
    context = model.context(angle=model.degree())
    low, high = model.ring(ORIGIN, Z, X, 10.0), model.ring((0.0, 0.0, 6.0), Z, X, 16.0)
    seam = model.straight((10.0, 0.0, 0.0), (16.0, 0.0, 6.0))[0]
    wall = model.face(
        model.cone(10.0, 45.0),
        [model.loop(low, (seam, True), (high, False), (seam, False))],
        kind="cone",
        area=pi * 26 * 6 * sqrt(2),
        centroid=(0.0, 0.0, 6 * (10 + 2 * 16) / (3 * 26)),
    )
    floor = model.face(
        model.plane(axis=(0.0, 0.0, -1.0)), [model.loop((low, False))], kind="plane", area=100 * pi, centroid=ORIGIN
    )
    lid = model.face(
        model.plane((0.0, 0.0, 6.0)), [model.loop(high)], kind="plane", area=256 * pi, centroid=(0.0, 0.0, 6.0)
    )
    model.product("unit_degree", [model.solid([wall, floor, lid])], context=context)
    return model, model.reference(volume=pi * 6 * (100 + 160 + 256) / 3, bbox=[[-16.0, -16.0, 0.0], [16.0, 16.0, 6.0]])


@hand("unit_mixed", "a part in inches, in degrees, and one in millimetres, in radians, in an assembly in metres")
def unit_mixed():
    model = StepModel()
    inches = model.context(model.converted_length("INCH", 25.4, model.millimetre()), model.degree())
    metres = model.context(model.si_length(None))
    inch_part = model.product("inch cube", [model.box(ORIGIN, (1.0, 1.0, 1.0))], context=inches)
    inch_faces = len(model.faces)
    part = model.product("millimetre cube", [model.box(ORIGIN, (10.0, 10.0, 10.0))])
    top = model.product("metre", representation="SHAPE_REPRESENTATION", context=metres)
    model.place(inch_part, top, "big", (0.1, 0.0, 0.0))
    model.place(part, top, "small", (0.0, 0.2, 0.0), X, Y)
    model.place(part, top, "small again", (0.0, 0.0, 0.3))
    faces = [f.line(25.4) for f in model.faces[:inch_faces]] + [f.line() for f in model.faces[inch_faces:]]
    tree = [
        {
            "name": "metre",
            "children": [
                leaf("big", rows((100.0, 0.0, 0.0)), "inch cube"),
                leaf("small", rows((0.0, 200.0, 0.0), X, Y), "millimetre cube"),
                leaf("small again", rows((0.0, 0.0, 300.0)), "millimetre cube"),
            ],
        }
    ]
    area = 6 * 25.4**2 + 2 * 600
    reference = model.reference(
        bbox=[[0.0, 0.0, 0.0], [125.4, 210.0, 310.0]], volume=25.4**3 + 2000, solids=3, face_areas_mm2=faces, tree=tree
    )
    return model, {**reference, "area_mm2": area, "faces": 18, "colours": {"none": area}}


@hand("unit_context_per_body", "two bodies of one product in representations with different units")
def unit_context_per_body():
    model = StepModel()
    product = model.product("unit_context_per_body", [model.box(ORIGIN, (10.0, 10.0, 10.0))])
    inches = model.context(model.converted_length("INCH", 25.4, model.millimetre()))
    body = model.box((1.0, 0.0, 0.0), (2.0, 1.0, 1.0))
    other = model.add("ADVANCED_BREP_SHAPE_REPRESENTATION", "", [body], inches)
    model.add("SHAPE_REPRESENTATION_RELATIONSHIP", "", "", product.representation, other)
    faces = [f.line() for f in model.faces[:6]] + [f.line(25.4) for f in model.faces[6:]]
    area = 600 + 6 * 25.4**2
    reference = model.reference(
        bbox=[[0.0] * 3, [50.8, 25.4, 25.4]], volume=1000 + 25.4**3, solids=2, face_areas_mm2=faces
    )
    return model, {**reference, "area_mm2": area, "colours": {"none": area}}


@hand("unit_si_in_one_context", "a context that lists units nothing is measured in: seconds, kelvin, grams")
def unit_si_in_one_context():
    model = StepModel()
    second = model.add_complex(NAMED_UNIT=(DERIVED,), SI_UNIT=(None, Enum("SECOND")), TIME_UNIT=())
    gram = model.add_complex(MASS_UNIT=(), NAMED_UNIT=(DERIVED,), SI_UNIT=(None, Enum("GRAM")))
    units = [second, gram, model.radian(), model.si_length("CENTI")]
    context = model.add_complex(
        GEOMETRIC_REPRESENTATION_CONTEXT=(3,), GLOBAL_UNIT_ASSIGNED_CONTEXT=(units,), REPRESENTATION_CONTEXT=("", "")
    )
    return unit_box("unit_si_in_one_context", context, 10.0, model)
