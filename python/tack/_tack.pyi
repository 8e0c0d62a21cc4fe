"""The part of the package that is written in C++ (python/bindings), for editors and for the pages of the API. A test holds it against the module."""
from typing import Any

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
        """How many unknowns there are."""

    @property
    def start(self) -> np.ndarray:
        """Where the minimisation begins: unknowns without intersections."""

    def value(self, q: np.ndarray) -> float:
        """The incremental potential at q [J s^2; of quasi-static steps J]; infinite where surfaces intersect or elements are inverted."""

    def gradient(self, q: np.ndarray) -> np.ndarray:
        """Its gradient at q."""

    def hessian(self, q: np.ndarray, projection: str = "none") -> scipy.sparse.csc_matrix:
        """Its Hessian at q, a scipy.sparse.csc_matrix. projection: 'none', or that each stencil is made positive semi-definite, 'clamp' or 'absolute'."""

    def feasible_step(self, q: np.ndarray, p: np.ndarray) -> float:
        """The largest t in (0, 1] such that from q to q + t p nothing interpenetrates or inverts."""

    def parts(self, q: np.ndarray) -> list[dict]:
        """What value and gradient at q consist of: dictionaries with name ('inertia', or that of an energy), value, gradient, dynamic (whether its stencils change with the contacts) and stores (False: the dissipation of the step, as of friction). Values and gradients add up to value(q) and gradient(q)."""

    def pairs(self, q: np.ndarray, reach: float) -> list[dict]:
        """Pairs of primitives whose gap at q is below reach [m], which is at most the largest range of contact: dictionaries with kind ('edge_edge', 'point_triangle', ...), first and second (their vertices), weights_first and weights_second (of the vertices in the closest points), distance, gap (less the offset of the surfaces) [m], normal (from the second to the first) and objects."""

    def cuts(self, q: np.ndarray, p: np.ndarray, below: float = 1.0) -> list[dict]:
        """What by itself allows less than `below` of the step from q to q + p: dictionaries with kind ('edge_edge', 'point_triangle', 'tet', ...), step (the fraction that it allows), vertices (of the first primitive, then of the second), blocks (of three unknowns) and objects, in an order that does not depend on threads."""

    def block_bounds(self, q: np.ndarray, p: np.ndarray, kind: str = "together") -> np.ndarray:
        """For each block of three unknowns the fraction of p up to which it may move: 'together', whatever part of that each block makes, or 'alone', all others at rest."""

    def stopping_norm(self, p: np.ndarray, gradient: np.ndarray) -> float:
        """Of a Newton direction p and the gradient where it starts, over what is tolerated."""

    def converged(self, q: np.ndarray) -> bool:
        """Whether the minimisation may end at q, by the scene's own tolerances."""


def __getattr__(name: str) -> Any: ...
