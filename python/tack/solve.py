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

    Args:
        problem: The file of the step.
        solvers: Minimisers by name, or dictionaries that are laid over the scene's `solver`; None: the scene's own. Other types keep the convergence criteria of the scene.
        set: Keys of the stored scene and their new values.
        plugins: Libraries with minimisers.
        threads: Number of threads; 0: all cores.
        minimum: Search for the minimum first if the file has none.

    Returns:
        A dictionary per solver: status, converged, iterations, evaluations (of line searches), linear_solves, cpu_seconds, wall_seconds, residual (in tolerances), distance (from
            the minimum, relative to the motion of the step; None if it is not known), x (positions (n, 3), or None). A single dictionary for a single solver.

    Raises:
        InputError: The file is no stored step, or a solver does not fit.
    """
    single = solvers is None or isinstance(solvers, (str, dict))
    texts = [one if isinstance(one, str) else json.dumps(one) for one in ([solvers or ""] if single else solvers)]
    answers = _tack.solve(os.fspath(problem), texts, overrides_of(set), [os.fspath(p) for p in plugins], threads, minimum)
    return answers[0] if single else answers
