"""Simulations that step: against closed forms, the program, callbacks and threads."""
import contextlib
import re
import tempfile
import threading
import time
import unittest
import warnings

import numpy as np

import tack
from tack_test_scenes import blocks, small, falling, newton, source


class Stepping(unittest.TestCase):
    def test_a_cube_falls_by_the_integrator_s_own_closed_form(self):
        sim = tack.Simulation(falling)
        start = sim.probes()["height"]
        sim.run()
        n, h = sim.steps, 0.01
        self.assertEqual(n, 10)
        self.assertTrue(sim.finished)
        self.assertAlmostEqual(sim.probes()["height"] - start, -10 * h * h * n * (n + 1) / 2, places=9)
        np.testing.assert_allclose(sim.v[:, 1], -10 * h * n, rtol=1e-7)

    def test_steps_give_the_results_of_the_program(self):
        with tempfile.TemporaryDirectory() as folder:
            kept = tack.run(blocks, set={**small, "output.frames": True, "time.duration": "0.1 s"}, output=f"{folder}/kept")
            sim = tack.Simulation(blocks, set={**small, "time.duration": "0.1 s"})
            values = [sim.probes()]
            sim.run(callback=lambda s: values.append(s.probes()))
            for name in values[0]:
                np.testing.assert_array_equal(kept.probes[name], [v[name] for v in values])
            np.testing.assert_array_equal(kept.frames[-1].x, sim.x)
            self.assertEqual(len(kept.steps["time"]), sim.steps)
            self.assertEqual(kept.summary["status"], tack.read(f"{folder}/kept").summary["status"])

    def test_a_run_is_exported(self):
        with tempfile.TemporaryDirectory() as folder:
            kept = tack.run(blocks, set={**small, "output.frames": True, "time.duration": "0.1 s"}, output=f"{folder}/kept")
            caches = kept.export("pc2", fps=25)
            self.assertEqual(str(caches), f"{folder}/kept/export/pc2")
            words = np.fromfile(next(caches.glob("*.pc2")), dtype="<i4")
            self.assertEqual(words[7], 3)  # samples
            self.assertEqual(tack.export(kept.path, "usd", f"{folder}/run.usda").name, "run.usda")
            self.assertIsNone(kept.export("vtu"))
            with self.assertRaisesRegex(tack.InputError, "did you mean 'pc2'"):
                kept.export("pc3")

    def test_the_snippet_of_the_README_runs_to_the_end(self):
        page = (source / "README.md").read_text(encoding="utf-8")
        code = re.search(r"```python\n(.*?)```", page, re.S).group(1)
        printed = []
        scope = {"print": lambda *values: printed.append(values)}
        exec(code.replace("experiments/", f"{source}/experiments/"), scope)
        self.assertTrue(scope["sim"].finished)
        self.assertEqual(len(printed), scope["sim"].steps)
        self.assertAlmostEqual(max(adhesion for _, adhesion in printed), 10, delta=0.1)

    def test_threads_give_the_same_bits(self):
        ends = []
        for threads in (1, 2):
            sim = tack.Simulation(blocks, set=small, threads=threads)
            self.assertEqual(sim.threads, threads)
            for _ in range(5):
                sim.step()
            ends.append(sim.x.copy())
        np.testing.assert_array_equal(*ends)

    def test_a_warning_has_a_kind(self):
        sim = tack.Simulation(blocks, set={**small, "solver.max_iterations": 1, "time.max_cutbacks": 2})
        with warnings.catch_warnings(record=True) as given:
            warnings.simplefilter("always", tack.Warned)
            with contextlib.suppress(tack.SimulationError):
                for _ in range(20):
                    sim.step()
        self.assertIn("step_cutback", {w.message.kind for w in given})

    def test_a_callback_ends_a_run(self):
        sim = tack.Simulation(falling)
        sim.run(callback=lambda s: s.steps < 3)
        self.assertEqual(sim.steps, 3)
        sim.run(until=0.05)
        self.assertEqual(sim.steps, 5)

    def test_simulations_side_by_side(self):
        sims = [tack.Simulation(blocks, set=small, threads=1) for _ in range(2)]
        threads = [threading.Thread(target=lambda s=s: [s.step() for _ in range(5)]) for s in sims]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        np.testing.assert_array_equal(sims[0].x, sims[1].x)

    def test_calls_within_a_step_are_refused(self):
        sim = tack.Simulation(blocks, set=small)
        asked = {
            "step": sim.step, "move": lambda: sim.move(x=sim.x.copy()), "x": lambda: setattr(sim, "x", sim.x.copy()), "v": lambda: setattr(sim, "v", 0 * sim.v),
            "minimize_by": lambda: sim.minimize_by(None), "problem": sim.problem, "energies": sim.energies, "forces": sim.forces, "probes": sim.probes,
            "field": lambda: sim.field("gap"), "html": sim._repr_html_,
        }
        for name, ask in asked.items():
            with self.subTest(name):
                refused = []

                def within(problem):
                    with self.assertRaisesRegex(RuntimeError, "under way"):
                        ask()
                    refused.append(name)
                    self.assertEqual((sim.x.shape, sim.time, sim.steps), (sim.v.shape, before[0], before[1]))  # what the newest step left can be read
                    return newton(problem)

                before = sim.time, sim.steps
                sim.step(minimizer=within)
                self.assertTrue(refused)
                sim.minimize_by(None)

    def test_other_threads_wait_or_are_refused(self):
        sim, stop, refused = tack.Simulation(blocks, set=small, threads=1), threading.Event(), []

        def disturb():
            calls = [lambda: sim.move(v=0 * sim.v), sim.probes, sim.energies, sim.forces, lambda: sim.field("gap"), lambda: sim.problem().converged(sim.problem().start)]
            while not stop.is_set():
                for call in calls:
                    try:
                        call()
                    except RuntimeError as error:
                        refused.append(str(error))

        other = threading.Thread(target=disturb)
        other.start()
        steps = 0
        try:
            for _ in range(200):
                try:
                    sim.step()
                    steps += 1
                except RuntimeError:
                    pass
                if steps >= 5 and refused:
                    break
        finally:
            stop.set()
            other.join()
        self.assertEqual(sim.steps, steps)
        self.assertTrue(np.isfinite(sim.x).all())

    def test_a_problem_does_not_change_results_of_the_state(self):
        sim = tack.Simulation(blocks, set=small)
        for _ in range(3):
            sim.step()
        energies, forces = sim.energies(), sim.forces()
        problem = sim.problem()
        problem.value(problem.start + 1e-4 * np.sin(np.arange(problem.size)))
        self.assertEqual(sim.energies(), energies)
        for name, there in sim.forces().items():
            np.testing.assert_array_equal(there, forces[name])

if __name__ == "__main__":
    unittest.main()
