"""Boundary representations in IGES: vertex lists, edge lists, loops, faces, shells, solids."""

from __future__ import annotations

from iges_deck import PART
from iges_model import IgesModel, around, box_sides
from step_model import cross, plus, polygon_figures, times, unit


class Brep:
    """Topology over one vertex list (502) and one edge list (504), which grow."""

    def __init__(self, model: IgesModel):
        self.model = model
        self.vertices = model.add(502, [0], form=1, status=PART)
        self.edges = model.add(504, [0], form=1, status=PART)
        self._points: list = []
        self._straight: dict = {}

    def vertex(self, p) -> int:
        """The number of the vertex at a point."""
        p = tuple(map(float, p))
        if p not in self._points:
            self._points.append(p)
            parameters = self.model[self.vertices].parameters
            parameters[0] += 1
            parameters += p
        return self._points.index(p) + 1

    def edge(self, curve: int, start, end) -> int:
        """The number of a new edge."""
        ends = [self.vertices, self.vertex(start), self.vertices, self.vertex(end)]
        parameters = self.model[self.edges].parameters
        parameters[0] += 1
        parameters += [curve, *ends]
        return parameters[0]

    def straight(self, start, end) -> tuple[int, bool]:
        """The one straight edge between two points, and whether it runs from `start` to `end`."""
        start, end = tuple(map(float, start)), tuple(map(float, end))
        if (end, start) in self._straight:
            return self._straight[end, start], False
        if (start, end) not in self._straight:
            self._straight[start, end] = self.edge(self.model.line(start, end), start, end)
        return self._straight[start, end], True

    def loop(self, *uses) -> int:
        """Type 508; each use is (edge, forward) or the point of a vertex."""
        values = [len(uses)]
        for use in uses:
            if not isinstance(use[1], bool):
                values += [1, self.vertices, self.vertex(use), 1, 0]
            else:
                edge, forward, *parameters = use
                curves = parameters[0] if parameters else []
                values += [0, self.edges, edge, int(forward), len(curves)]
                values += [value for curve in curves for value in (0, curve)]
        return self.model.add(508, values, form=1, status=PART)

    def polygon_loop(self, *points) -> int:
        return self.loop(*(self.straight(a, b) for a, b in zip(points, (*points[1:], points[0]))))

    def face(self, surface: int, loops, *, outer: bool = True, **options) -> int:
        """Type 510; the first loop is the outer one where `outer` says so."""
        values = [surface, len(loops), int(outer), *loops]
        return self.model.add(510, values, form=1, **{"status": PART, **options})

    def polygon(self, *points, holes=(), **options) -> int:
        """A plane face, counter-clockwise seen from outside."""
        area, normal, centroid = polygon_figures(points)
        loops = [self.polygon_loop(*points), *(self.polygon_loop(*hole) for hole in holes)]
        face = self.face(self.model.flat(points[0], normal), loops, **options)
        if not holes:
            self.model.know(face, "plane", area, centroid, around([points]))
        return face

    def box_faces(self, low, high, count: int = 6, **options) -> list[int]:
        return [self.polygon(*side, **options) for side in box_sides(low, high)[:count]]

    def shell(self, faces, form: int = 1, **options) -> int:
        """Type 514 (form 1 closed, 2 open); each face is a pointer, or a pointer and its sense."""
        values = [len(faces)]
        for face in faces:
            entity, sense = face if isinstance(face, tuple) else (face, True)
            values += [entity, int(sense)]
        return self.model.add(514, values, form=form, **{"status": PART, **options})

    def solid(self, faces, voids=(), **options) -> int:
        """Type 186; each void is a shell and its sense."""
        values = [self.shell(faces), 1, len(voids)]
        for shell, sense in voids:
            values += [shell, int(sense)]
        return self.model.add(186, values, **options)


def box_solid(model: IgesModel, low, high, face: dict | None = None, **options) -> int:
    """A box as type 186; options are those of its directory entry, `face` those of its faces'."""
    brep = Brep(model)
    return brep.solid(brep.box_faces(low, high, **(face or {})), **options)


def outward(polygon) -> tuple:
    """The normal of a polygon."""
    a, b, c = polygon[:3]
    return unit(cross(plus(b, times(-1.0, a)), plus(c, times(-1.0, a))))
