"""Models written by hand: a few words over `Part21` for geometry, topology and products, and the reference beside them."""

from __future__ import annotations

from dataclasses import dataclass
from math import dist, pi

from part21 import DERIVED, TRUE, Enum, Part21, Ref, Typed, logical

Point = tuple[float, float, float]
X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
ORIGIN = (0.0, 0.0, 0.0)

AP203 = "CONFIG_CONTROL_DESIGN"
AP214 = "AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }"
AP242 = "AP242_MANAGED_MODEL_BASED_3D_ENGINEERING_MIM_LF { 1 0 10303 442 1 1 4 }"


def plus(*vectors) -> Point:
    """The sum of vectors."""
    return tuple(sum(parts) for parts in zip(*vectors))


def times(factor: float, vector) -> Point:
    """A vector times a number."""
    return tuple(factor * part for part in vector)


def cross(a, b) -> Point:
    """The cross product."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


@dataclass
class FaceFigures:
    """What is known of one face."""

    entity: Ref
    surface: str
    area: float
    centroid: Point | None

    def line(self, scale: float = 1.0) -> dict:
        entry = {"entity": f"#{int(self.entity)}", "surface": self.surface, "area_mm2": self.area * scale**2}
        if self.centroid is not None:
            entry["centroid_mm"] = [scale * c for c in self.centroid]
        return entry


@dataclass
class Product:
    """The entities of one product that others refer to."""

    name: str
    definition: Ref
    shape_definition: Ref
    representation: Ref
    #: The placement at the origin that the representation lists first.
    axes: Ref
    context: Ref


class StepModel(Part21):
    """A STEP file that grows, and the figures of what is in it."""

    def __init__(self, schema: str = AP214, description: str = ""):
        super().__init__(schema, description)
        self.faces: list[FaceFigures] = []
        self.products: list[str] = []
        self._cache: dict = {}

    # Geometry

    def point(self, p) -> Ref:
        return self._once("CARTESIAN_POINT", "", tuple(float(c) for c in p))

    def direction(self, d) -> Ref:
        return self._once("DIRECTION", "", tuple(float(c) for c in d))

    def vector(self, d, length: float = 1.0) -> Ref:
        return self.add("VECTOR", "", self.direction(d), float(length))

    def axis1(self, origin, axis) -> Ref:
        return self.add("AXIS1_PLACEMENT", "", self.point(origin), self.direction(axis))

    def axis2(self, origin=ORIGIN, axis=Z, x=X) -> Ref:
        return self.add("AXIS2_PLACEMENT_3D", "", self.point(origin), self.direction(axis), self.direction(x))

    def axis2_2d(self, origin=(0.0, 0.0), x=(1.0, 0.0)) -> Ref:
        return self.add("AXIS2_PLACEMENT_2D", "", self.point(origin), self.direction(x))

    def line(self, start, end) -> Ref:
        """The line from `start` towards `end`, with its parameter measured in the unit of length."""
        length = dist(start, end)
        return self.add("LINE", "", self.point(start), self.vector(times(1 / length, plus(end, times(-1.0, start)))))

    def circle(self, origin, axis, x, radius: float) -> Ref:
        return self.add("CIRCLE", "", self.axis2(origin, axis, x), float(radius))

    def plane(self, origin=ORIGIN, axis=Z, x=X) -> Ref:
        return self.add("PLANE", "", self.axis2(origin, axis, x))

    def cylinder(self, radius: float, origin=ORIGIN, axis=Z, x=X) -> Ref:
        return self.add("CYLINDRICAL_SURFACE", "", self.axis2(origin, axis, x), float(radius))

    def cone(self, radius: float, angle: float, origin=ORIGIN, axis=Z, x=X) -> Ref:
        return self.add("CONICAL_SURFACE", "", self.axis2(origin, axis, x), float(radius), float(angle))

    def sphere(self, radius: float, origin=ORIGIN, axis=Z, x=X) -> Ref:
        return self.add("SPHERICAL_SURFACE", "", self.axis2(origin, axis, x), float(radius))

    def torus(self, major: float, minor: float, origin=ORIGIN, axis=Z, x=X) -> Ref:
        return self.add("TOROIDAL_SURFACE", "", self.axis2(origin, axis, x), float(major), float(minor))

    # Topology

    def vertex(self, p) -> Ref:
        return self._once("VERTEX_POINT", "", self.point(p))

    def edge(self, start, end, curve: Ref, same_sense: bool = True) -> Ref:
        return self.add("EDGE_CURVE", "", self.vertex(start), self.vertex(end), curve, logical(same_sense))

    def straight(self, start, end) -> tuple[Ref, bool]:
        """The one straight edge between two points, and whether it runs from `start` to `end`."""
        key = ("straight", tuple(start), tuple(end))
        if ("straight", tuple(end), tuple(start)) in self._cache:
            return self._cache["straight", tuple(end), tuple(start)], False
        if key not in self._cache:
            self._cache[key] = self.edge(start, end, self.line(start, end))
        return self._cache[key], True

    def ring(self, origin, axis, x, radius: float) -> Ref:
        """An edge that is a whole circle, from its point at angle zero round to itself."""
        start = plus(origin, times(radius, x))
        return self.edge(start, start, self.circle(origin, axis, x, radius))

    def loop(self, *uses) -> Ref:
        """An edge loop; each use is an edge, or an edge and whether it is used forward."""
        oriented = []
        for use in uses:
            edge, forward = use if isinstance(use, tuple) else (use, True)
            oriented.append(self.add("ORIENTED_EDGE", "", DERIVED, DERIVED, edge, logical(forward)))
        return self.add("EDGE_LOOP", "", oriented)

    def polygon(self, *points) -> Ref:
        """A loop of straight edges."""
        return self.loop(*(self.straight(a, b) for a, b in zip(points, points[1:] + points[:1])))

    def vertex_loop(self, p) -> Ref:
        return self.add("VERTEX_LOOP", "", self.vertex(p))

    def face(
        self,
        surface: Ref,
        loops,
        *,
        kind: str,
        area: float,
        centroid: Point | None = None,
        same_sense: bool = True,
        keyword: str = "ADVANCED_FACE",
        outer: bool = True,
    ) -> Ref:
        """A face; the first of `loops` is called the outer one unless `outer` is false."""
        bounds = [
            self.add("FACE_OUTER_BOUND" if outer and i == 0 else "FACE_BOUND", "", loop, TRUE)
            for i, loop in enumerate(loops)
        ]
        face = self.add(keyword, "", bounds, surface, logical(same_sense))
        self.faces.append(FaceFigures(face, kind, area, centroid))
        return face

    def polygon_face(self, *points, **options) -> Ref:
        """A plane face over a polygon that runs counter-clockwise seen from its outer side."""
        area, normal, centroid = polygon_figures(points)
        x = unit(plus(points[1], times(-1.0, points[0])))
        plane = self.plane(points[0], normal, x)
        return self.face(plane, [self.polygon(*points)], kind="plane", area=area, centroid=centroid, **options)

    def box_faces(self, low, high, count: int = 6) -> list[Ref]:
        """The first faces of a box, outward, in the order low x, high x, low y, high y, low z, high z."""
        (x0, y0, z0), (x1, y1, z1) = low, high
        corner = [(x, y, z) for x in (x0, x1) for y in (y0, y1) for z in (z0, z1)]
        sides = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
        return [self.polygon_face(*(corner[i] for i in side)) for side in sides[:count]]

    def solid(self, faces, name: str = "") -> Ref:
        return self.add("MANIFOLD_SOLID_BREP", name, self.add("CLOSED_SHELL", "", list(faces)))

    def box(self, low, high, name: str = "") -> Ref:
        return self.solid(self.box_faces(low, high), name)

    # Contexts

    def millimetre(self) -> Ref:
        return self.si_length("MILLI")

    def si_length(self, prefix: str | None) -> Ref:
        return self.add_complex(
            LENGTH_UNIT=(), NAMED_UNIT=(DERIVED,), SI_UNIT=(Enum(prefix) if prefix else None, Enum("METRE"))
        )

    def radian(self) -> Ref:
        return self.add_complex(NAMED_UNIT=(DERIVED,), PLANE_ANGLE_UNIT=(), SI_UNIT=(None, Enum("RADIAN")))

    def converted_length(self, name: str, factor: float, base: Ref) -> Ref:
        """A unit of length that is `factor` times another."""
        measure = self.add("LENGTH_MEASURE_WITH_UNIT", Typed("LENGTH_MEASURE", float(factor)), base)
        exponents = self.add("DIMENSIONAL_EXPONENTS", 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
        return self.add_complex(CONVERSION_BASED_UNIT=(name, measure), LENGTH_UNIT=(), NAMED_UNIT=(exponents,))

    def degree(self) -> Ref:
        measure = self.add("PLANE_ANGLE_MEASURE_WITH_UNIT", Typed("PLANE_ANGLE_MEASURE", pi / 180), self.radian())
        exponents = self.add("DIMENSIONAL_EXPONENTS", 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
        return self.add_complex(CONVERSION_BASED_UNIT=("DEGREE", measure), NAMED_UNIT=(exponents,), PLANE_ANGLE_UNIT=())

    def context(self, length: Ref | None = None, angle: Ref | None = None, uncertainty: float | None = 1e-6) -> Ref:
        """A representation context; millimetres and radians where nothing else is said."""
        length = length or self._keep("millimetre", self.millimetre)
        angle = angle or self._keep("radian", self.radian)
        solid_angle = self._keep(
            "steradian",
            lambda: self.add_complex(NAMED_UNIT=(DERIVED,), SI_UNIT=(None, Enum("STERADIAN")), SOLID_ANGLE_UNIT=()),
        )
        parts: dict = {"GEOMETRIC_REPRESENTATION_CONTEXT": (3,)}
        if uncertainty is not None:
            measure = self.add(
                "UNCERTAINTY_MEASURE_WITH_UNIT",
                Typed("LENGTH_MEASURE", uncertainty),
                length,
                "distance_accuracy_value",
                "",
            )
            parts["GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT"] = ([measure],)
        parts["GLOBAL_UNIT_ASSIGNED_CONTEXT"] = ([length, angle, solid_angle],)
        parts["REPRESENTATION_CONTEXT"] = ("", "")
        return self.add_complex(**parts)

    def default_context(self) -> Ref:
        return self._keep("context", self.context)

    def parameter_context(self) -> Ref:
        """The context of curves in a surface's parameters."""
        return self._keep(
            "2d",
            lambda: self.add_complex(
                GEOMETRIC_REPRESENTATION_CONTEXT=(2,),
                PARAMETRIC_REPRESENTATION_CONTEXT=(),
                REPRESENTATION_CONTEXT=("", ""),
            ),
        )

    def pcurve(self, surface: Ref, curve_2d: Ref) -> Ref:
        definition = self.add("DEFINITIONAL_REPRESENTATION", "", [curve_2d], self.parameter_context())
        return self.add("PCURVE", "", surface, definition)

    def line_2d(self, start, end) -> Ref:
        """A line in parameters whose own parameter runs from 0 at `start` to the distance at `end`."""
        return self.line(start, end)

    # Products

    def product(
        self,
        name: str,
        items=(),
        *,
        representation: str = "ADVANCED_BREP_SHAPE_REPRESENTATION",
        context: Ref | None = None,
        product_id: str | None = None,
    ) -> Product:
        """A product whose shape is `items`."""
        context = context or self.default_context()
        axes = self.axis2()
        shape = self.add(representation, name, [axes, *items], context)
        return self.product_of(name, shape, axes, context, product_id)

    def product_of(self, name: str, shape: Ref, axes: Ref, context: Ref, product_id: str | None = None) -> Product:
        """A product whose shape is an existing representation."""
        application = self._keep(
            "application",
            lambda: self.add("APPLICATION_CONTEXT", "core data for automotive mechanical design processes"),
        )
        product = self.add(
            "PRODUCT",
            name if product_id is None else product_id,
            name,
            "",
            [self._keep("mechanical", lambda: self.add("PRODUCT_CONTEXT", "", application, "mechanical"))],
        )
        formation = self.add("PRODUCT_DEFINITION_FORMATION", "", "", product)
        definition = self.add(
            "PRODUCT_DEFINITION",
            "design",
            "",
            formation,
            self._keep(
                "part", lambda: self.add("PRODUCT_DEFINITION_CONTEXT", "part definition", application, "design")
            ),
        )
        shape_definition = self.add("PRODUCT_DEFINITION_SHAPE", "", "", definition)
        self.add("SHAPE_DEFINITION_REPRESENTATION", shape_definition, shape)
        self.products.append(name or product_id or "")
        return Product(name, definition, shape_definition, shape, axes, context)

    def place(self, child: Product, parent: Product, name: str, origin=ORIGIN, axis=Z, x=X) -> Ref:
        """Puts a child into a parent: usage occurrence, item-defined transformation, context-dependent shape."""
        usage = self.add("NEXT_ASSEMBLY_USAGE_OCCURRENCE", name, name, "", parent.definition, child.definition, None)
        shape = self.add("PRODUCT_DEFINITION_SHAPE", "Placement", "", usage)
        target = self.axis2(origin, axis, x)
        transform = self.add("ITEM_DEFINED_TRANSFORMATION", "", "", child.axes, target)
        relation = self.add_complex(
            REPRESENTATION_RELATIONSHIP=("", "", child.representation, parent.representation),
            REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION=(transform,),
            SHAPE_REPRESENTATION_RELATIONSHIP=(),
        )
        self.add("CONTEXT_DEPENDENT_SHAPE_REPRESENTATION", relation, shape)
        return usage

    # The reference

    def reference(
        self,
        *,
        bbox,
        volume: float | None = None,
        closed: bool | None = None,
        solids: int | None = None,
        scale: float = 1.0,
        **more,
    ) -> dict:
        """The reference of a file with one product; `scale` is the file's unit in millimetres."""
        area = sum(face.area for face in self.faces) * scale**2
        closed = volume is not None if closed is None else closed
        figures = {
            "area_mm2": area,
            "volume_mm3": None if volume is None else volume * scale**3,
            "bbox_mm": None if bbox is None else [[scale * c for c in corner] for corner in bbox],
            "closed": closed,
            "solids": (1 if volume is not None else 0) if solids is None else solids,
            "faces": len(self.faces),
            "face_areas_mm2": [face.line(scale) for face in self.faces],
            "colours": {"none": area},
        }
        if len(self.products) == 1:
            figures["tree"] = [{"name": self.products[0]}]
            part = {key: figures[key] for key in ("solids", "faces", "closed", "area_mm2", "volume_mm3")}
            figures["parts"] = [{"name": self.products[0], "instances": 1, **part}]
        return {**figures, **more}

    def _once(self, keyword: str, *parameters) -> Ref:
        key = (keyword, parameters)
        return self._keep(key, lambda: self.add(keyword, *parameters))

    def _keep(self, key, make) -> Ref:
        if key not in self._cache:
            self._cache[key] = make()
        return self._cache[key]


def unit(vector) -> Point:
    """A vector of length one."""
    return times(1 / dist(vector, (0.0,) * len(vector)), vector)


def polygon_figures(points) -> tuple[float, Point, Point]:
    """Area, normal and centroid of a plane polygon."""
    total, moment = ORIGIN, ORIGIN
    fans = []
    for b, c in zip(points[1:], points[2:]):
        n = cross(plus(b, times(-1.0, points[0])), plus(c, times(-1.0, points[0])))
        total = plus(total, n)
        fans.append((n, times(1 / 3, plus(points[0], b, c))))
    normal = unit(total)
    area = sum(n * t for n, t in zip(normal, total)) / 2
    for n, centre in fans:
        signed = sum(a * b for a, b in zip(n, normal)) / 2
        moment = plus(moment, times(signed / area, centre))
    return area, normal, moment
