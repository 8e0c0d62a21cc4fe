"""Calibrations for optimisers from elsewhere: residuals and misfit as functions of the fitted parameters."""
from __future__ import annotations

import dataclasses
import os
import pathlib
from typing import Any, Sequence

import numpy as np

from . import _tack
from .case_program import CaseProgram
from .scene import overrides_of


@dataclasses.dataclass(frozen=True)
class Parameter:
    """A parameter that a calibration fits or a study varies.

    `low`, `high` and `start` are in SI; `unit` is "1" for a plain number. `log`: its scale is logarithmic. `keys` are the keys of the scenes, `values` those that the
    file of a study lists. `whole`: its values are whole numbers, in SI. A study has no `start`, and neither `low` nor `high` for a list of values.
    """

    name: str
    low: float | None
    high: float | None
    start: float | None = None
    log: bool = False
    unit: str = "1"
    keys: tuple[str, ...] = ()
    values: tuple[str, ...] = ()
    whole: bool = False

    def suggest(self, trial: Any) -> Any:
        """Asks a trial of Optuna, or of a program with its interface, for a value.

        Parameters
        ----------
        trial : optuna.trial.Trial
            The trial, with suggest_float, suggest_int and suggest_categorical.

        Returns
        -------
        float or int or str
            The value, in SI, or one of `values`.
        """
        if self.values:
            return trial.suggest_categorical(self.name, list(self.values))
        if self.whole:
            return trial.suggest_int(self.name, int(self.low or 0), int(self.high or 0), log=self.log)
        return trial.suggest_float(self.name, self.low, self.high, log=self.log)


class Scaled:
    """A calibration in the coordinates u of its own search: ln(value) of a logarithmic parameter, else 3 value / (high - low).

    A step of 0.15 is 15% of a value, or 5% of a range: one size for all parameters, as optimisers expect. `start` (n,) and `bounds` (n, 2) are in u.
    """

    def __init__(self, calibration: Calibration):
        self._calibration = calibration
        self._log = np.array([one.log for one in calibration.parameters])
        self._width = (calibration.bounds[:, 1] - calibration.bounds[:, 0]) / 3
        self.start = self.u(calibration.start)
        self.bounds = np.stack([self.u(side) for side in calibration.bounds.T], axis=1)

    def u(self, x: Sequence[float] | np.ndarray) -> np.ndarray:
        """Returns the coordinates of values.

        Parameters
        ----------
        x : array_like
            Values (n,) in SI.

        Returns
        -------
        ndarray
            u (n,).
        """
        x = np.asarray(x, dtype=float)
        return np.where(self._log, np.log(np.where(self._log, x, 1)), x / self._width)

    def values(self, u: Sequence[float] | np.ndarray) -> np.ndarray:
        """Returns the values at coordinates.

        Parameters
        ----------
        u : array_like
            Coordinates (n,).

        Returns
        -------
        ndarray
            Values (n,) in SI.
        """
        u = np.asarray(u, dtype=float)
        return np.where(self._log, np.exp(np.where(self._log, u, 0)), u * self._width)

    def residuals(self, u: Sequence[float] | np.ndarray) -> np.ndarray:
        """Returns Calibration.residuals at coordinates.

        Parameters
        ----------
        u : array_like
            Coordinates (n,).

        Returns
        -------
        ndarray
            Residuals (m,).
        """
        return self._calibration.residuals(self.values(u))

    def misfit(self, u: Sequence[float] | np.ndarray) -> float:
        """Returns Calibration.misfit at coordinates.

        Parameters
        ----------
        u : array_like
            Coordinates (n,).

        Returns
        -------
        float
            The misfit.
        """
        return self._calibration.misfit(self.values(u))

    def jacobian(self, u: Sequence[float] | np.ndarray) -> np.ndarray:
        """Returns the derivatives of the residuals by the coordinates.

        Parameters
        ----------
        u : array_like
            Coordinates (n,).

        Returns
        -------
        ndarray
            (m, n).
        """
        x = self.values(u)
        return self._calibration.jacobian(x) * np.where(self._log, x, self._width)


