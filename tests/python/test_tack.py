"""import tack: what docs/python.md says of it."""
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import warnings

import numpy as np

import tack

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

    def test_what_steps_give_is_what_the_program_gives(self):
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

    def test_threads_give_the_same_bits(self):
        ends = []
        for threads in (1, 2):
            sim = tack.Simulation(blocks, set=small, threads=threads)
            self.assertEqual(sim.threads, threads)
            for _ in range(5):
                sim.step()
            ends.append(sim.x.copy())
        np.testing.assert_array_equal(*ends)

    def test_a_callback_ends_a_run(self):
        sim = tack.Simulation(falling)
        sim.run(callback=lambda s: s.steps < 3)
        self.assertEqual(sim.steps, 3)
        sim.run(until=0.05)
        self.assertEqual(sim.steps, 5)

    def test_the_snippet_of_the_README_runs_to_the_end(self):
        page = (source / "README.md").read_text(encoding="utf-8")
        code = re.search(r"```python\n(.*?)```", page, re.S).group(1)
        printed = []
        scope = {"print": lambda *values: printed.append(values)}
        exec(code.replace("experiments/", f"{source}/experiments/"), scope)
        self.assertTrue(scope["sim"].finished)
        self.assertEqual(len(printed), scope["sim"].steps)
        self.assertAlmostEqual(max(adhesion for _, adhesion in printed), 10, delta=0.1)

    def test_simulations_side_by_side(self):
        sims = [tack.Simulation(blocks, set=small, threads=1) for _ in range(2)]
        threads = [threading.Thread(target=lambda s=s: [s.step() for _ in range(5)]) for s in sims]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        np.testing.assert_array_equal(sims[0].x, sims[1].x)

    def test_nothing_else_is_asked_of_a_simulation_within_its_step(self):
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

    def test_a_problem_leaves_what_is_asked_of_the_state(self):
        sim = tack.Simulation(blocks, set=small)
        for _ in range(3):
            sim.step()
        energies, forces = sim.energies(), sim.forces()
        problem = sim.problem()
        problem.value(problem.start + 1e-4 * np.sin(np.arange(problem.size)))
        self.assertEqual(sim.energies(), energies)
        for name, there in sim.forces().items():
            np.testing.assert_array_equal(there, forces[name])


