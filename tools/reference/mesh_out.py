"""The meshes that OpenCASCADE and cadquery make of a model, to be compared with ours."""

from __future__ import annotations

import math
from pathlib import Path

import cadquery as cq
from OCP.BRepMesh import BRepMesh_IncrementalMesh
from OCP.BRepTools import BRepTools
from OCP.Message import Message_ProgressRange
from OCP.RWGltf import RWGltf_CafWriter
from OCP.RWMesh import RWMesh_CoordinateSystem
from OCP.StlAPI import StlAPI_Writer
from OCP.TColStd import TColStd_IndexedDataMapOfStringString
from OCP.TCollection import TCollection_AsciiString
from OCP.TDocStd import TDocStd_Document
from OCP.TopoDS import TopoDS_Shape


def write_meshes(name: str, model, shape: TopoDS_Shape, box, stem: Path, deflection: float, angular: float) -> float:
    """Writes `stem.stl` (millimetres, the model's axes) and `stem.glb` (+Y up); returns the GLB's unit in millimetres.

    cadquery writes its GLB in millimetres. Models that are documents go through OpenCASCADE alone, in metres.
    """
    tolerance = deflection * math.dist(*box)
    BRepTools.Clean_s(shape)
    BRepMesh_IncrementalMesh(shape, tolerance, False, angular, False)
    writer = StlAPI_Writer()
    writer.ASCIIMode = False
    if not writer.Write(shape, str(stem.with_suffix(".stl"))):
        raise RuntimeError(f"{stem}: no STL")
    glb = str(stem.with_suffix(".glb"))
    if isinstance(model, TDocStd_Document):
        write_document(model, glb)
        return 1000.0
    assembly = model if isinstance(model, cq.Assembly) else cq.Assembly(cq.Shape.cast(shape), name=name)
    if not assembly.export(glb, tolerance=tolerance, angularTolerance=angular):
        raise RuntimeError(f"{stem}: no GLB")
    return 1.0


def write_document(document: TDocStd_Document, path: str) -> None:
    """Writes a document's meshes, metres, +Y up."""
    writer = RWGltf_CafWriter(TCollection_AsciiString(path), True)
    axes = writer.ChangeCoordinateSystemConverter()
    axes.SetInputLengthUnit(0.001)
    axes.SetInputCoordinateSystem(RWMesh_CoordinateSystem.RWMesh_CoordinateSystem_Zup)
    axes.SetOutputLengthUnit(1.0)
    axes.SetOutputCoordinateSystem(RWMesh_CoordinateSystem.RWMesh_CoordinateSystem_glTF)
    if not writer.Perform(document, TColStd_IndexedDataMapOfStringString(), Message_ProgressRange()):
        raise RuntimeError(f"{path}: no GLB")
