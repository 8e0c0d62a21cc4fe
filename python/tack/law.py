"""Adhesion laws from functions."""
import pathlib

import numpy as np


def law(traction, reach, rows=400, file="law.csv", cut=False):
    """An adhesion law that is a table of a Python function, for a scene: {"type": "table", "file": ...}.

    traction: of the gap [m], in pascals, positive where surfaces pull at each other. Called with an array, or with numbers if it takes none.
    reach: the gap from which on there is nothing [m].
    rows: of the table; closer together where gaps are small.
    file: where the table is written; the scene refers to it.
    cut: the traction may jump to zero at the end of its reach.
    """
    gaps = reach * np.linspace(0, 1, rows) ** 1.5
    try:
        values = np.asarray(traction(gaps), dtype=float)
        if values.shape != gaps.shape:
            raise TypeError
    except (TypeError, ValueError):
        values = np.array([float(traction(float(gap))) for gap in gaps])
    if not np.all(np.isfinite(values)):
        gap = gaps[~np.isfinite(values)][0]
        raise ValueError(f"the traction at a gap of {gap:g} m is not a finite number")
    if not cut:
        values[-1] = 0
    path = pathlib.Path(file).resolve()
    with open(path, "w", encoding="ascii") as out:
        out.write("gap [m],traction [Pa]\n")
        out.writelines(f"{gap!r},{value!r}\n" for gap, value in zip(gaps.tolist(), values.tolist()))
    return {"type": "table", "file": str(path), "cut": cut}
