"""The part of the package that is written in C++ (python/bindings), for editors and for the pages of the API. A test holds it against the module."""
from typing import Any, Callable

import numpy as np
import scipy.sparse

version: str
revision: str


class InputError(ValueError):
    """A scene, a file or an argument that cannot be used: file, line and remedy."""


class SimulationError(RuntimeError):
    """A simulation that cannot go on."""


class Problem:
    """The incremental potential of one step, as a function of its unknowns q: the coordinates of all vertices that are free, one after the other [m].

    Valid until the step ends.
    """

    @property
    def size(self) -> int:
        """Number of unknowns."""

    @property
    def start(self) -> np.ndarray:
        """Unknowns where the minimisation begins, without intersections."""

    def value(self, q: np.ndarray) -> float:
        """Returns the incremental potential.

        Parameters
        ----------
        q : array_like
            Unknowns (n,) [m].

        Returns
        -------
        float
            [J s^2; of quasi-static steps J]; infinite where surfaces intersect or elements are inverted.
        """

    def gradient(self, q: np.ndarray) -> np.ndarray:
        """Returns the gradient of the incremental potential.

        Parameters
        ----------
        q : array_like
            Unknowns (n,) [m].

        Returns
        -------
        ndarray
            (n,), in the unit of the value per metre.
        """

    def hessian(self, q: np.ndarray, projection: str = "none") -> scipy.sparse.csc_matrix:
        """Returns the Hessian of the incremental potential.

        Parameters
        ----------
        q : array_like
            Unknowns (n,) [m].
        projection : {'none', 'clamp', 'absolute'}
            Makes each stencil positive semi-definite: `clamp` sets negative eigenvalues to zero, `absolute` reverses their sign.

        Returns
        -------
        scipy.sparse.csc_matrix
            (n, n).
        """

    def feasible_step(self, q: np.ndarray, p: np.ndarray) -> float:
        """Returns the largest step without intersection and inversion.

        Parameters
        ----------
        q : array_like
            Unknowns (n,) [m].
        p : array_like
            A direction (n,) [m].

        Returns
        -------
        float
            The largest t in (0, 1] such that nothing intersects or inverts from q to q + t p.
        """

    def parts(self, q: np.ndarray) -> list[dict]:
        """Returns the terms of value and gradient.

        Parameters
        ----------
        q : array_like
            Unknowns (n,) [m].

        Returns
        -------
        list of dict
            name ('inertia', or that of an energy), value, gradient, dynamic (its stencils change with the contacts) and stores (False: the dissipation of the step, as of friction).
            Values and gradients add up to value(q) and gradient(q).
        """

    def pairs(self, q: np.ndarray, reach: float) -> list[dict]:
        """Returns pairs of primitives that are close.

        Parameters
        ----------
        q : array_like
            Unknowns (n,) [m].
        reach : float
            Largest gap [m]; at most the largest range of contact.

        Returns
        -------
        list of dict
            kind ('edge_edge', 'point_triangle', ...), first and second (their vertices), weights_first and weights_second (of the vertices in the closest points), distance,
            gap (less the offset of the surfaces) [m], normal (from the second to the first) and objects.
        """

    def cuts(self, q: np.ndarray, p: np.ndarray, below: float = 1.0) -> list[dict]:
        """Returns what by itself bounds the step from q to q + p.

        Parameters
        ----------
        q : array_like
            Unknowns (n,) [m].
        p : array_like
            A direction (n,) [m].
        below : float
            Bounds below this fraction of the step are returned.

        Returns
        -------
        list of dict
            kind ('edge_edge', 'point_triangle', 'tet', ...), step (the fraction that it allows), vertices (of the first primitive, then of the second), blocks (of three unknowns)
            and objects, in an order that does not depend on threads.
        """

    def block_bounds(self, q: np.ndarray, p: np.ndarray, kind: str = "together") -> np.ndarray:
        """Returns how far each block of three unknowns may move.

        Parameters
        ----------
        q : array_like
            Unknowns (n,) [m].
        p : array_like
            A direction (n,) [m].
        kind : {'together', 'alone'}
            `together`: whatever fraction of its bound each block moves; `alone`: while all others are at rest.

        Returns
        -------
        ndarray
            A fraction of p per block.
        """

    def stopping_norm(self, p: np.ndarray, gradient: np.ndarray) -> float:
        """Returns the stopping norm of a Newton direction.

        Parameters
        ----------
        p : array_like
            A Newton direction (n,) [m].
        gradient : array_like
            The gradient (n,) where the direction starts.

        Returns
        -------
        float
            In tolerances: 1 is tolerated.
        """

    def converged(self, q: np.ndarray) -> bool:
        """Returns whether the minimisation may end at q, by the scene's own tolerances.

        Parameters
        ----------
        q : array_like
            Unknowns (n,) [m].

        Returns
        -------
        bool
            True if it may.
        """


