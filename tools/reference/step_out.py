"""Writing STEP files that come out the same every time."""

from __future__ import annotations

import re
from pathlib import Path

from OCP.IFSelect import IFSelect_RetDone
from OCP.Interface import Interface_Static
from OCP.STEPCAFControl import STEPCAFControl_Writer
from OCP.STEPControl import STEPControl_AsIs
from OCP.TDocStd import TDocStd_Document

from catalogue import StepOptions

SCHEMAS = {"AP203": 3, "AP214": 4, "AP242": 5}


def write_step(document: TDocStd_Document, path: Path, options: StepOptions) -> None:
    """Writes the document; only the options and the document decide the bytes."""
    writer = STEPCAFControl_Writer()
    Interface_Static.SetIVal_s("write.step.schema", SCHEMAS[options.schema])
    Interface_Static.SetIVal_s("write.surfacecurve.mode", int(options.pcurves))
    Interface_Static.SetCVal_s("write.step.unit", options.unit)
    # The schema is read when the writer's model is made.
    writer = STEPCAFControl_Writer()
    writer.SetColorMode(True)
    writer.SetLayerMode(True)
    writer.SetNameMode(True)
    if not writer.Transfer(document, STEPControl_AsIs):
        raise RuntimeError(f"{path}: nothing to write")
    if writer.Write(str(path)) != IFSelect_RetDone:
        raise RuntimeError(f"{path}: not written")
    settle_header(path)


def settle_header(path: Path) -> None:
    """Replaces what changes from run to run: its time stamp, and AP203's dates."""
    text = path.read_bytes()
    text = re.sub(rb"'\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d(Z|[+-]\d\d:\d\d)?'", b"'2000-01-01T00:00:00'", text, count=1)
    text = re.sub(rb"CALENDAR_DATE\([\d,]*\)", b"CALENDAR_DATE(2000,1,1)", text)
    text = re.sub(rb"LOCAL_TIME\(\d+,\d+,", b"LOCAL_TIME(0,0,", text)
    path.write_bytes(text)
