"""Comparisons of solvers, parameter studies and calibrations of scenes, as `tack compare`, `tack batch` and `tack calibrate` make them."""
from __future__ import annotations

import os
from typing import Sequence

from . import _tack
from .case_program import CaseProgram
from .results import Batch, Tables
from .scene import overrides_of


def compare(comparison: str | os.PathLike, set: dict | None = None, output: str | os.PathLike = "", threads: int = 0, quiet: bool = True) -> Tables:
    """Compares speed and error of several solvers, as `tack compare` does, and writes the same files.

    Parameters
    ----------
    comparison : str or os.PathLike
        The path of the comparison file.
    set : dict, optional
        Keys of the file and their new values.
    output : str or os.PathLike, optional
        The results folder; default: results/NAME.
    threads : int, optional
        Number of threads; 0: all cores.
    quiet : bool, optional
        Print nothing.

    Returns
    -------
    Tables
        Its results: `tables["compare"]` has the columns of compare.csv, `summary` is compare.json.

    Raises
    ------
    InputError
        The file cannot be used; nothing was written.
    """
    return Tables(_tack.compare(os.fspath(comparison), overrides_of(set), os.fspath(output), threads, quiet))


def batch(batch: str | os.PathLike, set: dict | None = None, output: str | os.PathLike = "", jobs: int = 0, threads: int = 0, only: Sequence[str] = (),
          failed: bool = False, quiet: bool = True) -> Batch:
    """Runs a parameter study, as `tack batch` does, and writes the same files.

    Each case is a process of its own. Another call with the same output runs the cases that are left. Call it from the main thread.

    Parameters
    ----------
    batch : str or os.PathLike
        The path of the batch file.
    set : dict, optional
        Keys of the file and their new values.
    output : str or os.PathLike, optional
        The results folder; default: results/NAME.
    jobs : int, optional
        Number of concurrent cases; 0: as the file says.
    threads : int, optional
        Number of threads of a case; 0: as the file says.
    only : sequence of str, optional
        Names of the cases to run, in which `*` matches any text; none: all.
    failed : bool, optional
        Repeat the cases that failed.
    quiet : bool, optional
        Print nothing.

    Returns
    -------
    Batch
        Its results: `table` has a row per case, `table["status"]` says how each ended, `cases` has their runs.

    Raises
    ------
    InputError
        The file or a case cannot be used; nothing was written.
    """
    with CaseProgram() as program:
        return Batch(_tack.batch(os.fspath(batch), overrides_of(set), os.fspath(output), program, jobs, threads, list(only), failed, quiet))


def calibrate(calibration: str | os.PathLike, set: dict | None = None, output: str | os.PathLike = "", jobs: int = 0, threads: int = 0, failed: bool = False,
              quiet: bool = True) -> Tables:
    """Fits scene parameters to measured curves, as `tack calibrate` does, and writes the same files.

    Each run is a process of its own. Another call with the same output continues an interrupted calibration. Call it from the main thread.

    Parameters
    ----------
    calibration : str or os.PathLike
        The path of the calibration file.
    set : dict, optional
        Keys of the file and their new values.
    output : str or os.PathLike, optional
        The results folder; default: results/NAME.
    jobs : int, optional
        Number of concurrent runs; 0: as the file says.
    threads : int, optional
        Number of threads of a run; 0: as the file says.
    failed : bool, optional
        Repeat the runs that failed.
    quiet : bool, optional
        Print nothing.

    Returns
    -------
    Tables
        Its results: `summary` is calibration.json with values and intervals, `tables["calibration"]` has a row per parameter, `tables["evaluations"]` one per point,
        and `fits` the measured and simulated curves.

    Raises
    ------
    InputError
        The file cannot be used.
    SimulationError
        No run succeeded.
    """
    with CaseProgram() as program:
        return Tables(_tack.calibrate(os.fspath(calibration), overrides_of(set), os.fspath(output), program, jobs, threads, failed, quiet))
