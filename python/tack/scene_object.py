"""Objects of the scene in a simulation."""
from __future__ import annotations

import numpy as np


class Object:
    """An object of the scene in its simulation."""

    def __init__(self, running, known):
        self._running, self._known = running, known
        self.name = known.name
        self.vertices = slice(known.first_vertex, known.first_vertex + known.vertex_count)

    @property
    def x(self) -> np.ndarray:
        """Its positions (n, 3) [m], a view."""
        return self._running.x[self.vertices]

    @property
    def v(self) -> np.ndarray:
        """Its velocities (n, 3) [m/s], a view."""
        return self._running.v[self.vertices]

    @property
    def tets(self) -> np.ndarray:
        """Tetrahedra (n, 4), by vertices of the scene counted from 0."""
        return self._known.tets

    @property
    def triangles(self) -> np.ndarray:
        """Triangles (n, 3) of the surface, oriented outwards, and of sheets."""
        return self._known.triangles

    @property
    def edges(self) -> np.ndarray:
        """Edges (n, 2) of rods."""
        return self._known.edges

    @property
    def points(self) -> np.ndarray:
        """Vertices that are particles."""
        return self._known.points

    def __repr__(self):
        return f"<object '{self.name}': {self.vertices.stop - self.vertices.start} vertices>"
