"""Meshes one STEP file in FreeCAD 0.20: `freecadcmd export.py </dev/null`, told by the environment what to do.

TRIMLOOP_STEP is read by the module TRIMLOOP_READER, TRIMLOOP_MESH written (its ending tells the format),
TRIMLOOP_LINEAR (mm) and TRIMLOOP_ANGULAR (radians) are the tolerances. Prints the versions, then the number of
triangles or why there is no mesh.
"""

import os

import FreeCAD
import Import
import MeshPart
import Part

READERS = {"Import": Import, "Part": Part}


def export():
    """Reads the file as File > Import or Part > Import CAD file do, and meshes all that is in the document then."""
    document = FreeCAD.newDocument("Export")
    READERS[os.environ["TRIMLOOP_READER"]].insert(os.environ["TRIMLOOP_STEP"], document.Name)
    shapes = [Part.getShape(thing) for thing in document.RootObjects]
    shape = Part.makeCompound([shape for shape in shapes if not shape.isNull()])
    if not shape.Faces:
        raise RuntimeError("no faces")
    mesh = MeshPart.meshFromShape(
        Shape=shape,
        LinearDeflection=float(os.environ["TRIMLOOP_LINEAR"]),
        AngularDeflection=float(os.environ["TRIMLOOP_ANGULAR"]),
        Relative=False,
    )
    if mesh.CountFacets:
        mesh.write(os.environ["TRIMLOOP_MESH"])
    return mesh.CountFacets


print(f"\nVERSION\tFreeCAD {'.'.join(FreeCAD.Version()[:3])} (OpenCASCADE {Part.OCC_VERSION})")
try:
    print(f"MADE\t{export()}")
except Exception as error:
    print(f"FAILED\t{' '.join(str(error).split()) or type(error).__name__}")
