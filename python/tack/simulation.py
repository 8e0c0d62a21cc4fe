"""Simulations stepped from Python, and runs with recorded results."""
from __future__ import annotations

import os
import pathlib
import tempfile
import warnings
from typing import Callable

import numpy as np

from . import _tack
from .contacts import pair_sums
from .results import Run, shown
from .scene_object import Object
from .scene import opened, overrides_of


class Warned(UserWarning):
    """A warning: the simulation goes on, but its results may be worth less than they seem.

    `kind` is one of those of docs/results.md.
    """

    def __init__(self, text: str, kind: str = ""):
        super().__init__(text)
        self.kind = kind


class Simulation:
    """A scene ready to be stepped. It writes no files.

    Parameters
    ----------
    scene : str or os.PathLike or dict
        The path of a file, or a dictionary with the same keys.
    set : dict, optional
        Keys of the scene and their new values, `{"objects.plate.place.translate": [0, 0.1, 0], "time.step": "2 ms"}`.
    threads : int, optional
        Number of threads of the simulation; 0: all cores.

    Raises
    ------
    InputError
        The scene cannot be simulated; the message has file, line and remedy.
    """

    def __init__(self, scene: str | os.PathLike | dict, set: dict | None = None, threads: int = 0):
        path, text = opened(scene)
        if text:
            self._running = _tack.Running.parse(text, path, overrides_of(set), threads)
        else:
            self._running = _tack.Running.open(path, overrides_of(set), threads)
        self._changes: list[dict] = []
        self._objects = {known.name: Object(self._running, known) for known in self._running.objects}
        self._warn()

    @property
    def objects(self) -> dict:
        """The objects of the scene by name."""
        return self._objects

    @property
    def name(self) -> str:
        """The name of the scene."""
        return self._running.name

    @property
    def time(self) -> float:
        """The time at the end of the last step [s]."""
        return self._running.time

    @property
    def steps(self) -> int:
        """The number of steps so far."""
        return self._running.step_count

    @property
    def duration(self) -> float:
        """The time at which the scene ends [s]."""
        return self._running.duration

    @property
    def step_size(self) -> float:
        """The size that the next step tries [s]."""
        return self._running.step_size

    @property
    def finished(self) -> bool:
        """True when the scene has ended."""
        return self._running.finished

    @property
    def threads(self) -> int:
        """The number of threads that compute a step."""
        return self._running.threads

    @property
    def x(self) -> np.ndarray:
        """Positions of all vertices (n, 3) [m]: a view that always shows the last step; copy it to keep it. Assign to it to move vertices."""
        return self._running.x

    @x.setter
    def x(self, positions):
        self.move(x=positions)

    @property
    def v(self) -> np.ndarray:
        """Velocities of all vertices (n, 3) [m/s]: a view, as x is. Assign to it to change them."""
        return self._running.v

    @v.setter
    def v(self, velocities):
        self.move(v=velocities)

    @property
    def rest(self) -> np.ndarray:
        """Positions without stress (n, 3) [m]."""
        return self._running.rest

    @property
    def mass(self) -> np.ndarray:
        """Masses of the vertices, and of unknowns that are no vertices [kg]."""
        return self._running.mass

    def __getitem__(self, name: str) -> Object:
        """Returns an object of the scene.

        Parameters
        ----------
        name : str
            Its name.

        Returns
        -------
        Object
            The object.
        """
        return self._objects[name]

    def move(self, x: np.ndarray | None = None, v: np.ndarray | None = None):
        """Sets positions and velocities and continues from them, as a run that starts there. Equal values change nothing.

        Parameters
        ----------
        x : np.ndarray, optional
            Positions (n, 3) [m]; None: unchanged.
        v : np.ndarray, optional
            Velocities (n, 3) [m/s]; None: unchanged.

        Raises
        ------
        InputError
            The positions intersect, invert elements, or deform an affine body other than affinely. Nothing has changed.
        """
        self._running.move(x, v)

    def change(self, set: dict):
        """Changes keys of the scene between steps and continues: parameters, motions, loads, laws, protocols.

        Vertices stay, and so does how many motions and stages there are. Motions go on from where their vertices are. The changes are kept in `changes`.

        Parameters
        ----------
        set : dict
            Keys of the scene and their new values, as of the constructor.

        Raises
        ------
        InputError
            The changed scene cannot go on from here. Nothing has changed.
        """
        self._running.change(overrides_of(set))
        for known in self._running.objects:
            self._objects[known.name]._known = known
        self._changes += [{"time": self.time, "step": self.steps, "key": key, "value": value} for key, value in set.items()]
        self._warn()

    @property
    def changes(self) -> list:
        """The changes so far, in their order: dictionaries of time [s], step, key and value. scene() has them all."""
        return list(self._changes)

    @property
    def stages(self) -> list:
        """The stages of protocols that have begun: dictionaries of protocol, stage, number, begin [s], end [s], ended_by and value."""
        return self._running.stages()

    def step(self, minimizer: Callable[[_tack.Problem], np.ndarray] | None = None) -> dict:
        """Takes one time step.

        Parameters
        ----------
        minimizer : Callable[[_tack.Problem], np.ndarray], optional
            A function of a Problem that returns the unknowns at the minimum; it replaces the minimiser of the scene from now on.

        Returns
        -------
        dict
            A dictionary about the step: iterations, status, contacts, smallest gap, ...

        Raises
        ------
        SimulationError
            No permitted step size succeeds.
        """
        if minimizer is not None:
            self.minimize_by(minimizer)
        try:
            return self._running.step()
        finally:
            self._warn()

    def minimize_by(self, minimizer: Callable[[_tack.Problem], np.ndarray] | None):
        """Sets the minimiser of all further steps.

        Parameters
        ----------
        minimizer : Callable[[_tack.Problem], np.ndarray] or None
            A function as for step(), or None: the minimiser of the scene.
        """
        self._running.minimize_by(minimizer)

    def run(self, until: float | None = None, callback: Callable[[Simulation], object] | None = None) -> Simulation:
        """Steps to a time, or to the end of the scene.

        Parameters
        ----------
        until : float, optional
            The time [s]; None: the end of the scene.
        callback : Callable[[Simulation], object], optional
            A function of the simulation that is called after each step; if it returns False, that step was the last.

        Returns
        -------
        Simulation
            The simulation.
        """
        end = self.duration if until is None else min(until, self.duration)
        while self.time < end - 1e-9 * self.step_size and not self.finished:
            self.step()
            if callback is not None and callback(self) is False:
                break
        return self

    def problem(self) -> _tack.Problem:
        """Returns the incremental potential of the next step, without making the step. Valid until the next call or step."""
        return self._running.problem()

    def energies(self) -> dict:
        """Returns energies by name [J]."""
        return self._running.energies()

    def forces(self) -> dict:
        """Returns forces on vertices (n, 3) [N] by term of the potential."""
        return self._running.forces()

    def field(self, name: str) -> np.ndarray:
        """Returns a field of frames.

        Parameters
        ----------
        name : str
            Its name in `output.fields`: contact_pressure, gap, von_mises_stress, ...

        Returns
        -------
        ndarray
            One row per vertex, or per element in the order of frames.
        """
        return self._running.field(name)

    def contacts(self, force: str = "contact", part: str = "") -> np.ndarray:
        """Returns the points at which a force between surfaces acts, a row per quadrature point.

        The forces of all rows add up to those that act between the objects: those of `contact` to `forces()["contact"]`, object by object.

        Parameters
        ----------
        force : str, optional
            'contact' (barrier and adhesion), 'friction', 'bonds', or 'clipped_adhesion' of `contact.model: clipped`.
        part : str, optional
            'barrier' or 'adhesion' of contact and bonds, 'friction' or 'adhesion' of friction; default: the whole force.

        Returns
        -------
        ndarray
            A structured array: object and opposite (positions in `objects`), vertices and opposite_vertices (3, -1: none) of the two primitives with their weights and
            opposite_weights, point and opposite_point (3) [m], normal (3, from the opposite point to the point), gap [m], area (quadrature weight, negative where a point is
            counted twice) [m^2], normal_force (that presses; negative: pulls) [N], force (3, on `object`) [N]. Rows of friction have the area, the closest points and the
            normal force of the start of the step, with which it lags.

        Raises
        ------
        ValueError
            The force has no points, or no such part.
        """
        return self._running.contacts(force, part)

    def contact_pairs(self, force: str = "contact", part: str = "") -> np.ndarray:
        """Returns sums of contacts() for each pair of objects.

        Parameters
        ----------
        force : str, optional
            As of contacts().
        part : str, optional
            As of contacts().

        Returns
        -------
        ndarray
            A structured array: first and second (names), points, area [m^2], normal_force [N], force (3, on the first object) [N].
        """
        return pair_sums(self.contacts(force, part), list(self._objects))

    @property
    def pressures(self) -> np.ndarray:
        """Contact pressure of the vertices [Pa], positive in compression."""
        return self.field("contact_pressure")

    @property
    def gaps(self) -> np.ndarray:
        """Gap of the vertices to the nearest surface [m]; NaN where none is within range of the laws."""
        return self.field("gap")

    def scene(self) -> str:
        """Returns the scene as YAML, with all defaults resolved."""
        return self._running.scene()

    def probes(self) -> dict:
        """Returns the present values of the scene's probes by column."""
        return dict(zip(self._running.probe_columns(), self._running.probe_values()))

    def _repr_html_(self):
        with tempfile.TemporaryDirectory() as folder:
            frame = pathlib.Path(folder) / "run" / "frame_000000.vtu"  # names of scenes may have slashes
            frame.parent.mkdir()
            self._running.write_frame(str(frame))
            (frame.parent / "scene.yaml").write_text(self.scene(), encoding="utf-8")
            (frame.parent / "run.pvd").write_text(
                f'<VTKFile type="Collection"><Collection><DataSet timestep="{self.time!r}" file="{frame.name}"/></Collection></VTKFile>', encoding="ascii")
            return shown(frame.parent, self.name, "done" if self.finished else "")

    def _warn(self):
        for text, kind in self._running.take_warnings():
            warnings.warn(Warned(text, kind), stacklevel=3)

    def __repr__(self):
        reached = f"finished at {self.time:g} s" if self.finished else f"at {self.time:g} s of {self.duration:g} s"
        return f"<simulation '{self.name}' {reached}, {len(self.x)} vertices>"


def run(scene: str | os.PathLike | dict, set: dict | None = None, output: str | os.PathLike = "", threads: int = 0, steps: int = 0,
        resume: bool = False, quiet: bool = True) -> Run:
    """Runs a scene as `tack run` does.

    Parameters
    ----------
    scene : str or os.PathLike or dict
        The path of a file, or a dictionary with the same keys.
    set : dict, optional
        Keys of the scene and their new values.
    output : str or os.PathLike, optional
        The folder of the results; default: `results/` and the name of the scene.
    threads : int, optional
        Number of threads of the run; 0: all cores.
    steps : int, optional
        Limit of steps; 0: to the end.
    resume : bool, optional
        Continue from the newest checkpoint of the folder.
    quiet : bool, optional
        Nothing is printed.

    Returns
    -------
    Run
        The results, as of read().

    Raises
    ------
    InputError
        The scene cannot be simulated.
    SimulationError
        The run fails; its results until then stay.
    """
    path, text = opened(scene)
    return Run(_tack.record(path, text, overrides_of(set), str(output), threads, steps, resume, quiet))


