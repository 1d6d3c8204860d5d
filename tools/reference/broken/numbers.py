"""Numbers that are none, or that no geometry can have."""

from __future__ import annotations

import re

from broken.box import BOX, LID, OPEN, box, lid_on
from broken.expected import broken
from part21 import FALSE, UNKNOWN, Enum, Raw, Ref
from step_model import StepModel


def with_number(text: str) -> StepModel:
    """A box one coordinate of whose lid's corner is written as given; the corner belongs to three faces."""
    model = box()
    k = next(k for k, line in enumerate(model.lines) if line.endswith("=CARTESIAN_POINT('',(30.,20.,10.));"))
    model.lines[k] = model.lines[k].replace("20.", text)
    return model


for _name, _text, _words in [
    ("nan", "NaN", []),
    ("infinity", "INF", []),
    ("1e308", "1.E308", []),
    ("1e400", "1.E400", []),
    ("minus_1e308", "-1.E308", []),
    ("many_digits", "2" + "0" * 400 + ".", []),
    ("hexadecimal", "0x14", []),
]:

    @broken(f"number_{_name}.step", f"a coordinate written {_text[:12]}", [1, 2], _words)
    def number(text=_text):
        return with_number(text)


@broken("number_1e_minus_400.step", "a coordinate that is too small for a double: it is zero", [0, 1], [])
def number_small():
    model = box()
    model.lines = [re.sub(r"\(0\.,0\.,0\.\)", "(1.E-400,0.,0.)", line) for line in model.lines]
    return model


@broken("radius_huge.step", "a lid on a sphere of radius 1e308", [1], [], OPEN)
def radius_huge():
    return lid_on(lambda model: model.sphere(1e308))


@broken("radius_negative.step", "a lid on a cylinder of radius -5", [0, 1], [], OPEN)
def radius_negative():
    return lid_on(lambda model: model.cylinder(-5.0))


@broken("radius_zero.step", "a lid on a sphere of radius 0", [1], [], OPEN)
def radius_zero():
    return lid_on(lambda model: model.sphere(0.0))


@broken("cone_of_90_degrees.step", "a lid on a cone that opens by half a turn", [0, 1], [], OPEN)
def cone_of_90_degrees():
    return lid_on(lambda model: model.cone(1.0, 1.5707963267948966))


@broken("direction_zero.step", "a lid on a plane whose normal is zero", [0, 1], [], OPEN)
def direction_zero():
    return lid_on(lambda model: model.plane(LID[0], (0.0, 0.0, 0.0)))


@broken("unit_zero.step", "a unit of length that is zero millimetres", [0, 1, 2], ["unit"])
def unit_zero():
    model = StepModel()
    model.product(
        "box", [model.box(*BOX)], context=model.context(model.converted_length("NIL", 0.0, model.millimetre()))
    )
    return model


def spline(degrees=(3, 3), counts=((4, 4), (4, 4)), knots=((0.0, 1.0), (0.0, 1.0)), rows=4, columns=4, weights=None):
    """Writes a B-spline surface under the lid, with whatever is asked for."""

    def surface(model: StepModel) -> Ref:
        poles = [[model.point((10.0 * i, 20.0 * j / 3, 10.0)) for j in range(columns)] for i in range(rows)]
        kind = Enum("UNSPECIFIED")
        base = (*degrees, poles, kind, FALSE, FALSE, UNKNOWN)
        tail = ([*counts[0]], [*counts[1]], [*knots[0]], [*knots[1]], kind)
        if weights is None:
            return model.add("B_SPLINE_SURFACE_WITH_KNOTS", "", *base, *tail)
        return model.add_complex(
            BOUNDED_SURFACE=(),
            B_SPLINE_SURFACE=base,
            B_SPLINE_SURFACE_WITH_KNOTS=tail,
            GEOMETRIC_REPRESENTATION_ITEM=(),
            RATIONAL_B_SPLINE_SURFACE=(weights,),
            REPRESENTATION_ITEM=("",),
            SURFACE=(),
        )

    return surface


SPLINES = {
    "knots_decreasing": ("knots that fall", {"knots": ((1.0, 0.0), (0.0, 1.0))}),
    "knots_all_equal": ("knots that are all the same", {"knots": ((0.5, 0.5), (0.0, 1.0))}),
    "knots_nan": ("a knot that is not a number", {"knots": ((0.0, Raw("NaN")), (0.0, 1.0))}),
    "multiplicity_sum": (
        "multiplicities that do not add up",
        {"counts": ((4, 2, 1), (4, 4)), "knots": ((0.0, 0.5, 1.0), (0.0, 1.0))},
    ),
    "multiplicity_zero": ("a multiplicity of zero", {"counts": ((0, 8), (4, 4))}),
    "multiplicity_negative": ("a multiplicity of -4", {"counts": ((-4, 12), (4, 4))}),
    "multiplicity_huge": ("a multiplicity of four thousand million", {"counts": ((4000000000, 4), (4, 4))}),
    "degree_huge": ("a degree of two thousand million", {"degrees": (2000000000, 3)}),
    "degree_zero": ("degree zero", {"degrees": (0, 3)}),
    "degree_negative": ("degree -3", {"degrees": (-3, 3)}),
    "degree_above_poles": ("more degree than poles", {"degrees": (9, 3)}),
    "one_pole": ("a single row of poles", {"rows": 1}),
    "no_poles": ("no poles at all", {"rows": 0}),
    "knots_and_counts_differ": ("three knots, two multiplicities", {"knots": ((0.0, 0.5, 1.0), (0.0, 1.0))}),
    "weights_zero": ("weights that are all zero", {"weights": [[0.0] * 4] * 4}),
    "weights_negative": ("weights of changing sign: a pole at infinity", {"weights": [[1.0, -1.0, 1.0, -1.0]] * 4}),
    "weights_too_few": ("fewer weights than poles", {"weights": [[1.0] * 3] * 2}),
}

for _name, (_shows, _options) in SPLINES.items():

    @broken(f"spline_{_name}.step", f"a lid on a B-spline with {_shows}", [0, 1], [], OPEN)
    def spline_file(options=_options):
        return lid_on(spline(**options))


@broken("spline_poles_ragged.step", "a lid on a B-spline whose rows of poles differ in length", [1], [], OPEN)
def spline_poles_ragged():
    def surface(model: StepModel) -> Ref:
        poles = [[model.point((10.0 * i, 5.0 * j, 10.0)) for j in range(4 - i % 2)] for i in range(4)]
        kind = Enum("UNSPECIFIED")
        return model.add(
            "B_SPLINE_SURFACE_WITH_KNOTS",
            "",
            3,
            3,
            poles,
            kind,
            FALSE,
            FALSE,
            UNKNOWN,
            [4, 4],
            [4, 4],
            [0.0, 1.0],
            [0.0, 1.0],
            kind,
        )

    return lid_on(surface)
