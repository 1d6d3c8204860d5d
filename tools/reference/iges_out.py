"""Models of `models/` as OpenCASCADE writes them to IGES: loose trimmed surfaces, or solids."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from pathlib import Path

from OCP.BRepGProp import BRepGProp
from OCP.GProp import GProp_GProps
from OCP.IGESCAFControl import IGESCAFControl_Reader, IGESCAFControl_Writer
from OCP.IGESControl import IGESControl_Controller
from OCP.Interface import Interface_Static
from OCP.TCollection import TCollection_ExtendedString, TCollection_HAsciiString
from OCP.TDocStd import TDocStd_Document

import models  # noqa: F401  (registers the fixtures)
from catalogue import FIXTURES, Fixture
from exact import bounding_box, faces
from iges_in import IgesFile
from integral import integrate
from reference import ROUND_TRIP, measure, write_reference
from step_in import StepFile
from xcaf import document_of, shape_of

FOLDER = "iges_opencascade"
SOURCE = "OpenCASCADE 7.9.3 (cadquery 2.8.0), exact surfaces of the model in memory"

#: The models, by their names in `cadquery/`.
MODELS = """
assembly_flat assembly_nested bottle box box_filleted bracket bspline_degree_3 bspline_rational capsule
colour_per_face cone_cut_in_hyperbola cone_with_apex cylinder cylinder_cut_askew cylinder_with_cross_hole
cylinder_with_hole_across_seam ellipsoid frustum hollow_ball lens loft_airfoil loft_circle_to_square
offset_surface paraboloid pipe_tee plate_perforated ring several_solids sheet_open_shell shell_thin
solid_sheet_and_wire sphere sphere_segment sphere_with_hole_off_axis spline_closed_extruded spline_hill_drilled
spline_revolved torus torus_with_hole torus_with_hole_on_both_seams torus_with_pocket_on_seam
torus_with_pockets_on_seams
""".split()

#: Not written: nothing in loose faces tells a void from a second body.
LEFT_OUT = {"hollow_ball_faces"}


@dataclass
class Written:
    """One model in one of the two modes."""

    model: Fixture
    solids: bool

    folder = FOLDER

    @property
    def name(self) -> str:
        return f"{self.model.name}_{'brep' if self.solids else 'faces'}"


WRITTEN = {
    written.name: written
    for name in MODELS
    for written in (Written(FIXTURES["cadquery", name], False), Written(FIXTURES["cadquery", name], True))
    if written.name not in LEFT_OUT
}


def make_written(written: Written, folder: Path) -> list[str]:
    """Writes one file and its reference; returns what a person should look at."""
    model = written.model.build()
    shape = shape_of(model)
    in_memory = measure(shape, bounding_box(shape))
    document = document_of(written.model.name, model)
    path = folder / f"{written.name}.igs"
    write_iges(document, path, written.solids)
    reference = {**in_memory, "colours": colours(document)}
    # Some faces lose their colours when OpenCASCADE writes or reads them.
    if not same_areas(reference["colours"], colours(document_in(path))):
        del reference["colours"]
    read_back = faces(IgesFile(path).shape)
    notes = []
    if len(read_back) != reference["faces"]:
        notes.append(f"faces {len(read_back)}, not {reference['faces']}: left out of the reference")
        del reference["faces"]
    area = quick_area(read_back)
    if not math.isclose(area, reference["area_mm2"], rel_tol=ROUND_TRIP):
        area = sum(integrate(face).area_mm2 for face in read_back)
    if not math.isclose(area, reference["area_mm2"], rel_tol=ROUND_TRIP):
        notes.append(f"area {area:.9g}, not {reference['area_mm2']:.9g}")
    how = "solids (186)" if written.solids else "loose trimmed surfaces (144)"
    shows = f"{written.model.shows}; as {how}"
    write_reference(folder / f"{written.name}.reference.json", {"source": SOURCE, "shows": shows, **reference})
    return notes


def quick_area(read_back) -> float:
    """OpenCASCADE's own integral, which is off in the third digit on some splines."""
    total = 0.0
    for face in read_back:
        properties = GProp_GProps()
        BRepGProp.SurfaceProperties_s(face, properties, False, False)
        total += properties.Mass()
    return total


def same_areas(a: dict[str, float], b: dict[str, float]) -> bool:
    """Whether the same colours cover the same areas, but for a level of rounding in the colours."""
    return sorted(round(area, 1) for area in a.values()) == sorted(round(area, 1) for area in b.values())


def document_in(path: Path) -> TDocStd_Document:
    """The file with its colours, as OpenCASCADE reads it."""
    document = TDocStd_Document(TCollection_ExtendedString("read"))
    reader = IGESCAFControl_Reader()
    reader.SetColorMode(True)
    if not reader.Perform(str(path), document):
        raise RuntimeError(f"{path}: OpenCASCADE reads nothing")
    return document


def colours(document: TDocStd_Document) -> dict[str, float]:
    """Area by colour; IGES knows no transparency."""
    view = StepFile.__new__(StepFile)
    view.document = document
    areas: dict[str, float] = {}
    for colour, area in view.colours().items():
        opaque = colour if colour == "none" else colour[:7] + "ff"
        areas[opaque] = areas.get(opaque, 0.0) + area
    return areas


def write_iges(document: TDocStd_Document, path: Path, solids: bool) -> None:
    """Writes the document in millimetres; only the document decides the bytes."""
    IGESControl_Controller.Init_s()
    Interface_Static.SetIVal_s("write.iges.brep.mode", int(solids))
    Interface_Static.SetCVal_s("write.iges.unit", "MM")
    writer = IGESCAFControl_Writer()
    writer.SetColorMode(True)
    writer.SetNameMode(True)
    if not writer.Transfer(document):
        raise RuntimeError(f"{path}: nothing to write")
    # The author is who runs this.
    head = writer.Model().GlobalSection()
    head.SetAuthorName(TCollection_HAsciiString("trimloop"))
    writer.Model().SetGlobalSection(head)
    if not writer.Write(str(path)):
        raise RuntimeError(f"{path}: not written")
    settle_dates(path)


def settle_dates(path: Path) -> None:
    """Replaces the time stamps."""
    text = path.read_bytes()
    text = re.sub(rb"15H\d{8}\.\d{6}", b"15H20000101.000000", text)
    path.write_bytes(text)
