"""Reading a STEP file back: which entity became which face, and the tree with its colours."""

from __future__ import annotations

import re
from collections import Counter
from pathlib import Path

from OCP.IFSelect import IFSelect_RetDone
from OCP.Interface import Interface_Static
from OCP.Quantity import Quantity_ColorRGBA, Quantity_TOC_sRGB
from OCP.STEPCAFControl import STEPCAFControl_Reader
from OCP.TDF import TDF_Label, TDF_LabelSequence
from OCP.TDocStd import TDocStd_Document
from OCP.TopAbs import TopAbs_SHELL, TopAbs_SOLID
from OCP.TopLoc import TopLoc_Location
from OCP.TopoDS import TopoDS_Shape
from OCP.XCAFDoc import (
    XCAFDoc_ColorGen,
    XCAFDoc_ColorSurf,
    XCAFDoc_ColorTool,
    XCAFDoc_DocumentTool,
    XCAFDoc_ShapeTool,
)

import exact
from integral import integrate
from xcaf import get_name, new_document

#: The colour of what has none.
NO_COLOUR = "none"


class StepFile:
    """A STEP file as OpenCASCADE understands it, in millimetres."""

    def __init__(self, path: Path):
        Interface_Static.SetCVal_s("xstep.cascade.unit", "MM")
        self.path = path
        self.document: TDocStd_Document = new_document()
        reader = STEPCAFControl_Reader()
        reader.SetColorMode(True)
        reader.SetNameMode(True)
        if reader.ReadFile(str(path)) != IFSelect_RetDone or not reader.Transfer(self.document):
            raise RuntimeError(f"{path}: OpenCASCADE reads nothing")
        self._reader = reader
        self.shape: TopoDS_Shape = XCAFDoc_DocumentTool.ShapeTool_s(self.document.Main()).GetOneShape()

    def face_list(self) -> list[dict]:
        """Each face entity once: id, surface kind, exact area and centroid in its part's coordinates."""
        session = self._reader.ChangeReader().WS()
        model, transfer = session.Model(), session.TransferReader()
        ids = record_ids(self.path)
        assert len(ids) == model.NbEntities(), f"{self.path}: {len(ids)} records, {model.NbEntities()} entities"
        # The model's own look-up by entity fails through the binding; the entities' identity does not.
        entities = [model.Value(index + 1) for index in range(len(ids))]
        id_of = {id(entity): entity_id for entity, entity_id in zip(entities, ids)}
        pieces: dict[int, list[TopoDS_Shape]] = {}
        for label in {label.Tag(): label for label in self._part_labels()}.values():
            for face in exact.faces(XCAFDoc_ShapeTool.GetShape_s(label)):
                found = (transfer.EntityFromShapeResult(face, mode) for mode in (1, 2, 3, 4, -1))
                entity_id = next((id_of[id(entity)] for entity in found if entity is not None), None)
                pieces.setdefault(entity_id, []).append(face)
        faces = [face_entry(entity_id, own) for entity_id, own in pieces.items()]
        return sorted(faces, key=lambda entry: int(entry["entity"][1:]) if entry["entity"] else -1)

    def tree(self) -> list[dict]:
        """The roots of the product tree."""
        return [self._node(root, None) for root in self._roots()]

    def _node(self, label: TDF_Label, instance: TDF_Label | None) -> dict:
        node: dict = {"name": get_name(label)}
        if instance is not None:
            node["instance"] = get_name(instance)
            node["placement_mm"] = matrix(XCAFDoc_ShapeTool.GetLocation_s(instance))
        components = TDF_LabelSequence()
        XCAFDoc_ShapeTool.GetComponents_s(label, components)
        children = []
        for i in range(components.Length()):
            component, referred = components.Value(i + 1), TDF_Label()
            XCAFDoc_ShapeTool.GetReferredShape_s(component, referred)
            children.append(self._node(referred, component))
        if children:
            node["children"] = children
        return node

    def parts(self) -> list[dict]:
        """Each product with geometry of its own once, with the number of its placed instances."""
        labels = self._part_labels()
        counts = Counter(label.Tag() for label in labels)
        found = []
        for tag, label in {label.Tag(): label for label in labels}.items():
            shape = XCAFDoc_ShapeTool.GetShape_s(label)
            found.append(
                {
                    "name": get_name(label),
                    "instances": counts[tag],
                    "solids": len(exact.subshapes(shape, TopAbs_SOLID)),
                    "faces": len(exact.faces(shape)),
                    "closed": exact.is_closed(shape),
                    "area_mm2": sum(integrate(face).area_mm2 for face in exact.faces(shape)),
                    "volume_mm3": exact.volume(shape),
                }
            )
        return found

    def _part_labels(self) -> list[TDF_Label]:
        """The products with geometry, once for each placed instance."""
        found: list[TDF_Label] = []

        def visit(label: TDF_Label) -> None:
            components = TDF_LabelSequence()
            XCAFDoc_ShapeTool.GetComponents_s(label, components)
            for i in range(components.Length()):
                referred = TDF_Label()
                XCAFDoc_ShapeTool.GetReferredShape_s(components.Value(i + 1), referred)
                visit(referred)
            if not components.Length():
                found.append(label)

        for root in self._roots():
            visit(root)
        return found

    def _roots(self) -> list[TDF_Label]:
        roots = TDF_LabelSequence()
        XCAFDoc_DocumentTool.ShapeTool_s(self.document.Main()).GetFreeShapes(roots)
        return [roots.Value(i + 1) for i in range(roots.Length())]

    def colours(self) -> dict[str, float]:
        """Placed area by sRGB colour with alpha: the face's colour, else its solid's, else the nearest above."""
        areas: Counter = Counter()
        for root in self._roots():
            self._paint(root, None, areas)
        return dict(sorted(areas.items()))

    def _paint(self, label: TDF_Label, inherited: str | None, areas: Counter) -> None:
        own = colour_of(label) or inherited
        components = TDF_LabelSequence()
        XCAFDoc_ShapeTool.GetComponents_s(label, components)
        for i in range(components.Length()):
            component, referred = components.Value(i + 1), TDF_Label()
            XCAFDoc_ShapeTool.GetReferredShape_s(component, referred)
            self._paint(referred, colour_of(component) or own, areas)
        if components.Length():
            return
        shape = XCAFDoc_ShapeTool.GetShape_s(label)
        own = inherited or colour_of(label)
        painted = []
        for holder_kind in (TopAbs_SOLID, TopAbs_SHELL):
            for holder in exact.subshapes(shape, holder_kind):
                colour = self._subshape_colour(label, holder)
                if colour:
                    painted += [(face, colour) for face in exact.faces(holder)]
        for face in exact.faces(shape):
            above = next((colour for other, colour in painted if other.IsSame(face)), own)
            areas[self._subshape_colour(label, face) or above or NO_COLOUR] += integrate(face).area_mm2

    def _subshape_colour(self, label: TDF_Label, shape: TopoDS_Shape) -> str | None:
        found = TDF_Label()
        tool = XCAFDoc_DocumentTool.ShapeTool_s(self.document.Main())
        if not tool.FindSubShape(label, shape, found):
            return None
        return colour_of(found)


