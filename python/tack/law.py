"""Adhesion laws from functions."""
import os
import pathlib
import zlib

import numpy as np


def law(traction, reach, rows=400, file=None, cut=False):
    """An adhesion law that is a table of a Python function, for a scene: {"type": "table", "file": ...}.

    traction: of the gap [m], in pascals, positive where surfaces pull at each other. Called with an array, or with numbers if it takes none.
    reach: the gap from which on there is nothing [m].
    rows: of the table, at least 2; closer together where gaps are small.
    file: where the table is written; the scene refers to it. Unless given, law_CHECKSUM.csv in the working folder: each law has a file of its own.
    cut: the traction may jump to zero at the end of its reach.
    """
    if not 0 < reach < np.inf:
        raise ValueError(f"reach: {reach!r} m is given, and a positive length is needed")
    if rows < 2:
        raise ValueError(f"rows: {rows!r} is given, and a table has 2 at least")
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
    text = "gap [m],traction [Pa]\n" + "".join(f"{gap!r},{value!r}\n" for gap, value in zip(gaps.tolist(), values.tolist()))
    path = pathlib.Path(file or f"law_{zlib.crc32(text.encode()):08x}.csv").resolve()
    _write_whole(path, text)
    return {"type": "table", "file": str(path), "cut": cut}


def _write_whole(path, text):
    """A run that reads the file meanwhile finds the former one or this one, and no part of either."""
    draft = path.with_name(f"{path.name}.{os.getpid()}")
    try:
        draft.write_text(text, encoding="ascii")
        os.replace(draft, path)
    finally:
        draft.unlink(missing_ok=True)
