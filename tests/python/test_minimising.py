"""Minimisers and laws that are written in Python."""
import os
import pathlib
import re
import tempfile
import unittest
import warnings

import numpy as np

import tack
from tack_test_scenes import source, blocks, pull, small, falling, newton


class Minimising(unittest.TestCase):
    def test_derivatives_are_those_of_the_value(self):
        sim = tack.Simulation(blocks, set={**small, "contact.friction": None})  # whose second derivatives jump at rest
        for _ in range(12):
            sim.step()
        problem = sim.problem()
        q = problem.start
        rng = np.random.default_rng(1)
        p = rng.normal(size=problem.size) * 1e-3
        eps = 1e-4
        slope = (problem.value(q + eps * p) - problem.value(q - eps * p)) / (2 * eps)
        self.assertAlmostEqual(slope / (problem.gradient(q) @ p), 1, places=5)
        curve = (problem.gradient(q + eps * p) - problem.gradient(q - eps * p)) / (2 * eps)
        hessian = problem.hessian(q)
        self.assertLess(np.linalg.norm(curve - hessian @ p), 1e-5 * np.linalg.norm(curve))
        self.assertLess(abs(hessian - hessian.T).max(), 1e-9 * abs(hessian).max())
        self.assertGreater(np.linalg.eigvalsh(problem.hessian(q, "clamp").toarray()).min(), 0)
        sim.step()
        with self.assertRaisesRegex(RuntimeError, "is over"):
            problem.value(q)

    def test_cuts_and_bounds_of_a_step_are_listed(self):
        sim = tack.Simulation(blocks, set=small)
        for _ in range(12):
            sim.step()
        problem = sim.problem()
        q, p = problem.start, np.zeros(problem.size)
        p[1::3] = -0.05
        whole = problem.feasible_step(q, p)
        self.assertLess(whole, 1)
        cuts = problem.cuts(q, p)
        self.assertAlmostEqual(min(cut["step"] for cut in cuts) / whole, 1, places=4)  # additive CCD depends a little on its limit
        self.assertTrue({cut["kind"] for cut in cuts} <= {"edge_edge", "point_triangle", "tet"})
        self.assertTrue(all(set(cut["objects"]) <= {"floor", "lower", "upper"} for cut in cuts))
        self.assertTrue(all(0 <= block < problem.size / 3 for cut in cuts for block in cut["blocks"]))
        self.assertLess(len(problem.cuts(q, p, below=1.5 * whole)), len(cuts))
        together = problem.block_bounds(q, p)
        self.assertEqual(together.shape, (problem.size // 3,))
        self.assertGreater(problem.feasible_step(q, np.repeat(together, 3) * p), 0.95)
        self.assertTrue(np.all(problem.block_bounds(q, p, "alone") >= 0.97 * together))
        with self.assertRaisesRegex(ValueError, "together, alone"):
            problem.block_bounds(q, p, "both")

    def test_parts_add_up_and_pairs_are_close(self):
        sim = tack.Simulation(blocks, set=small)
        for _ in range(12):
            sim.step()
        problem = sim.problem()
        q = problem.start
        parts = problem.parts(q)
        self.assertEqual(parts[0]["name"], "inertia")
        self.assertAlmostEqual(sum(part["value"] for part in parts) / problem.value(q), 1, places=10)
        gradient = problem.gradient(q)
        np.testing.assert_allclose(sum(part["gradient"] for part in parts), gradient, atol=1e-10 * np.abs(gradient).max())
        self.assertTrue(any(part["dynamic"] for part in parts))
        pairs = problem.pairs(q, 1e-3)
        self.assertTrue(pairs)
        for pair in pairs:
            self.assertAlmostEqual(sum(pair["weights_first"]), 1)
            self.assertEqual(len(pair["second"]), len(pair["weights_second"]))
            self.assertLess(pair["gap"], 1e-3)
            self.assertAlmostEqual(np.linalg.norm(pair["normal"]), 1)
        with self.assertRaisesRegex(ValueError, "range of contact"):
            problem.pairs(q, 1.0)

    def test_the_documented_descent_ends_where_newton_does(self):
        page = (source / "docs/python.md").read_text(encoding="utf-8")
        code = re.search(r"```python\n(import numpy as np\nimport tack\n\ndef descend.*?)\nsim = ", page, re.S).group(1)
        self.assertLessEqual(len([line for line in code.splitlines() if line.strip()]), 20)
        scope = {}
        exec(code, scope)
        tight = {**small, "solver.tolerance": "1e-7 m/s"}
        own, newton = tack.Simulation(blocks, set=tight), tack.Simulation(blocks, set=tight)
        for _ in range(3):
            report = own.step(minimizer=scope["descend"])
            self.assertTrue(report["converged"])
            newton.step()
        size = np.ptp(newton.x)
        self.assertLess(np.abs(own.x - newton.x).max(), 1e-6 * size)

    def test_a_minimiser_moves_prescribed_vertices_through_obstacles(self):
        cube = {"shape": {"type": "box", "size": [0.1, 0.1, 0.1]}, "energies": [{"type": "neo_hookean", "young": "1 MPa", "poisson": 0.3, "density": 1000}]}
        pushed = {
            "name": "pushed",
            "time": {"step": "10 ms", "duration": "0.1 s"},
            "contact": {"distance": "1 mm"},
            "objects": [
                {"name": "cube", **cube},
                {"name": "plate", "shape": {"type": "box", "size": [0.2, 0.1, 0.2]}, "place": {"translate": [0, 0.103, 0]},
                 "motion": [{"type": "translate", "velocity": [0, -1, 0]}]},
            ],
        }
        own, scene = tack.Simulation(pushed, set={"solver.tolerance": "0.1 mm/s"}), tack.Simulation(pushed, set={"solver.tolerance": "0.1 mm/s"})
        for _ in range(3):
            own.step(minimizer=newton)
            scene.step()
        self.assertLess(np.abs(own.x - scene.x).max(), 1e-4)

    def test_values_are_infinite_at_infeasible_points(self):
        sim = tack.Simulation(falling)
        problem = sim.problem()
        self.assertTrue(np.isfinite(problem.value(problem.start)))
        self.assertEqual(problem.value(-problem.start), np.inf)  # inside out
        sim = tack.Simulation(blocks, set=small)
        problem = sim.problem()
        half = problem.size // 2  # the unknowns of either block
        through = problem.start + np.concatenate([np.tile([0, 0.1, 0], half // 3), np.zeros(half)])
        self.assertEqual(problem.value(through), np.inf)  # the lower block is partly within the upper one
        self.assertTrue(np.isfinite(problem.value(problem.start + np.tile([0, 0.1, 0], problem.size // 3))))

    def test_a_minimiser_that_fails(self):
        sim = tack.Simulation(blocks, set=small)
        for _ in range(12):
            sim.step()
        with self.assertRaisesRegex(TypeError, "returned nothing"):
            sim.step(minimizer=lambda problem: None)
        with self.assertRaisesRegex(KeyError, "mine"):
            sim.step(minimizer=lambda problem: {}["mine"])
        with self.assertRaisesRegex(tack.SimulationError, "step 13 .*the minimiser returned a point that has not converged: .* times "):
            sim.step(minimizer=lambda problem: problem.start)
        with self.assertRaisesRegex(ValueError, "what the minimiser returned"):
            sim.step(minimizer=lambda problem: np.nan * problem.start)

        def through(problem):
            return problem.start + np.concatenate([np.tile([0, 0.1, 0], problem.size // 6), np.zeros(problem.size // 2)])
        with self.assertRaisesRegex(tack.SimulationError, r"step 13 .*the minimiser returned a point that intersects: edge \(.* of '\w+' meets triangle .* of '\w+'"):
            sim.step(minimizer=through)
        sim.minimize_by(None)
        sim.step()
        self.assertEqual(sim.steps, 13)


class Laws(unittest.TestCase):
    def test_a_function_is_a_law(self):
        with tempfile.TemporaryDirectory() as folder:
            def traction(gap):
                return 300 * np.sin(np.pi * np.clip(gap / 4e-3, 0, 1)) ** 2
            law = tack.law(traction, reach=1e-3, file=f"{folder}/law.csv")
            thin = {"expect": [], "output.frames": False}
            peaks = []
            for height in (1, 2):
                law = tack.law(lambda gap: height * traction(gap), reach=4e-3, file=f"{folder}/law.csv")
                with warnings.catch_warnings():
                    warnings.simplefilter("ignore", tack.Warned)
                    results = tack.run(pull, set={**thin, "contact.pairs.0.adhesion": law}, output=f"{folder}/{height}")
                peaks.append(results.probes["adhesion"].max())
            area = 0.01  # m^2, of the plates
            self.assertAlmostEqual(peaks[0] / (300 * area), 1, delta=0.01)
            self.assertAlmostEqual(peaks[1] / peaks[0], 2, delta=0.02)

    def test_laws_have_files_of_their_own(self):
        before = pathlib.Path.cwd()
        with tempfile.TemporaryDirectory() as folder:
            try:
                os.chdir(folder)
                weak, strong = (tack.law(lambda gap: peak * np.exp(-gap / 1e-3), reach=1e-2, rows=20, cut=True) for peak in (1e3, 2e3))
                again = tack.law(lambda gap: 1e3 * np.exp(-gap / 1e-3), reach=1e-2, rows=20, cut=True)
                self.assertNotEqual(weak["file"], strong["file"])
                self.assertEqual(weak, again)
                self.assertEqual(np.loadtxt(weak["file"], delimiter=",", skiprows=1)[0, 1], 1e3)
                self.assertEqual(np.loadtxt(strong["file"], delimiter=",", skiprows=1)[0, 1], 2e3)
                self.assertEqual(len(list(pathlib.Path(folder).iterdir())), 2)
            finally:
                os.chdir(before)

    def test_wrong_laws_are_refused(self):
        for wrong, said in (({"reach": 0}, "positive length"), ({"reach": -1}, "positive length"), ({"reach": 1, "rows": 1}, "at least")):
            with self.assertRaisesRegex(ValueError, said):
                tack.law(lambda gap: 0 * gap, **wrong)
        with tempfile.TemporaryDirectory() as folder:
            with self.assertRaisesRegex(ValueError, "gap of 0 m is not a finite number"):
                with np.errstate(divide="ignore"):
                    tack.law(lambda gap: 1 / gap, reach=1e-3, file=f"{folder}/law.csv")

if __name__ == "__main__":
    unittest.main()
