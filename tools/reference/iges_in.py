"""Reading an IGES file back with OpenCASCADE: which entity became which face, and what its loose faces enclose."""

from __future__ import annotations

import math
from pathlib import Path

from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeSolid, BRepBuilderAPI_Sewing
from OCP.BRepLib import BRepLib
from OCP.IFSelect import IFSelect_RetDone
from OCP.IGESControl import IGESControl_Reader
from OCP.Interface import Interface_Static
from OCP.ShapeAnalysis import ShapeAnalysis_Shell
from OCP.TopAbs import TopAbs_FACE, TopAbs_SHELL, TopAbs_SOLID
from OCP.TopoDS import TopoDS, TopoDS_Builder, TopoDS_Compound, TopoDS_Shape, TopoDS_Shell

import exact
from reference import ROUND_TRIP, disagreements, face_disagreements, measure, settled
from step_in import face_entry

#: How far apart loose faces may be that belong together, millimetres.
SEWING = 0.02


class IgesFile:
    """An IGES file as OpenCASCADE understands it, in millimetres."""

    def __init__(self, path: Path):
        Interface_Static.SetCVal_s("xstep.cascade.unit", "MM")
        reader = IGESControl_Reader()
        reader.SetReadVisible(True)
        if reader.ReadFile(str(path)) != IFSelect_RetDone or reader.TransferRoots() == 0:
            raise RuntimeError(f"{path}: OpenCASCADE reads nothing")
        self._reader = reader
        self.shape: TopoDS_Shape = reader.OneShape()

    def face_list(self) -> list[dict]:
        """Each face entity (by its directory entry) once: surface kind, exact area and centroid as placed."""
        session = self._reader.WS()
        model, transfer = session.Model(), session.TransferReader()
        kept = [model.Value(k) for k in range(1, model.NbEntities() + 1)]
        number = {id(entity): 2 * k + 1 for k, entity in enumerate(kept)}
        pieces: dict[int | None, list[TopoDS_Shape]] = {}
        for face in exact.faces(self.shape):
            found = (transfer.EntityFromShapeResult(face, mode) for mode in (1, 2, 3, 4, -1))
            entry = next((number[id(entity)] for entity in found if entity is not None and id(entity) in number), None)
            pieces.setdefault(entry, []).append(face)
        entries = []
        for entry, own in pieces.items():
            entries.append({**face_entry(entry, own), "entity": f"D{entry}"})
        return entries

    def sewn(self) -> TopoDS_Shape:
        """The shape with the loose faces sewn, and solids of what closes."""
        loose = exact.subshapes(self.shape, TopAbs_FACE, TopAbs_SOLID)
        if not loose:
            return self.shape
        sewing = BRepBuilderAPI_Sewing(SEWING)
        for face in loose:
            sewing.Add(face)
        sewing.Perform()
        builder, compound = TopoDS_Builder(), TopoDS_Compound()
        builder.MakeCompound(compound)
        for solid in exact.subshapes(self.shape, TopAbs_SOLID):
            builder.Add(compound, solid)
        sewed = sewing.SewedShape()
        for shell in exact.subshapes(sewed, TopAbs_SHELL):
            builder.Add(compound, solid_of(shell))
        for face in exact.subshapes(sewed, TopAbs_FACE, TopAbs_SHELL):
            # A surface that closes on itself is sewn to nothing.
            shell = TopoDS_Shell()
            builder.MakeShell(shell)
            builder.Add(shell, face)
            builder.Add(compound, face if has_free_edges(shell) else solid_of(shell))
        for edge in exact.free_edges(self.shape):
            builder.Add(compound, edge)
        return compound


def solid_of(shell: TopoDS_Shape) -> TopoDS_Shape:
    """The solid within a closed shell, turned outward; an open shell as it is."""
    shell = TopoDS.Shell_s(shell)
    shell.Closed(not has_free_edges(shell))
    if not shell.Closed():
        return shell
    solid = BRepBuilderAPI_MakeSolid(shell).Solid()
    BRepLib.OrientClosedSolid_s(solid)
    return solid


def has_free_edges(shell) -> bool:
    """Whether a shell has an edge that only one of its faces uses."""
    analysis = ShapeAnalysis_Shell()
    analysis.LoadShells(shell)
    analysis.CheckOrientedShells(shell, True)
    return analysis.HasFreeEdges()


def seen_in_iges(reference: dict, path: Path) -> list[str]:
    """Where OpenCASCADE's figures of a file, its loose faces sewn, are not the reference's."""
    try:
        file = IgesFile(path)
        shape = file.sewn()
        found = measure(shape, exact.bounding_box(file.shape))
    except Exception as error:
        return [f"reads nothing ({type(error).__name__})"]
    notes = disagreements({**found, **reference}, found)
    return notes or finer(reference, found, file)


def finer(reference: dict, found: dict, file: IgesFile) -> list[str]:
    """Where box, centroid, free curves or faces are not the expected ones."""
    notes = []
    ours, theirs = reference.get("bbox_mm"), found["bbox_mm"]
    if ours and theirs:
        gap = max(abs(a - b) for low, high in zip(ours, theirs) for a, b in zip(low, high))
        if gap > ROUND_TRIP * (math.dist(*ours) or 1.0):
            notes.append(f"box {settled(theirs)}, not {settled(ours)}")
    ours, theirs = reference.get("area_centroid_mm"), found["area_centroid_mm"]
    if ours and math.dist(ours, theirs) > ROUND_TRIP * math.dist(*reference["bbox_mm"]):
        notes.append(f"centroid {settled(theirs)}, not {settled(ours)}")
    if "free_curves" in reference:
        theirs = found.get("free_curves", {"count": 0, "length_mm": 0.0})
        ours = reference["free_curves"]
        if not math.isclose(ours["length_mm"], theirs["length_mm"], rel_tol=ROUND_TRIP):
            notes.append(f"free curves of {theirs['length_mm']:.9g} mm, not {ours['length_mm']:.9g}")
    others = {face["entity"]: face for face in file.face_list()}
    for face in reference.get("face_areas_mm2", []):
        notes += face_disagreements(face, others.get(face["entity"]))
    return notes
