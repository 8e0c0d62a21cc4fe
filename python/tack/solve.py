"""Stored steps, solved by the program's minimisers."""
from __future__ import annotations

import json
import os
from typing import Sequence

from . import _tack
from .scene import overrides_of


def solve(problem: str | os.PathLike, solvers: str | dict | Sequence[str | dict] | None = None, set: dict | None = None,
          plugins: Sequence[str | os.PathLike] = (), threads: int = 0, minimum: bool = True) -> dict | list[dict]:
    """Solves a stored step (`tack run --dump-problem`) as `tack solve` does.

    Parameters
    ----------
    problem : str or os.PathLike
        The file of the step.
    solvers : str or dict or Sequence[str or dict], optional
        Minimisers by name, or dictionaries that are laid over the scene's `solver`; None: the scene's own. Other types keep the convergence criteria of the scene.
    set : dict, optional
        Keys of the stored scene and their new values.
    plugins : Sequence[str or os.PathLike], optional
        Libraries with minimisers.
    threads : int, optional
        Number of threads; 0: all cores.
    minimum : bool, optional
        Search for the minimum first if the file has none.

    Returns
    -------
    dict or list[dict]
        A dictionary per solver: status, converged, iterations, evaluations (of line searches), linear_solves, cpu_seconds, wall_seconds, residual (in tolerances), distance (from
        the minimum, relative to the motion of the step; None if it is not known), x (positions (n, 3), or None). A single dictionary for a single solver.

    Raises
    ------
    InputError
        The file is no stored step, or a solver does not fit.
    """
    single = solvers is None or isinstance(solvers, (str, dict))
    chosen: list[str | dict] = [""] if solvers is None else [solvers] if isinstance(solvers, (str, dict)) else list(solvers)
    texts = [one if isinstance(one, str) else json.dumps(one) for one in chosen]
    answers = _tack.solve(os.fspath(problem), texts, overrides_of(set), [os.fspath(p) for p in plugins], threads, minimum)
    return answers[0] if single else answers
