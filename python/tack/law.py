"""Adhesion laws from functions."""
from __future__ import annotations

import os
import pathlib
import zlib
from typing import Callable

import numpy as np


def law(traction: Callable, reach: float, rows: int = 400, file: str | os.PathLike | None = None, cut: bool = False) -> dict:
    """Writes the table of a Python function and returns its adhesion law.

    Parameters
    ----------
    traction : Callable
        A function of the gap [m] that returns the traction [Pa], positive for attraction. It is called with an array, or with numbers if it accepts no array.
    reach : float
        Range of the law [m]; the traction is zero at larger gaps.
    rows : int, optional
        Number of rows of the table, at least 2; denser at small gaps.
    file : str or os.PathLike, optional
        Path of the table; default: law_CHECKSUM.csv in the working folder, one file per law.
    cut : bool, optional
        The traction may jump to zero at the end of the range.

    Returns
    -------
    dict
        The law for a scene: `{"type": "table", "file": ..., "cut": ...}`.
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
    """Replaces a file as a whole: a run that reads it meanwhile gets the former or the new contents, never a fragment."""
    draft = path.with_name(f"{path.name}.{os.getpid()}")
    try:
        draft.write_text(text, encoding="ascii")
        os.replace(draft, path)
    finally:
        draft.unlink(missing_ok=True)