class Arrays(unittest.TestCase):
    def test_positions_are_views(self):
        sim = tack.Simulation(falling)
        x = sim.x
        address = x.__array_interface__["data"][0]
        self.assertEqual(address, sim.x.__array_interface__["data"][0])
        before = x.copy()
        sim.step()
        self.assertEqual(address, sim.x.__array_interface__["data"][0])
        self.assertTrue(np.shares_memory(x, sim["cube"].x))
        self.assertTrue(np.all(x[:, 1] < before[:, 1]))
        with self.assertRaises(ValueError):
            x[0, 0] = 1

    def test_views_outlive_their_simulation(self):
        sim = tack.Simulation(falling)
        x, mass = sim.x, sim.mass.sum()
        expected = x.copy()
        del sim
        np.testing.assert_array_equal(x, expected)
        self.assertAlmostEqual(mass, 1.0, places=12)

    def test_forces_add_up_to_what_accelerates(self):
        sim = tack.Simulation(blocks, set=small)
        for _ in range(12):
            sim.step()
        forces = sim.forces()
        self.assertIn("gravity", forces)
        moved = np.linalg.norm(sum(forces.values()).sum(axis=0))
        self.assertTrue(np.isfinite(moved))
        weight = forces["gravity"].sum(axis=0)
        self.assertLess(weight[1], 0)
        inner = sum(f for name, f in forces.items() if name.startswith("neo") or "corotated" in name or "kirchhoff" in name)
        np.testing.assert_allclose(np.sum(inner, axis=0), 0, atol=1e-9 * np.abs(inner).sum())

    def test_fields_and_objects(self):
        sim = tack.Simulation(blocks, set=small)
        for _ in range(12):
            sim.step()
        self.assertEqual(len(sim.pressures), len(sim.x))
        self.assertEqual(len(sim.field("von_mises_stress")), sum(len(o.tets) for o in sim.objects.values()) + sum(
            len(o.triangles) for o in sim.objects.values() if len(o.tets) == 0))
        with self.assertRaisesRegex(ValueError, "there is no field 'presure'.*contact_pressure"):
            sim.field("presure")

    def test_moving(self):
        sim = tack.Simulation(falling)
        sim.v = np.tile([0.0, 3.0, 0.0], (len(sim.x), 1))
        sim.step()
        np.testing.assert_allclose(sim.v[:, 1], 2.9, rtol=1e-9)
        x = sim.x + [1.0, 0, 0]
        sim.x = x
        np.testing.assert_array_equal(sim.x, x)
        bad = x.copy()
        bad[0] = [7, 7, 7]
        before = sim.x.copy()
        with self.assertRaisesRegex(tack.InputError, "invert"):
            sim.x = bad
        np.testing.assert_array_equal(sim.x, before)
        sim.step()
        for wrong in (x[:2], np.full_like(x, np.nan)):
            with self.assertRaises(ValueError):
                sim.x = wrong

    def test_arrays_of_another_kind_or_shape_are_refused(self):
        sim = tack.Simulation(falling)
        problem = sim.problem()
        takes = {
            "x": lambda a: setattr(sim, "x", a),
            "v": lambda a: setattr(sim, "v", a),
            "q": lambda a: sim.problem().value(a),
            "p": lambda a: sim.problem().feasible_step(problem.start, a),
            "g": lambda a: sim.problem().stopping_norm(a, a),
        }
        x = sim.x.copy()
        n = len(x)
        self.assertEqual(problem.size, 3 * n)
        shapes = {"transposed": x.T, "a copy of that": np.ascontiguousarray(x.T), "(1, n, 3)": x[None], "(3 n, 1)": x.reshape(-1, 1), "(n, 3, 1)": x[:, :, None],
                  "(n + 1, 3)": np.vstack([x, x[:1]]), "one number": 1.0, "nothing": []}
        kinds = {"complex": x + 0j, "masked": np.ma.masked_array(x, mask=x > 0), "texts": x.astype(str), "truth": x > 0, "objects": x.astype(object), "None": None, "ragged": [[1], [1, 2]]}
        right = {"as it is": x, "flat": x.ravel(), "by columns": np.asfortranarray(x), "list": x.tolist(), "float32": x.astype("f4").astype("f8"), "big endian": x.astype(">f8"),
                 "strided": np.repeat(x, 2, axis=0)[::2]}
        for name, take in takes.items():
            for label, wrong in shapes.items():
                with self.subTest(name=name, label=label), self.assertRaisesRegex(ValueError, f"shape .* where \\({n}, 3\\) or \\({3 * n},\\) is needed"):
                    take(wrong)
            for label, wrong in kinds.items():
                if name in "xv" and wrong is None:
                    continue  # stays as it is
                with self.subTest(name=name, label=label), self.assertRaises(TypeError):
                    take(wrong)
            np.testing.assert_array_equal(sim.x, x)
            np.testing.assert_array_equal(sim.v, 0 * x)
        for label, same in right.items():
            with self.subTest(label=label):
                sim.v = same
                np.testing.assert_allclose(sim.v, x, rtol=1e-6)
                sim.problem().value(same)

    def test_what_intersects_is_refused(self):
        sim = tack.Simulation(blocks, set=small)
        x = sim.x.copy()
        lower, upper = sim["lower"].vertices, sim["upper"].vertices
        x[upper] += x[lower].mean(axis=0) - x[upper].mean(axis=0)
        before = sim.x.copy()
        with self.assertRaises(tack.InputError):
            sim.x = x
        np.testing.assert_array_equal(sim.x, before)
        sim.step()


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

    def test_a_minimiser_moves_what_is_prescribed_through_obstacles(self):
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

    def test_values_are_infinite_where_nothing_may_be(self):
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
        with self.assertRaises(tack.SimulationError):
            sim.step(minimizer=lambda problem: problem.start)
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

    def test_what_is_no_law(self):
        for wrong, said in (({"reach": 0}, "positive length"), ({"reach": -1}, "positive length"), ({"reach": 1, "rows": 1}, "at least")):
            with self.assertRaisesRegex(ValueError, said):
                tack.law(lambda gap: 0 * gap, **wrong)
        with tempfile.TemporaryDirectory() as folder:
            with self.assertRaisesRegex(ValueError, "gap of 0 m is not a finite number"):
                with np.errstate(divide="ignore"):
                    tack.law(lambda gap: 1 / gap, reach=1e-3, file=f"{folder}/law.csv")


