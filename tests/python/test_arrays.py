"""Arrays of a simulation: views, forces, fields, and assignments."""
import unittest

import numpy as np

import tack
from tack_test_scenes import blocks, small, falling


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

    def test_forces_add_up_to_mass_times_acceleration(self):
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

    def test_intersecting_positions_are_refused(self):
        sim = tack.Simulation(blocks, set=small)
        x = sim.x.copy()
        lower, upper = sim["lower"].vertices, sim["upper"].vertices
        x[upper] += x[lower].mean(axis=0) - x[upper].mean(axis=0)
        before = sim.x.copy()
        with self.assertRaises(tack.InputError):
            sim.x = x
        np.testing.assert_array_equal(sim.x, before)
        sim.step()

if __name__ == "__main__":
    unittest.main()
