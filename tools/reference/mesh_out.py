"""The meshes that OpenCASCADE and cadquery make of a model, to be compared with ours."""

from __future__ import annotations

import math
from pathlib import Path

import cadquery as cq
from OCP.BRepMesh import BRepMesh_IncrementalMesh
from OCP.BRepTools import BRepTools
from OCP.Message import Message_ProgressRange
from OCP.RWGltf import RWGltf_CafWriter
from OCP.StlAPI import StlAPI_Writer
from OCP.TColStd import TColStd_IndexedDataMapOfStringString
from OCP.TCollection import TCollection_AsciiString
from OCP.TopoDS import TopoDS_Shape

from xcaf import document_of


def write_meshes(name: str, model, shape: TopoDS_Shape, box, stem: Path, deflection: float, angular: float) -> None:
    """Writes `stem.stl` (millimetres, the model's axes) and `stem.glb`, as cadquery 2.8 does.

    The GLB's unit is whatever cadquery writes; see fixtures/README.md.
    """
    tolerance = deflection * math.dist(*box)
    BRepTools.Clean_s(shape)
    BRepMesh_IncrementalMesh(shape, tolerance, False, angular, False)
    writer = StlAPI_Writer()
    writer.ASCIIMode = False
    if not writer.Write(shape, str(stem.with_suffix(".stl"))):
        raise RuntimeError(f"{stem}: no STL")
    if isinstance(model, cq.Assembly):
        if not model.export(str(stem.with_suffix(".glb")), tolerance=tolerance, angularTolerance=angular):
            raise RuntimeError(f"{stem}: no GLB")
    elif isinstance(model, (cq.Workplane, cq.Shape, TopoDS_Shape)):
        assembly = cq.Assembly(cq.Shape.cast(shape), name=name)
        assembly.export(str(stem.with_suffix(".glb")), tolerance=tolerance, angularTolerance=angular)
    else:
        gltf = RWGltf_CafWriter(TCollection_AsciiString(str(stem.with_suffix(".glb"))), True)
        gltf.Perform(document_of(name, model), TColStd_IndexedDataMapOfStringString(), Message_ProgressRange())
