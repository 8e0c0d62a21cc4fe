"""Results as pandas and xarray have them, and tables of batches as HDF5; each test needs the package that it is about (Debian: python3-pandas, python3-xarray, python3-h5py)."""
import importlib
import pathlib
import tempfile
import unittest
from unittest import mock

import numpy as np

import tack
from tack_test_scenes import falling, source

shipped = source / "experiments/calibration"
strength = "contact.pairs.0.adhesion.peak_traction"


def needed(test, name):
    try:
        return importlib.import_module(name)
    except ImportError:
        test.skipTest(f"python3-{name} is not installed")


class Scratch(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.folder = pathlib.Path(scratch.name)


class Runs(Scratch):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.run_ = tack.run(falling, set={"output.fields": ["velocity", "von_mises_stress"], "output.frame_interval": "20 ms"}, output=cls.folder / "falling", threads=1)

    def test_tables_have_times_and_units(self):
        needed(self, "pandas")
        probes, steps = self.run_.to_pandas(), self.run_.to_pandas("steps")
        self.assertEqual((probes.index.name, list(probes.columns)), ("time", ["height"]))
        self.assertEqual(probes.attrs["units"], {"time": "s", "height": "m"})
        np.testing.assert_array_equal(probes["height"], self.run_.probes["height"])
        units = steps.attrs["units"]
        self.assertEqual([units[name] for name in ("time", "energy_kinetic", "min_gap", "tolerated_force", "wall_seconds", "newton_iterations")], ["s", "J", "m", "N", "s", "1"])
        plain = {name for name in self.run_.steps if units[name] == "1"}
        counts = ("newton", "linear", "line_search", "contacts", "candidates", "halvings", "step", "converged", "residual", "lag_", "friction_residual", "rejected_")
        self.assertEqual({name for name in plain if not name.startswith(counts)}, set())

    def test_frames_are_arrays_over_time_vertex_and_axis(self):
        xarray = needed(self, "xarray")
        frames = self.run_.to_xarray()
        self.assertIsInstance(frames, xarray.Dataset)
        self.assertEqual(frames["position"].dims, ("time", "vertex", "axis"))
        self.assertEqual((frames["position"].attrs["units"], frames["velocity"].attrs["units"], frames["von_mises_stress"].attrs["units"], frames["time"].attrs["units"]),
                         ("m", "m/s", "Pa", "s"))
        self.assertEqual(frames["von_mises_stress"].dims, ("time", "element"))
        self.assertTrue(frames["von_mises_stress"].attrs["long_name"])
        np.testing.assert_array_equal(frames["position"].sel(axis="y").isel(time=-1), self.run_.frames[-1].x[:, 1])
        np.testing.assert_allclose(frames["velocity"].sel(axis="y").mean("vertex"), -10 * frames["time"], atol=1e-3)
        few = self.run_.to_xarray(["velocity"], every=2)
        self.assertEqual(set(few.data_vars), {"position", "velocity"})
        self.assertEqual(len(few["time"]), (len(frames["time"]) + 1) // 2)
        with self.assertRaisesRegex(ValueError, "no field stress; there are velocity"):
            self.run_.to_xarray(["stress"])

    def test_missing_packages_are_named(self):
        for name, call in (("pandas", self.run_.to_pandas), ("xarray", self.run_.to_xarray)):
            with mock.patch.dict("sys.modules", {name: None}), self.assertRaisesRegex(ImportError, f"{name} is not installed.*python3-{name}"):
                call()


class Batches(Scratch):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        file = cls.folder / "pulls.yaml"
        file.write_text(f"name: pulls\nbase: {shipped / 'pull.yaml'}\nset: [time.step=50 ms, 'expect=[]', output.frames=false]\ntable: hdf5\n"
                        f"vary:\n  - {{type: grid, keys: {{{strength}: {{values: [5 kPa, 10 kPa], as: a/strength}}, time.step: {{values: [50 ms, 100 ms], as: step}}}}}}\n"
                        "statistics:\n  - {name: pull, probe: force, statistic: max}\n", encoding="utf-8")
        cls.batch = tack.batch(file, output=cls.folder / "out", jobs=2, threads=1)
        cls.some = tack.batch(file, set={"table": "csv"}, output=cls.folder / "some", jobs=2, threads=1, only=["*step=50ms"])
        cls.file = file

    def test_the_table_of_pandas_has_units(self):
        needed(self, "pandas")
        table = self.batch.to_pandas()
        self.assertEqual(table.index.name, "case")
        self.assertEqual((table.attrs["units"]["a/strength"], table.attrs["units"]["step"], table.attrs["units"]["pull"], table.attrs["units"]["steps"]), ("Pa", "s", "N", "1"))
        self.assertNotIn("status", table.attrs["units"])
        np.testing.assert_array_equal(table["pull"], self.batch.table["pull"])

    def test_a_grid_has_an_axis_per_parameter(self):
        needed(self, "xarray")
        grid = self.batch.to_xarray()
        self.assertEqual(dict(grid.sizes), {"a/strength": 2, "step": 2})
        self.assertEqual((grid["a/strength"].attrs["units"], grid["pull"].attrs["units"]), ("Pa", "N"))
        for row in range(self.batch.table.rows):
            at = {name: self.batch.table[name][row] for name in ("a/strength", "step")}
            self.assertEqual(grid["pull"].sel(at).item(), self.batch.table["pull"][row])
            self.assertEqual(grid["case"].sel(at).item(), self.batch.table["case"][row])

    def test_other_points_are_over_cases(self):
        needed(self, "xarray")
        study = tack.Study(self.file, set={"table": "csv"}, output=self.folder / "study", jobs=2, threads=1)
        study.evaluate_all([{"a/strength": 5e3, "step": 0.05}, {"a/strength": 1e4, "step": 0.1}, {"a/strength": 2e4, "step": 0.1}])
        cases = study.finish().to_xarray()
        self.assertEqual(cases["pull"].dims, ("case",))
        np.testing.assert_array_equal(cases["a/strength"], [5e3, 1e4, 2e4])

    def test_the_table_as_hdf5_equals_the_other(self):
        h5py = needed(self, "h5py")
        with h5py.File(self.batch.path / "results.h5") as file:
            self.assertEqual((file.attrs["format"], file.attrs["name"]), ("tack batch", "pulls"))
            self.assertIn("compiler", file.attrs["provenance"])
            columns = {file[name].attrs["name"]: file[name] for name in file.attrs["columns"]}
            self.assertEqual(list(columns), list(self.batch.table))
            for name, dataset in columns.items():
                if dataset.dtype == object:
                    self.assertEqual(dataset.asstr()[:].tolist(), [one if isinstance(one, str) else "" for one in self.batch.table[name].tolist()], name)
                else:
                    np.testing.assert_array_equal(dataset[:], self.batch.table[name], name)
            self.assertEqual((columns["a/strength"].attrs["unit"], columns["pull"].attrs["unit"], columns["steps"].attrs["unit"]), ("Pa", "N", "1"))
            self.assertEqual([columns[name].attrs["role"] for name in ("case", "a/strength", "status", "pull", "steps", "wall_seconds")],
                             ["name", "parameter", "status", "statistic", "count", "cost"])
            self.assertEqual(columns["a/strength"].dtype, np.float64)

    def test_the_table_as_hdf5_is_written_if_it_is_asked_for(self):
        self.assertTrue((self.batch.path / "results.h5").exists())
        self.assertFalse((self.some.path / "results.h5").exists())


if __name__ == "__main__":
    unittest.main()
