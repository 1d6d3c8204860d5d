"""Documents that carry names, colours and assemblies (OpenCASCADE's XCAF)."""

from __future__ import annotations

import cadquery as cq
from cadquery.occ_impl.assembly import toCAF
from OCP.TCollection import TCollection_ExtendedString
from OCP.TDataStd import TDataStd_Name
from OCP.TDF import TDF_Label
from OCP.TDocStd import TDocStd_Document
from OCP.TopAbs import TopAbs_COMPOUND
from OCP.TopoDS import TopoDS_Iterator, TopoDS_Shape
from OCP.XCAFApp import XCAFApp_Application
from OCP.XCAFDoc import XCAFDoc_DocumentTool


def new_document() -> TDocStd_Document:
    """An empty document, in millimetres."""
    document = TDocStd_Document(TCollection_ExtendedString("XmlOcaf"))
    XCAFApp_Application.GetApplication_s().InitDocument(document)
    XCAFDoc_DocumentTool.SetLengthUnit_s(document, 0.001)
    return document


def set_name(label: TDF_Label, name: str) -> None:
    """Names a label; `name` may be any Unicode text."""
    TDataStd_Name.Set_s(label, TCollection_ExtendedString(name, True))


def get_name(label: TDF_Label) -> str:
    """A label's name, empty where it has none."""
    attribute = TDataStd_Name()
    if not label.FindAttribute(TDataStd_Name.GetID_s(), attribute):
        return ""
    return attribute.Get().ToExtString()


def document_of(name: str, model) -> TDocStd_Document:
    """The document of a fixture's model: one product for a shape, the tree for an assembly."""
    if isinstance(model, TDocStd_Document):
        return model
    if isinstance(model, cq.Assembly):
        document = toCAF(model, True)[1]
        XCAFDoc_DocumentTool.SetLengthUnit_s(document, 0.001)
        return document
    document = new_document()
    label = XCAFDoc_DocumentTool.ShapeTool_s(document.Main()).AddShape(shape_of(model), False)
    set_name(label, name)
    return document


def shape_of(model) -> TopoDS_Shape:
    """The placed geometry of a fixture's model, without compounds around a single shape."""
    if isinstance(model, TDocStd_Document):
        return XCAFDoc_DocumentTool.ShapeTool_s(model.Main()).GetOneShape()
    if isinstance(model, cq.Assembly):
        return model.toCompound().wrapped
    if isinstance(model, cq.Workplane):
        values = model.vals()
        model = values[0] if len(values) == 1 else cq.Compound.makeCompound(values)
    shape = model if isinstance(model, TopoDS_Shape) else model.wrapped
    while shape.ShapeType() == TopAbs_COMPOUND and shape.NbChildren() == 1:
        shape = TopoDS_Iterator(shape).Value()
    return shape
