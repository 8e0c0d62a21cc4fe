"""Batches for optimisers from elsewhere: what a case gives, as a function of what varies."""
from __future__ import annotations

import math
import numbers
import os
import pathlib
from typing import Any, Sequence

import numpy as np

from . import _tack
from .calibration import Parameter
from .case_program import CaseProgram
from .results import Batch
from .scene import overrides_of


def _parameter(known: dict) -> Parameter:
    return Parameter(known["name"], known["low"], known["high"], None, known["log"], "SI", (known["key"],), tuple(known["values"]), known["whole"])


def _number(value: Any, whole: bool) -> bool | int | float:
    """Returns a number without a point if it is whole: keys of whole numbers take it, and equal numbers make one case."""
    if isinstance(value, (bool, np.bool_)):
        return bool(value)
    if isinstance(value, numbers.Integral):
        return int(value)
    number = float(value)
    return round(number) if whole or (number.is_integer() and abs(number) < 2**53) else number


class Study:
    """A batch file as a function: what varies in it are parameters, what its table has are results.

    Points are evaluated by the cases of `tack batch`, processes side by side, in one folder: with the same names of parameters none runs twice, also in a later call. Call it from the main thread.

    Parameters
    ----------
    batch : str or os.PathLike
        The path of the batch file, with one base.
    set : dict, optional
        Keys of the file and their new values.
    output : str or os.PathLike, optional
        The results folder; default: results/NAME.
    jobs : int, optional
        Number of concurrent cases; 0: as the file says.
    threads : int, optional
        Number of threads of a case; 0: as the file says.
    failed : bool, optional
        Repeat the cases that failed.

    Raises
    ------
    InputError
        The file cannot be used.
    """

    def __init__(self, batch: str | os.PathLike, set: dict | None = None, output: str | os.PathLike = "", jobs: int = 0, threads: int = 0, failed: bool = False):
        self._file, self._set = os.fspath(batch), overrides_of(set)
        self._output, self._jobs, self._threads, self._failed = os.fspath(output), jobs, threads, failed
        self.parameters = [_parameter(one) for one in _tack.varied(self._file, self._set)]
        self._keys = {one.name: one.keys[0] for one in self.parameters}
        self._whole = {one.name for one in self.parameters if one.whole}
        self._points: dict[tuple, dict] = {}

    @property
    def names(self) -> list[str]:
        """The names of the parameters, in the order of the file."""
        return [one.name for one in self.parameters]

    @property
    def bounds(self) -> np.ndarray:
        """Bounds of the parameters (n, 2) [SI]; NaN for a list of values."""
        return np.array([(math.nan if one.low is None else one.low, math.nan if one.high is None else one.high) for one in self.parameters])

    def point(self, x: dict | Sequence[float] | np.ndarray) -> dict:
        """Returns the keys of the scene that a point sets.

        Parameters
        ----------
        x : dict or array_like
            A value for each of the parameters, or of some by their names; a name with a dot may be any key of the scene. Numbers are in SI, texts may have units. Values of
            parameters that are `whole` are rounded.

        Returns
        -------
        dict
            {name: value}
        """
        if not isinstance(x, dict):
            if len(x) != len(self.parameters):
                raise ValueError(f"a point has {len(x)} values, and {len(self.parameters)} parameters vary: {', '.join(self.names)}")
            x = dict(zip(self.names, x))
        for name in x:
            if name not in self._keys and "." not in name:
                raise ValueError(f"'{name}' is no parameter of {self._file}; there are {', '.join(self.names) or 'none'}, and keys of the scene such as objects.cube.place")
        return {name: value if isinstance(value, str) else _number(value, name in self._whole) for name, value in x.items()}

    def evaluate(self, parameters: dict | Sequence[float] | np.ndarray) -> dict:
        """Runs the case of a point, unless it has run.

        Parameters
        ----------
        parameters : dict or array_like
            The point, as of point().

        Returns
        -------
        dict
            The row of the table: case, parameters, status, error, statistics, counts, costs. A number that a case does not have, because it failed, is NaN.
        """
        return self.evaluate_all([parameters])[0]

    def evaluate_all(self, points: Sequence) -> list[dict]:
        """Runs the cases of several points side by side.

        Parameters
        ----------
        points : sequence of dict or of array_like
            The points, as of point(), all with the same parameters.

        Returns
        -------
        list of dict
            The rows of the table, in the order of the points.
        """
        asked = [self.point(x) for x in points]
        unique = {tuple(sorted(one.items())): one for one in asked}
        self._points.update(unique)
        rows = dict(zip(unique, self._rows(list(unique.values()))))
        return [rows[tuple(sorted(one.items()))] for one in asked]

    def _run(self, points: list[dict]) -> Batch:
        names = list(points[0])
        if any(sorted(one) != sorted(names) for one in points):
            raise ValueError("points that are evaluated together have values of the same parameters")
        keys = {self._keys.get(name, name): {"values": [one[name] for one in points], "as": name} for name in names}
        vary = overrides_of({"vary": [{"type": "zip", "keys": keys}] if names else []})
        with CaseProgram() as program:
            return Batch(_tack.batch(self._file, [*self._set, *vary], self._output, program, self._jobs, self._threads, [], self._failed, True))

    def _rows(self, points: list[dict]) -> list[dict]:
        table = self._run(points).table
        return [{name: column[row].item() for name, column in table.items()} for row in range(table.rows)]

    def finish(self) -> Batch:
        """Writes one table of all points that this object has evaluated.

        Returns
        -------
        Batch
            The results; nothing runs again.
        """
        if not self._points:
            raise ValueError("no point has been evaluated yet")
        return self._run(list(self._points.values()))

    def suggest(self, trial: Any) -> dict:
        """Asks a trial of Optuna, or of a program with its interface, for a point.

        Parameters
        ----------
        trial : optuna.trial.Trial
            The trial.

        Returns
        -------
        dict
            {name: value}, in SI.
        """
        return {one.name: one.suggest(trial) for one in self.parameters}

    def __repr__(self):
        return f"<study of {', '.join(self.names)}: {pathlib.Path(self._file).name}>"
