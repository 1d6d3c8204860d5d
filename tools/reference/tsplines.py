"""T-meshes with T-junctions, written by rule into fixtures/tspline (see crates/geom/src/tspline/text.rs)."""

import math
from pathlib import Path

FOLDER = Path(__file__).resolve().parents[2] / "fixtures" / "tspline"
U = [0, 0, 0, 0, 1, 2, 2.5, 3, 4, 5, 5, 5, 5]
V = [0, 0, 0, 0, 1, 2, 2.5, 3, 4, 4, 4, 4]


def greville(knots, line):
    return (knots[line - 1] + knots[line] + knots[line + 1]) / 3


def write(name, is_kept, place):
    text = ["tspline 1", "u " + " ".join(map(str, U)), "v " + " ".join(map(str, V))]
    for i in range(2, len(U) - 2):
        for j in range(2, len(V) - 2):
            if is_kept(i, j):
                x, y, z, weight = place(i, j, greville(U, i), greville(V, j))
                text.append(f"p {i} {j}  {x:.6f} {y:.6f} {z:.6f}  {weight:g}")
    (FOLDER / f"{name}.tspline").write_text("\n".join(text) + "\n")


def hill(i, j, u, v):
    height = 12 * math.exp(-((u - 2.5) ** 2 + (v - 2.3) ** 2))
    return 10 * u, 10 * v, height, 1.0 + 0.5 * ((i * j) % 3 == 0)


def wave(_i, _j, u, v):
    return 8 * u, 8 * v, 3 * math.sin(1.4 * u) * math.cos(1.1 * v), 1.0


def ring(_i, _j, u, v):
    around, along = 2 * math.pi * 0.8 * u / 5, 2 * math.pi * 0.7 * v / 4
    r = 20 + 6 * math.cos(along)
    return r * math.cos(around), r * math.sin(around), 6 * math.sin(along), 1.0


if __name__ == "__main__":
    FOLDER.mkdir(exist_ok=True)
    write("hill", lambda i, j: not (i == 6 and j < 6) and not (j == 6 and i > 8), hill)
    write("wave", lambda i, j: not (i == 6 and j > 6) and not (i == 8 and 4 < j < 9), wave)
    write("ring", lambda i, j: not (j == 6 and i < 5), ring)
