"""Reading an exported mesh back, to tell where it is not the model of the reference."""

from __future__ import annotations

from pathlib import Path

import numpy as np

#: What an STL file says of a triangle.
STL_FACET = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
#: How far area and volume of a mesh may be off its model's, as a part of them.
AREA_OFF, VOLUME_OFF = 0.015, 0.02
#: How far its box may be off, as a multiple of the linear tolerance.
BOX_OFF = 3.0


def read_mesh(path: Path) -> np.ndarray:
    """The corners of all triangles of a binary STL file or of an OBJ file, triangle by triangle."""
    if path.suffix == ".stl":
        return np.frombuffer(path.read_bytes(), STL_FACET, offset=84)["corners"].astype(float)
    words = [line.split() for line in path.read_text(encoding="utf-8").splitlines()]
    points = np.array([[float(word) for word in line[1:4]] for line in words if line[:1] == ["v"]])
    corners = [[int(word.split("/")[0]) - 1 for word in line[1:]] for line in words if line[:1] == ["f"]]
    return points[np.array(corners)]


def differences(triangles: np.ndarray, reference: dict, linear: float) -> list[str]:
    """Where a mesh is another model than the reference tells of."""
    cross = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    figures = [("area_mm2", float(np.linalg.norm(cross, axis=1).sum() / 2), AREA_OFF)]
    if reference["closed"]:
        figures.append(("volume_mm3", float((triangles[:, 0] * cross).sum() / 6), VOLUME_OFF))
    found = [
        f"{key} {figure:.6g}, not {reference[key]:.6g}"
        for key, figure, most in figures
        if abs(figure - reference[key]) > most * abs(reference[key])
    ]
    box = np.array([triangles.min(axis=(0, 1)), triangles.max(axis=(0, 1))])
    off = float(np.abs(box - np.array(reference["bbox_mm"])).max())
    return found + ([f"bbox_mm off by {off:.6g}"] if off > BOX_OFF * linear else [])