class Calibration:
    """The problem that a calibration file poses, for an optimiser of one's own: parameters, residuals, misfit, derivatives.

    Points are evaluated by the runs of `tack calibrate`, processes side by side, in the same folder: none runs twice, also in a later call, and `tack.calibrate` with the same
    output finds them. Values have six digits; take derivatives from jacobian(), not from small differences. Call it from the main thread. Its folder is open until close(), or
    until the end of a `with` block.

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

    Raises
    ------
    InputError
        The file cannot be used.
    """

    def __init__(self, calibration: str | os.PathLike, set: dict | None = None, output: str | os.PathLike = "", jobs: int = 0, threads: int = 0, failed: bool = False):
        self._program = CaseProgram()
        self._fit: _tack.Fit | None = _tack.Fit(os.fspath(calibration), overrides_of(set), os.fspath(output), self._program.path, jobs, threads, failed)
        self.path = pathlib.Path(self._fit.folder)
        self.experiments = self._fit.experiments()
        self.parameters = [self._parameter(one) for one in self._fit.parameters()]
        self.names = [one.name for one in self.parameters]
        self.start = np.array([one.start for one in self.parameters])
        self.bounds = np.array([(one.low, one.high) for one in self.parameters])
        self.scaled = Scaled(self)

    @staticmethod
    def _parameter(known: dict) -> Parameter:
        keys = {key for of_experiment in known["keys"] for key in of_experiment}
        return Parameter(known["name"], known["low"], known["high"], known["start"], known["log"], known["unit"], tuple(sorted(keys)))

    def _opened(self) -> _tack.Fit:
        if self._fit is None:
            raise RuntimeError(f"the calibration in {self.path} is closed; make another tack.Calibration of its file")
        return self._fit

    def point(self, x: Sequence[float] | np.ndarray | dict) -> list[float]:
        """Returns the values of a point in the order of the parameters.

        Parameters
        ----------
        x : array_like or dict
            Values (n,) in SI, or a value for each name.

        Returns
        -------
        list of float
            The values.
        """
        if isinstance(x, dict):
            if sorted(x) != sorted(self.names):
                raise ValueError(f"a point needs a value for each of {', '.join(self.names)}, and has {', '.join(x) or 'none'}")
            x = [x[name] for name in self.names]
        return [float(one) for one in np.asarray(x, dtype=float)]

    def evaluate(self, points: Sequence, derivatives: bool = False) -> list[dict]:
        """Evaluates points, their runs side by side.

        Parameters
        ----------
        points : sequence of array_like or of dict
            The points, as of point().
        derivatives : bool, optional
            The runs compute sensitivities as well, for jacobian().

        Returns
        -------
        list of dict
            For each point: values (as evaluated), status ('done', or why a run failed), error, misfit (infinite if a run failed), misfits (by experiment), residuals (None if a
            run failed).
        """
        return self._opened().evaluate([self.point(x) for x in points], derivatives)

    def residuals(self, x: Sequence[float] | np.ndarray | dict) -> np.ndarray:
        """Returns the residuals of a point: sqrt(weight) (run - measured) / noise.

        Parameters
        ----------
        x : array_like or dict
            The point, as of point().

        Returns
        -------
        ndarray
            (m,): the measured points of all experiments, in the order of `experiments`; infinite if a run failed.
        """
        found = self.evaluate([x])[0]["residuals"]
        return np.full(sum(one["points"] for one in self.experiments), np.inf) if found is None else found

    def misfit(self, x: Sequence[float] | np.ndarray | dict) -> float:
        """Returns the sum of squared residuals of a point.

        Parameters
        ----------
        x : array_like or dict
            The point, as of point().

        Returns
        -------
        float
            The misfit; infinite if a run failed.
        """
        return self.evaluate([x])[0]["misfit"]

    def jacobian(self, x: Sequence[float] | np.ndarray | dict) -> np.ndarray:
        """Returns the derivatives of the residuals by the parameters: sensitivities of the runs where they give them, else central differences of further runs.

        Parameters
        ----------
        x : array_like or dict
            The point, as of point().

        Returns
        -------
        ndarray
            (m, n), per unit of the parameters in SI.

        Raises
        ------
        SimulationError
            A run failed.
        """
        return self._opened().jacobian(self.point(x))["jacobian"]

    def design(self, count: int) -> np.ndarray:
        """Returns points that fill the ranges evenly (Sobol), on the scales of the parameters.

        Parameters
        ----------
        count : int
            Number of points.

        Returns
        -------
        ndarray
            (count, n), in SI.
        """
        return np.array(self._opened().design(count))

    def suggest(self, trial: Any) -> np.ndarray:
        """Asks a trial of Optuna, or of a program with its interface, for a point.

        Parameters
        ----------
        trial : optuna.trial.Trial
            The trial.

        Returns
        -------
        ndarray
            The point (n,), in SI.
        """
        return np.array([one.suggest(trial) for one in self.parameters])

    def close(self) -> None:
        """Writes the table of the runs and releases the folder."""
        if self._fit is not None:
            self._fit.write_tables()
            self._fit = None

    def __enter__(self) -> Calibration:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __repr__(self):
        return f"<calibration of {', '.join(self.names)}: {self.path}>"
