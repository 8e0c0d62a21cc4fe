"""Calibrations and batches as functions for optimisers from elsewhere."""
import pathlib
import re
import tempfile
import unittest

import numpy as np
from scipy.optimize import least_squares

import tack
from tack_test_scenes import source

try:
    import optuna
    optuna.logging.set_verbosity(optuna.logging.WARNING)
except ImportError:
    optuna = None

needs_optuna = unittest.skipUnless(optuna, "there is no Optuna (Debian: python3-optuna)")
shipped = source / "experiments/calibration"
strength, work = "contact.pairs.0.adhesion.peak_traction", "contact.pairs.0.adhesion.work_of_adhesion"


class Trial:
    """A trial with the documented interface of Optuna (optuna.trial.Trial), which draws evenly."""

    def __init__(self, random, number):
        self.random, self.number, self.params = random, number, {}

    def suggest_float(self, name, low, high, *, step=None, log=False):
        if not low <= high or (log and low <= 0):
            raise ValueError(f"{name}: {low} to {high}")
        value = float(np.exp(self.random.uniform(np.log(low), np.log(high))) if log else self.random.uniform(low, high))
        self.params[name] = value
        return value

    def suggest_int(self, name, low, high, *, step=1, log=False):
        if not low <= high or (log and low <= 0):
            raise ValueError(f"{name}: {low} to {high}")
        self.params[name] = int(self.random.integers(low, high + 1))
        return self.params[name]

    def suggest_categorical(self, name, choices):
        self.params[name] = choices[self.random.integers(len(choices))]
        return self.params[name]


class AskAndTell:
    """A study with the documented interface of Optuna (ask, tell, best_trial): random search."""

    def __init__(self):
        self.random, self.trials = np.random.default_rng(3), []

    def ask(self):
        return Trial(self.random, len(self.trials))

    def tell(self, trial, value):
        if not isinstance(value, float):
            raise TypeError("a trial is told a float")
        self.trials.append((value, trial))

    @property
    def best_trial(self):
        return min(self.trials, key=lambda one: one[0])[1]


class Scratch(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)


