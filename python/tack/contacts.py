"""Sums over the points of Simulation.contacts()."""
from __future__ import annotations

from typing import Sequence

import numpy as np


def pair_sums(points: np.ndarray, names: Sequence[str]) -> np.ndarray:
    """Returns sums of points between surfaces for each pair of objects.

    Parameters
    ----------
    points : ndarray
        Points of Simulation.contacts().
    names : sequence of str
        Names of the objects, in the order of the scene.

    Returns
    -------
    ndarray
        A structured array: first and second (names), points, area [m^2], normal_force [N], force (3, on the first object) [N].
    """
    longest = max([1, *(len(name) for name in names)])
    sums_type = [("first", f"U{longest}"), ("second", f"U{longest}"), ("points", int), ("area", float), ("normal_force", float), ("force", float, 3)]
    low, high = np.minimum(points["object"], points["opposite"]), np.maximum(points["object"], points["opposite"])
    pairs, at = np.unique(np.stack([low, high], axis=1), axis=0, return_inverse=True)
    sums = np.zeros(len(pairs), dtype=sums_type)
    if len(pairs) == 0:
        return sums
    sums["first"], sums["second"] = (np.array(list(names))[pairs[:, side]] for side in (0, 1))
    sums["points"] = np.bincount(at, minlength=len(pairs))
    for field in ("area", "normal_force"):
        sums[field] = np.bincount(at, points[field], len(pairs))
    # In self-contact both sides are of the first object, and the net force is zero.
    sign = np.where(low == high, 0, np.where(points["object"] == low, 1, -1))
    for axis in range(3):
        sums["force"][:, axis] = np.bincount(at, sign * points["force"][:, axis], len(pairs))
    return sums