def colour_of(label: TDF_Label) -> str | None:
    """A label's own surface colour, else its general colour, as #rrggbbaa in sRGB."""
    for kind in (XCAFDoc_ColorSurf, XCAFDoc_ColorGen):
        colour = Quantity_ColorRGBA()
        if XCAFDoc_ColorTool.GetColor_s(label, kind, colour):
            channels = (*colour.GetRGB().Values(Quantity_TOC_sRGB), colour.Alpha())
            return "#" + "".join(f"{round(255 * channel):02x}" for channel in channels)
    return None


def record_ids(path: Path) -> list[int]:
    """The instance names of a file in the order of their records, wherever the line breaks are."""
    text = re.sub(rb"'(?:[^']|'')*'|/\*.*?\*/", b"", path.read_bytes(), flags=re.S)
    return [int(number) for number in re.findall(rb"#\s*(\d+)\s*=", text)]


def matrix(location: TopLoc_Location) -> list[list[float]]:
    """Three rows of four: rotation, then translation in millimetres."""
    transform = location.Transformation()
    return [[transform.Value(row, column) for column in range(1, 5)] for row in range(1, 4)]


def face_entry(entity_id: int | None, pieces: list[TopoDS_Shape]) -> dict:
    """A face's line in the reference."""
    figures = [integrate(piece) for piece in pieces]
    area = sum(figure.area_mm2 for figure in figures)
    centroid = [sum(f.area_mm2 * f.centroid_mm[axis] for f in figures) / area if area else 0.0 for axis in range(3)]
    return {
        "entity": f"#{entity_id}" if entity_id else None,
        "surface": exact.surface_kind(pieces[0]),
        "area_mm2": area,
        "centroid_mm": centroid,
    }