class Calibrations(Scratch):
    def calibration(self, **options):
        """Both parameters of a bonded pad that is pulled off; their true values are 10 kPa and 1 J/m^2."""
        file = self.folder / "fit.yaml"
        file.write_text(f"name: fit\nexperiments:\n  - {{base: {shipped / 'pull.yaml'}, data: {shipped / 'pull.csv'}, x: way, y: force, noise: 2%}}\n"
                        f"fit:\n  strength: {{keys: {strength}, from: 2 kPa, to: 90 kPa, start: 12 kPa}}\n"
                        f"  work: {{keys: {work}, from: 0.1 J/m^2, to: 7 J/m^2, start: 0.8 J/m^2, scale: linear}}\n", encoding="utf-8")
        fit = tack.Calibration(file, output=self.folder / "out", jobs=2, threads=1, **options)
        self.addCleanup(fit.close)
        return fit

    def test_parameters_have_ranges_and_scales(self):
        fit = self.calibration()
        one, two = fit.parameters
        self.assertEqual((one.name, one.low, one.high, one.start, one.log, one.unit, one.keys), ("strength", 2e3, 9e4, 1.2e4, True, "Pa", (strength,)))
        self.assertEqual((two.name, two.low, two.high, two.start, two.log), ("work", 0.1, 7, 0.8, False))
        np.testing.assert_allclose(fit.scaled.values(fit.scaled.start), fit.start)
        np.testing.assert_allclose(fit.scaled.start, [np.log(1.2e4), 3 * 0.8 / 6.9])
        design = fit.design(16)
        self.assertEqual(design.shape, (16, 2))
        self.assertTrue(np.all(design >= fit.bounds[:, 0]) and np.all(design <= fit.bounds[:, 1]))
        self.assertLess(design[:, 0].min(), 4e3)
        self.assertGreater(design[:, 0].max(), 4e4)

    def test_misfit_is_the_sum_of_squared_residuals_and_equals_that_of_the_command(self):
        fit = self.calibration()
        residuals, misfit = fit.residuals(fit.start), fit.misfit({"work": 0.8, "strength": 1.2e4})
        self.assertEqual(len(residuals), fit.experiments[0]["points"])
        self.assertAlmostEqual(misfit, residuals @ residuals, delta=1e-9 * misfit)
        several = fit.evaluate(fit.design(3))
        self.assertEqual([one["status"] for one in several], ["done"] * 3)
        self.assertTrue(all(one["misfits"]["pull"] == one["misfit"] for one in several))
        fit.close()
        fitted = tack.calibrate(self.folder / "fit.yaml", set={"search.design": 4, "search.chains": 1, "search.evaluations": 5, "search.polish": False},
                                output=self.folder / "out", jobs=2, threads=1)
        first = fitted.tables["evaluations"]
        self.assertEqual((first["strength"][0], first["work"][0]), (1.2e4, 0.8))
        self.assertAlmostEqual(first["misfit"][0], misfit, delta=1e-5 * misfit)
        self.assertLess(fitted.summary["runs"]["started"], first.rows)  # the first points had run

    def test_the_jacobian_is_that_of_the_residuals(self):
        fit = self.calibration()
        x, step = np.array([1.2e4, 0.8]), 1e-3
        jacobian = fit.jacobian(x)
        self.assertEqual(jacobian.shape, (fit.experiments[0]["points"], 2))
        for i in range(2):
            high, low = x.copy(), x.copy()
            high[i] *= 1 + step
            low[i] *= 1 - step
            difference = (fit.residuals(high) - fit.residuals(low)) / (high[i] - low[i])
            near = np.abs(jacobian[:, i] - difference) <= 0.02 * np.abs(difference).max()
            self.assertGreaterEqual(near.mean(), 0.9)  # but for points where a bond begins to soften
        np.testing.assert_allclose(fit.scaled.jacobian(fit.scaled.u(x)), jacobian * [1.2e4, 6.9 / 3])

    def test_scene_parameters_have_the_jacobian_of_the_keys_that_they_set(self):
        scene = (shipped / "pull.yaml").read_text(encoding="utf-8")
        for value, expression in [("peak_traction: 10 kPa", "peak_traction: strength"), ("work_of_adhesion: 1 J/m^2", "work_of_adhesion: 2 * toughness")]:
            self.assertIn(value, scene)
            scene = scene.replace(value, expression)
        base, file = self.folder / "named.yaml", self.folder / "named_fit.yaml"
        base.write_text(scene + "parameters: {strength: 10 kPa, toughness: 0.5 J/m^2}\n", encoding="utf-8")
        file.write_text(f"name: named\nexperiments:\n  - {{base: {base}, data: {shipped / 'pull.csv'}, x: way, y: force, noise: 2%}}\n"
                        "fit:\n  strength: {from: 2 kPa, to: 90 kPa, start: 12 kPa}\n  toughness: {from: 0.05 J/m^2, to: 4 J/m^2, start: 0.4 J/m^2, scale: linear}\n", encoding="utf-8")
        fit = tack.Calibration(file, output=self.folder / "named", jobs=2, threads=1)
        self.addCleanup(fit.close)
        expected = self.calibration().jacobian(np.array([1.2e4, 0.8])) * [1, 2]
        largest = np.abs(expected).max(axis=0)
        self.assertGreater(largest.min(), 0)
        np.testing.assert_allclose(fit.jacobian(np.array([1.2e4, 0.4])) / largest, expected / largest, atol=1e-5)

    def test_least_squares_finds_the_values(self):
        fit = self.calibration()
        u = fit.scaled
        found = least_squares(u.residuals, u.start, u.jacobian, bounds=u.bounds.T, xtol=1e-3, ftol=1e-4)
        values = u.values(found.x)
        np.testing.assert_allclose(values, [1e4, 1], rtol=0.05)
        self.assertLess(2 * found.cost, 2 * fit.experiments[0]["points"])

    def test_ask_and_tell(self):
        fit, search = self.calibration(), AskAndTell()
        for _ in range(8):
            trial = search.ask()
            search.tell(trial, fit.misfit(fit.suggest(trial)))
        best = search.best_trial.params
        self.assertEqual(set(best), {"strength", "work"})
        self.assertEqual(fit.misfit(best), min(value for value, _ in search.trials))

    @needs_optuna
    def test_optuna_as_the_page_uses_it(self):
        page = (source / "docs/python.md").read_text(encoding="utf-8")
        code = re.search(r"```python\n(import optuna\n.*?)```", page, re.DOTALL)[1]
        for written, here in [('"experiments/calibration/pull_fit.yaml"', repr(str(shipped / "pull_fit.yaml"))), ('"results/fit"', repr(str(self.folder / "fit"))), ("range(40)", "range(4)")]:
            self.assertIn(written, code)
            code = code.replace(written, here)
        names = {"tack": tack}
        exec(code, names)
        search = names["search"]
        self.assertEqual([trial.state for trial in search.trials], [optuna.trial.TrialState.COMPLETE] * 4)
        with tack.Calibration(shipped / "pull_fit.yaml", output=self.folder / "fit", jobs=2) as fit:
            self.assertEqual(set(search.best_params), set(fit.names))
            for trial in search.trials:
                for parameter in fit.parameters:
                    self.assertTrue(parameter.low <= trial.params[parameter.name] <= parameter.high)
                    self.assertTrue(trial.distributions[parameter.name].log)
            self.assertEqual(fit.misfit(search.best_params), search.best_value)

    def test_points_that_fail_and_points_that_are_none(self):
        fit = self.calibration(set={"time_limit": "0.001 s"})
        self.assertEqual(fit.misfit(fit.start), np.inf)
        self.assertTrue(np.all(np.isinf(fit.residuals(fit.start))))
        self.assertEqual(fit.evaluate([fit.start])[0]["status"], "timed out")
        with self.assertRaises(tack.SimulationError):
            fit.jacobian(fit.start)
        with self.assertRaisesRegex(tack.InputError, "strength: 1000 is not between 2000 and 90000 Pa"):
            fit.misfit([1e3, 1])
        with self.assertRaisesRegex(ValueError, "a value for each of strength, work"):
            fit.misfit({"strength": 1e4})
        with self.assertRaisesRegex(tack.InputError, "1 values, and 2 parameters"):
            fit.misfit([1e4])
        fit.close()
        with self.assertRaisesRegex(RuntimeError, "is closed"):
            fit.misfit(fit.start)