class Object:
    """An object of the scene: its name, its vertices among all, its elements."""

    @property
    def name(self) -> str: ...
    @property
    def first_vertex(self) -> int: ...
    @property
    def vertex_count(self) -> int: ...
    @property
    def tets(self) -> np.ndarray: ...
    @property
    def triangles(self) -> np.ndarray: ...
    @property
    def edges(self) -> np.ndarray: ...
    @property
    def points(self) -> list[int]: ...


class Running:
    """A simulation that is stepped. tack.Simulation is made on it."""

    @staticmethod
    def open(path: str, set: list[str], threads: int) -> Running: ...
    @staticmethod
    def parse(text: str, name: str, set: list[str], threads: int) -> Running: ...
    @property
    def name(self) -> str: ...
    @property
    def time(self) -> float: ...
    @property
    def step_count(self) -> int: ...
    @property
    def duration(self) -> float: ...
    @property
    def step_size(self) -> float: ...
    @property
    def finished(self) -> bool: ...
    @property
    def threads(self) -> int: ...
    @property
    def objects(self) -> list[Object]: ...
    @property
    def x(self) -> np.ndarray: ...
    @property
    def v(self) -> np.ndarray: ...
    @property
    def rest(self) -> np.ndarray: ...
    @property
    def mass(self) -> np.ndarray: ...
    def step(self) -> dict: ...
    def minimize_by(self, function: Callable[[Problem], np.ndarray] | None) -> None: ...
    def move(self, x: np.ndarray | None = None, v: np.ndarray | None = None) -> None: ...
    def change(self, set: list[str]) -> None: ...
    def stages(self) -> list[dict]: ...
    def energies(self) -> dict[str, float]: ...
    def forces(self) -> dict[str, np.ndarray]: ...
    def field(self, name: str) -> np.ndarray: ...
    def contacts(self, force: str, summand: str) -> np.ndarray: ...
    def scene(self) -> str: ...
    def write_frame(self, path: str) -> None: ...
    def probe_columns(self) -> list[str]: ...
    def probe_values(self) -> list[float]: ...
    def problem(self) -> Problem: ...
    def take_warnings(self) -> list[tuple[str, str]]: ...


class Fit:
    """A calibration for optimisers. tack.Calibration is made on it."""

    def __init__(self, path: str, set: list[str], output: str, program: str, jobs: int, threads: int, failed: bool) -> None: ...
    @property
    def folder(self) -> str: ...
    def parameters(self) -> list[dict]: ...
    def experiments(self) -> list[dict]: ...
    def design(self, count: int) -> list[list[float]]: ...
    def evaluate(self, points: list[list[float]], derivatives: bool) -> list[dict]: ...
    def jacobian(self, point: list[float]) -> dict: ...
    def write_tables(self) -> None: ...


def let_termination_interrupt() -> None: ...
def record(path: str, text: str, set: list[str], output: str, threads: int, steps: int, resume: bool, quiet: bool) -> str: ...
def kind_of(folder: str) -> str: ...
def units(folder: str) -> dict: ...
def export(folder: str, to: str, output: str, settings: list[str]) -> list[str]: ...
def report(folders: list[str], output: str, frames: int, status: str) -> str: ...
def solve(path: str, solvers: list[str], set: list[str], plugins: list[str], threads: int, minimum: bool, functions: list[Any]) -> list[dict]: ...
def compare(path: str, set: list[str], output: str, threads: int, quiet: bool) -> str: ...
def batch(path: str, set: list[str], output: str, program: str, jobs: int, threads: int, only: list[str], failed: bool, quiet: bool) -> str: ...
def varied(path: str, set: list[str]) -> list[dict]: ...
def calibrate(path: str, set: list[str], output: str, program: str, jobs: int, threads: int, failed: bool, quiet: bool) -> str: ...