class Notebook(unittest.TestCase):
    def test_the_tutorial_runs(self):
        try:
            import matplotlib
        except ImportError:
            self.skipTest("matplotlib is not installed")
        matplotlib.use("agg")
        notebook = json.loads((source / "docs/tutorial.ipynb").read_text(encoding="utf-8"))
        scope = {}
        before = pathlib.Path.cwd()
        with tempfile.TemporaryDirectory() as folder:
            try:
                os.chdir(folder)
                for cell in notebook["cells"]:
                    if cell["cell_type"] == "code":
                        exec("".join(cell["source"]).replace("../experiments", str(source / "experiments")), scope)
            finally:
                os.chdir(before)
        force = scope["force"]
        self.assertGreater(force.max(), 0)
        self.assertLess(abs(force[-1]), 1e-5)
        soft, middle, stiff = scope["peaks"].values()
        self.assertLess(soft, middle)
        self.assertLess(middle, stiff)
        self.assertLess(stiff, 5.1e3)
        self.assertLess(np.abs(scope["own"].x - scope["ours"].x).max(), 1e-6)
        self.assertEqual(scope["results"].summary["status"], "done")

    def test_what_notebooks_show(self):
        if not (pathlib.Path(tack.__file__).parent / "share/report.html").exists():
            self.skipTest("the page of reports is not built")
        sim = tack.Simulation(blocks, set=small)
        sim.step()
        shown = sim._repr_html_()
        self.assertTrue(shown.startswith("<iframe"))
        self.assertGreater(len(shown), 100000)


class Errors(unittest.TestCase):
    def test_errors_name_the_place(self):
        with self.assertRaisesRegex(tack.InputError, "yong.*young"):
            tack.Simulation(falling, set={"objects.cube.energies.0.yong": "1 MPa"})
        with self.assertRaises(ValueError):
            tack.Simulation("nowhere.yaml")
        with self.assertRaisesRegex(tack.InputError, "neither a run"):
            tack.read(source / "docs")

    def test_a_locale_with_commas_changes_nothing(self):
        with tempfile.TemporaryDirectory() as folder:
            made = shutil.which("localedef") and subprocess.run(["localedef", "-i", "de_DE", "-f", "UTF-8", f"{folder}/de_DE.UTF-8"], capture_output=True)
            if not made or made.returncode != 0:
                self.skipTest("no locale with commas can be made here")
            code = """
import locale, resource, tack
resource.setrlimit(resource.RLIMIT_CPU, (30, 31))
scene = {"name": "p", "parameters": {"w": "0.1 m", "h": "5 ms"}, "time": {"step": "h", "duration": "0.5 s"}, "objects": [
    {"name": "b", "shape": {"type": "box", "size": ["0.5 * w", "w", "1.5 * w"]}, "energies": [{"type": "neo_hookean", "young": "0.1 MPa"}],
     "motion": [{"type": "formula", "x": "0.5 * t", "select": {"type": "face", "direction": [0, 1, 0]}}]}]}
if SET: locale.setlocale(locale.LC_ALL, "de_DE.UTF-8")
sim = tack.Simulation(scene, threads=1)
sim.step()
print(sim.x.tolist())
"""
            environment = {**os.environ, "LOCPATH": folder}
            plain, commas = (run_python(code.replace("SET", answer), env=environment) for answer in ("False", "True"))
            self.assertEqual(commas.returncode, 0, commas.stderr)
            self.assertEqual(commas.stdout, plain.stdout)

    def test_characters_beyond_the_first_plane(self):
        for about in ("\u00fc 1 \u00b5m", "\U0001d6fe = 3", "\U0001f600"):
            sim = tack.Simulation({**falling, "about": about})
            self.assertIn(about, sim.scene())
            self.assertIn(about, tack.Simulation(falling, set={"about": about}).scene())

    def test_ctrl_c(self):
        code = f"""
import tack, sys
sim = tack.Simulation({str(blocks)!r}, set={{"objects.lower.shape.cells": [24, 24, 24], "objects.upper.shape.cells": [24, 24, 24], "time.duration": "100 s"}})
print("ready", flush=True)
try:
    sim.run()
except KeyboardInterrupt:
    steps = sim.steps
    print("stopped", flush=True)
"""
        process = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True)
        try:
            self.assertEqual(process.stdout.readline().strip(), "ready")
            time.sleep(1)
            process.send_signal(signal.SIGINT)
            out, _ = process.communicate(timeout=60)
        finally:
            process.kill()
        self.assertEqual(out.strip(), "stopped")
        self.assertEqual(process.returncode, 0)

    def test_no_traces_are_left_in_the_process(self):
        result = run_python(f"import signal, tack; sim = tack.Simulation({str(blocks)!r}); sim.step(); "
                            "assert signal.getsignal(signal.SIGINT) is signal.default_int_handler; print(sim.steps)")
        self.assertEqual(result.stdout.strip(), "1", result.stderr)


if __name__ == "__main__":
    os.chdir(tempfile.mkdtemp())
    unittest.main()
