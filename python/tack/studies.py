"""Comparisons of solvers and calibrations of scenes, as `tack compare` and `tack calibrate` make them."""
from __future__ import annotations

import os
import pathlib
import shlex
import sys
import tempfile

from . import _tack
from .results import Tables, read
from .scene import overrides_of


def compare(comparison: str | os.PathLike, set: dict | None = None, output: str | os.PathLike = "", threads: int = 0, quiet: bool = True) -> Tables:
    """Compares speed and error of several solvers, as `tack compare` does, and writes the same files.

    Args:
        comparison: The path of the comparison file.
        set: Keys of the file and their new values.
        output: The results folder; default: results/NAME.
        threads: Number of threads; 0: all cores.
        quiet: Print nothing.

    Returns:
        Its results: `tables["compare"]` has the columns of compare.csv, `summary` is compare.json.

    Raises:
        InputError: The file cannot be used; nothing was written.
    """
    return read(_tack.compare(os.fspath(comparison), overrides_of(set), os.fspath(output), threads, quiet))


def calibrate(calibration: str | os.PathLike, set: dict | None = None, output: str | os.PathLike = "", jobs: int = 0, threads: int = 0, failed: bool = False,
              quiet: bool = True) -> Tables:
    """Fits scene parameters to measured curves, as `tack calibrate` does, and writes the same files.

    Each run is a process of its own. Another call with the same output continues an interrupted calibration. Call it from the main thread.

    Args:
        calibration: The path of the calibration file.
        set: Keys of the file and their new values.
        output: The results folder; default: results/NAME.
        jobs: Number of concurrent runs; 0: as the file says.
        threads: Number of threads of a run; 0: as the file says.
        failed: Repeat the runs that failed.
        quiet: Print nothing.

    Returns:
        Its results: `summary` is calibration.json with values and intervals, `tables["calibration"]` has a row per parameter, `tables["evaluations"]` one per point,
            and `fits` the measured and simulated curves.

    Raises:
        InputError: The file cannot be used.
        SimulationError: No run succeeded.
    """
    with tempfile.TemporaryDirectory() as folder:
        program = pathlib.Path(folder) / "tack"
        package = pathlib.Path(__file__).resolve().parents[1]
        program.write_text(f'#!/bin/sh\nPYTHONPATH={shlex.quote(str(package))}${{PYTHONPATH:+:$PYTHONPATH}} exec {shlex.quote(sys.executable)} -m tack.case "$@"\n',
                           encoding="utf-8")
        program.chmod(0o755)
        return read(_tack.calibrate(os.fspath(calibration), overrides_of(set), os.fspath(output), str(program), jobs, threads, failed, quiet))
