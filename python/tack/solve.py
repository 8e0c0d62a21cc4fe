"""Stored steps, solved by the program's minimisers."""
from __future__ import annotations

import json
import os
from typing import Any, Callable, Sequence, Union

from . import _tack
from .scene import overrides_of


Solver = Union[str, dict, Callable[[Any], Any]]


def _name_of(solver: Solver) -> str:
    return getattr(solver, "__name__", type(solver).__name__) if callable(solver) else solver if isinstance(solver, str) else json.dumps(solver)


def solve(problem: str | os.PathLike, solvers: Solver | Sequence[Solver] | None = None, set: dict | None = None,
          plugins: Sequence[str | os.PathLike] = (), threads: int = 0, minimum: bool = True) -> dict | list[dict]:
    """Solves a stored step (`tack run --dump-problem`) as `tack solve` does.

    Parameters
    ----------
    problem : str or os.PathLike
        The file of the step.
    solvers : str or dict or callable or Sequence of them, optional
        Minimisers by name, dictionaries that are laid over the scene's `solver`, or functions that minimise (as of `Simulation.step`); None: the scene's own. Other types
        keep the convergence criteria of the scene. An exception of a function is raised.
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
        A dictionary per solver: solver (its name, of a function that of the function), status, converged, iterations, evaluations (of line searches), linear_solves, cpu_seconds, wall_seconds, residual (in tolerances), distance (from
        the minimum, relative to the motion of the step; None if it is not known), x (positions (n, 3), or None). A single dictionary for a single solver.

    Raises
    ------
    InputError
        The file is no stored step, or a solver does not fit.
    """
    single = solvers is None or isinstance(solvers, (str, dict)) or callable(solvers)
    chosen: list[Solver] = [""] if solvers is None else [solvers] if isinstance(solvers, (str, dict)) or callable(solvers) else list(solvers)
    texts = ["" if callable(one) else one if isinstance(one, str) else json.dumps(one) for one in chosen]
    functions = [one if callable(one) else None for one in chosen]
    answers = _tack.solve(os.fspath(problem), texts, overrides_of(set), [os.fspath(p) for p in plugins], threads, minimum, functions)
    for one, answer in zip(chosen, answers):
        answer["solver"] = _name_of(one) or "scene"
    return answers[0] if single else answers
