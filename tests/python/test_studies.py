"""Comparisons, batches and calibrations, with the files of the commands."""
import pathlib
import tempfile
import unittest

import numpy as np

import tack
from tack_test_scenes import pull, source

shipped = source / "experiments/calibration"


class Studies(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def test_a_comparison_returns_its_tables(self):
        file = self.folder / "two.yaml"
        file.write_text(f"name: two\nproblems: [{source / 'tests/data/problems/sliding.problem'}]\nrepeat: 1\ntolerances: [1 mm/s]\nsolvers:\n"
                        "  - {name: newton, solver: {type: projected_newton}}\n  - {name: lbfgs, solver: {type: lbfgs}}\n", encoding="utf-8")
        compared = tack.compare(file, set={"tolerances": ["1 mm/s", "0.01 mm/s"]}, output=self.folder / "out", threads=1)
        table = compared.tables["compare"]
        self.assertEqual(list(table["solver"]), ["newton", "lbfgs", "newton", "lbfgs"])
        self.assertEqual(list(table["tolerance"]), [1e-3, 1e-3, 1e-5, 1e-5])
        self.assertTrue(np.all(table["cpu_seconds"] > 0))
        self.assertEqual(list(table["intersections"]), [0, 0, 0, 0])
        self.assertEqual(compared.summary["references"][0]["problem"], "sliding")
        self.assertTrue((self.folder / "out/compare.md").exists())
        with self.assertRaisesRegex(tack.InputError, "solvers"):
            tack.compare(file, set={"solvers": []}, output=self.folder / "none")
        self.assertFalse((self.folder / "none").exists())

    def test_a_batch_returns_its_table_and_cases_and_continues(self):
        file = self.folder / "strengths.yaml"
        file.write_text(f"name: strengths\nbase: {shipped / 'pull.yaml'}\nset: [time.step=50 ms, 'expect=[]', output.frames=false]\n"
                        "vary:\n  - {type: grid, keys: {contact.pairs.0.adhesion.peak_traction: {values: [5 kPa, 10 kPa, 20 kPa], as: strength}}}\n"
                        "statistics:\n  - {name: pull, probe: force, statistic: max}\n", encoding="utf-8")
        first = tack.batch(file, output=self.folder / "out", jobs=2, threads=1, only=["strength=5kPa"])
        self.assertEqual(list(first.table["status"]), ["done", "waiting", "waiting"])
        batch = tack.batch(file, output=self.folder / "out", jobs=2, threads=1)
        self.assertEqual(list(batch.table["status"]), ["done"] * 3)
        self.assertEqual(list(batch.table["strength"]), [5e3, 1e4, 2e4])
        self.assertTrue(np.all(np.diff(batch.table["pull"]) > 0))
        self.assertEqual(list(batch.cases), ["strength=5kPa", "strength=10kPa", "strength=20kPa"])
        self.assertEqual(batch.cases["strength=5kPa"].summary["status"], "done")
        # A case that has changed has no results until it runs again; its earlier ones are moved aside and belong to no case.
        changed = tack.batch(file, set={"set.0": "time.step=100 ms"}, output=self.folder / "out", jobs=2, threads=1, only=["strength=10kPa"])
        self.assertTrue((self.folder / "out/cases/strength=10kPa.1").exists())
        self.assertEqual(list(changed.cases), ["strength=10kPa"])
        self.assertEqual(list(changed.table["status"]), ["waiting", "done", "waiting"])
        self.assertEqual(list(tack.read(self.folder / "out").cases), ["strength=10kPa"])
        with self.assertRaisesRegex(tack.InputError, "no case has such a name"):
            tack.batch(file, output=self.folder / "none", only=["strength=7kPa"])
        with self.assertRaisesRegex(tack.InputError, "poisson"):
            tack.batch(file, set={"set": ["objects.nothing.energies.0.poisson=0.7"]}, output=self.folder / "none")
        self.assertFalse((self.folder / "none").exists())

    def test_a_case_at_its_time_limit_ends_with_its_results(self):
        file = self.folder / "long.yaml"
        file.write_text(f"name: long\nbase: {shipped / 'pull.yaml'}\nset: [time.step=1 us, 'expect=[]', output.frames=false]\ntime_limit: 6 s\n", encoding="utf-8")
        batch = tack.batch(file, output=self.folder / "out", threads=1)
        self.assertEqual(list(batch.table["status"]), ["timed out"])
        self.assertLess(batch.table["wall_seconds"][0], 20)  # it was not killed
        summary = batch.cases["case"].summary
        self.assertEqual(summary["status"], "interrupted")
        self.assertGreater(summary["steps"], 0)

    def test_a_calibration_returns_parameters_and_curves_and_continues(self):
        file = self.folder / "fit.yaml"
        file.write_text(f"name: fit\nexperiments:\n  - {{base: {shipped / 'pull.yaml'}, set: [time.step=50 ms], data: {shipped / 'pull.csv'}, x: way, y: force, noise: 2%}}\n"
                        "fit:\n  strength: {keys: contact.pairs.0.adhesion.peak_traction, from: 5 kPa, to: 20 kPa, start: 8 kPa}\n"
                        "search: {design: 3, chains: 1, evaluations: 4, polish: false}\n", encoding="utf-8")
        fitted = tack.calibrate(file, output=self.folder / "out", jobs=2, threads=1)
        strength = fitted.summary["numbers"][0]
        self.assertEqual(strength["name"], "strength")
        self.assertLess(abs(strength["value"] / 1e4 - 1), 0.5)
        evaluations = fitted.tables["evaluations"]
        self.assertGreaterEqual(evaluations.rows, 3)
        self.assertEqual(set(evaluations["status"]), {"done"})
        self.assertEqual(fitted.tables["calibration"].rows, 1)
        curve = fitted.fits["pull"]
        self.assertEqual(len(curve["measured"]), len(curve["simulated"]))
        self.assertGreater(fitted.summary["runs"]["started"], 0)
        again = tack.calibrate(file, output=self.folder / "out", jobs=2, threads=1)
        self.assertEqual(again.summary["runs"]["started"], 0)
        self.assertEqual(again.summary["numbers"][0]["value"], strength["value"])

    def test_wrong_files_are_refused(self):
        with self.assertRaisesRegex(tack.InputError, "cannot read"):
            tack.compare(self.folder / "missing.yaml")
        with self.assertRaises(tack.InputError):
            tack.calibrate(pull, output=self.folder / "out")


if __name__ == "__main__":
    unittest.main()