class Studies(Scratch):
    def study(self, vary, **options):
        file = self.folder / "study.yaml"
        file.write_text(f"name: study\nbase: {shipped / 'pull.yaml'}\nset: [time.step=50 ms, 'expect=[]', output.frames=false]\n"
                        f"vary:\n  - {vary}\nstatistics:\n  - {{name: pull, probe: force, statistic: max}}\n", encoding="utf-8")
        return tack.Study(file, output=self.folder / "out", jobs=2, threads=1, **options)

    def test_a_case_is_a_function_of_what_varies(self):
        study = self.study(f"{{type: sobol, samples: 4, keys: {{{strength}: {{from: 5 kPa, to: 20 kPa, scale: log, as: strength}}}}}}")
        parameter = study.parameters[0]
        self.assertEqual((parameter.name, parameter.low, parameter.high, parameter.log, parameter.keys), ("strength", 5e3, 2e4, True, (strength,)))
        np.testing.assert_allclose(study.bounds, [[5e3, 2e4]])
        row = study.evaluate({"strength": 1e4})
        self.assertEqual((row["status"], row["strength"]), ("done", 1e4))
        self.assertEqual(study.evaluate([1e4])["pull"], row["pull"])
        rows = study.evaluate_all([{"strength": "5 kPa"}, {"strength": 2e4}, {"strength": "5 kPa"}])
        self.assertEqual(rows[0], rows[2])
        self.assertTrue(rows[0]["pull"] < row["pull"] < rows[1]["pull"])
        self.assertNotEqual(study.evaluate({work: 0.5})["pull"], row["pull"])
        search = AskAndTell()
        trial = search.ask()
        search.tell(trial, study.evaluate(study.suggest(trial))["pull"])
        self.assertTrue(5e3 <= trial.params["strength"] <= 2e4)
        with self.assertRaisesRegex(ValueError, "'strenght' is no parameter.*there are strength"):
            study.evaluate({"strenght": 1e4})

    def test_numbers_keep_their_digits_and_whole_ones_stay_whole(self):
        study = self.study(f"{{type: sobol, samples: 4, keys: {{solver.max_iterations: {{from: 100, to: 900, whole: true, as: iterations}}, {strength}: "
                           "{from: 5 kPa, to: 20 kPa, as: strength}}}")
        self.assertEqual([one.whole for one in study.parameters], [True, False])
        exact = 1e4 * (1 + 1e-9)
        for given, expected in [([300, exact], (300, exact)), (np.array([300.4, 1e4]), (300, 10000)), ({"iterations": np.int64(300), "strength": "10 kPa"}, (300, "10 kPa")),
                                ({"solver.max_iterations": 1234567, "time.step": 0.0125}, (1234567, 0.0125))]:
            point = tuple(study.point(given).values())
            self.assertEqual(point, expected)
            self.assertEqual([type(one) for one in point], [type(one) for one in expected])
        self.assertEqual(str(study.point([300, 1e4])), str(study.point([300, 10000])))
        self.assertIs(study.point({"output.frames": True})["output.frames"], True)
        row = study.evaluate([300, exact])
        self.assertEqual((row["status"], row["iterations"], row["strength"]), ("done", 300, exact))
        point = study.suggest(AskAndTell().ask())
        self.assertEqual(study.point(point), point)
        self.assertIsInstance(study.point(point)["iterations"], int)

    @needs_optuna
    def test_optuna_asks_for_points_of_each_kind(self):
        study = self.study(f"{{type: sobol, samples: 4, keys: {{solver.max_iterations: {{from: 100, to: 900, whole: true, as: iterations}}, {strength}: "
                           "{from: 5 kPa, to: 20 kPa, scale: log, as: strength}}}")
        search = optuna.create_study(direction="maximize", sampler=optuna.samplers.RandomSampler(seed=1))
        for _ in range(3):
            trial = search.ask()
            point = study.suggest(trial)
            self.assertIsInstance(point["iterations"], int)
            search.tell(trial, study.evaluate(point)["pull"])
        best = max(search.trials, key=lambda trial: trial.params["strength"])
        self.assertEqual(search.best_params, best.params)
        self.assertEqual(study.evaluate(search.best_params)["pull"], search.best_value)
        listed = self.study(f"{{type: grid, keys: {{{strength}: {{values: [5 kPa, 10 kPa], as: strength}}}}}}")
        self.assertIn(listed.suggest(optuna.create_study().ask())["strength"], ("5 kPa", "10 kPa"))

    def test_all_points_make_one_table_and_none_runs_twice(self):
        study = self.study(f"{{type: grid, keys: {{{strength}: {{values: [5 kPa, 10 kPa], as: strength}}}}}}")
        self.assertEqual(study.parameters[0].values, ("5 kPa", "10 kPa"))
        self.assertTrue(np.all(np.isnan(study.bounds)))
        for value in study.parameters[0].values:
            study.evaluate({"strength": value})
        ended = {path.name: path.stat().st_mtime_ns for path in (self.folder / "out/state").iterdir()}
        table = study.finish().table
        self.assertEqual(list(table["strength"]), [5e3, 1e4])
        self.assertEqual(list(table["status"]), ["done"] * 2)
        self.assertEqual({path.name: path.stat().st_mtime_ns for path in (self.folder / "out/state").iterdir()}, ended)


if __name__ == "__main__":
    unittest.main()
