"""Scenes and helpers that the tests of the package share."""
import pathlib
import subprocess
import sys

import numpy as np

source = pathlib.Path(__file__).resolve().parents[2]
blocks = source / "experiments/stack/two_blocks.yaml"
pull = source / "experiments/debonding/pull.yaml"
small = {"objects.lower.shape.cells": [2, 2, 2], "objects.upper.shape.cells": [2, 2, 2]}

falling = {
    "name": "falling",
    "time": {"step": "10 ms", "duration": "0.1 s"},
    "gravity": [0, -10, 0],
    "objects": [{
        "name": "cube",
        "shape": {"type": "box", "size": [0.1, 0.1, 0.1], "cells": [1, 1, 1]},
        "energies": [{"type": "neo_hookean", "young": "1 MPa", "poisson": 0.3, "density": 1000}],
    }],
    "probes": [{"name": "height", "type": "centre_of_mass", "object": "cube", "direction": [0, 1, 0]}],
}


def newton(problem):
    """Projected Newton with backtracking."""
    q = problem.start
    while not problem.converged(q):
        gradient = problem.gradient(q)
        p = -np.linalg.solve(problem.hessian(q, "clamp").toarray(), gradient)
        value, t = problem.value(q), problem.feasible_step(q, p)
        while problem.value(q + t * p) > value + 1e-4 * t * (p @ gradient) and t > 1e-10:
            t /= 2
        q = q + t * p
    return q


def run_python(code, **options):
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=120, **options)
