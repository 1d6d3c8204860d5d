"""Files that are no STEP files."""

from __future__ import annotations

import io
import zipfile

from broken.box import box
from broken.expected import broken


@broken("empty.step", "no bytes at all", [2], ["empty"])
def empty():
    return b""


@broken("blank.step", "blanks and line ends only", [2], ["empty", "not a step", "iso-10303"])
def blank():
    return b"  \n\r\n\t \n"


@broken("stl_binary.step", "a binary STL file", [2], ["not a step", "iso-10303", "stl"])
def stl_binary():
    return b"STL Exported".ljust(80) + (1).to_bytes(4, "little") + bytes(50)


@broken("stl_text.step", "a text STL file", [2], ["not a step", "iso-10303", "stl"])
def stl_text():
    return "solid box\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1 0 0\n   vertex 0 1 0\n  endloop\n endfacet\nendsolid box\n"


@broken("html.step", "the web page that a failed download left", [2], ["not a step", "iso-10303", "html"])
def html():
    return "<!DOCTYPE html>\n<html><head><title>404 Not Found</title></head><body>Not Found</body></html>\n"


@broken("png.step", "the start of a PNG picture", [2], ["not a step", "iso-10303"])
def png():
    return b"\x89PNG\r\n\x1a\n\x00\x00\x00\rIHDR\x00\x00\x00\x01\x00\x00\x00\x01\x08\x06\x00\x00\x00\x1f\x15\xc4\x89"


@broken("noise.step", "bytes without any meaning", [2], ["not a step", "iso-10303"])
def noise():
    return bytes((k * 197 + 31 * (k // 7)) % 256 for k in range(2000))


@broken("utf16.step", "a STEP file saved as UTF-16", [2, 0], ["utf-16", "encoding", "not a step"])
def utf16():
    return b"\xff\xfe" + box().text().encode("utf-16-le")


@broken("gzip_noise.step.gz", "gzip's first bytes, then nonsense", [2], ["gzip", "decompress", "compressed", "deflate"])
def gzip_noise():
    return b"\x1f\x8b\x08\x00" + bytes((k * 73) % 256 for k in range(200))


@broken("zip_without_step.stpz", "a zip file with a text file in it", [2], ["zip", "no step"])
def zip_without_step():
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w") as packed:
        packed.writestr(zipfile.ZipInfo("readme.txt", (2000, 1, 1, 0, 0, 0)), "nothing here")
    return buffer.getvalue()
