"""Contact points as arrays: sums against the forces of the potential, and closed forms."""
import unittest

import numpy as np

import tack
from tack_test_scenes import blocks, small, source

side, height, gravity = 0.1, 0.1, 9.81  # of the resting block [m, m, m/s^2]
resting = {
    "name": "resting",
    "time": {"step": "50 ms", "duration": "3 s", "stepper": "incremental_potential"},
    "gravity": [0, -gravity, 0],
    "objects": [
        {"name": "floor", "shape": {"type": "box", "size": [0.4, 0.02, 0.4]}, "place": {"translate": [0, -0.01, 0]}, "motion": ["fixed"]},
        {"name": "block", "shape": {"type": "box", "size": [side, height, side], "cells": [2, 2, 2]}, "place": {"translate": [0, height / 2 + 0.8e-3, 0]},
         "energies": [{"type": "neo_hookean", "young": "1 MPa", "poisson": 0.3, "density": 1000}]},
    ],
    "contact": {"distance": "1 mm", "friction": {"mu": 0.5, "eps_v": "1 mm/s"}},
    "solver": {"type": "projected_newton", "tolerance": "1e-6 m/s"},
}
weight = 1000 * side * side * height * gravity


def with_model(model):
    return {**resting, "contact": {**resting["contact"], "model": model}}


class Contacts(unittest.TestCase):
    def assert_sums_are_the_forces(self, sim, name):
        """The forces of the points add up to those of the potential, object by object, to rounding."""
        points, forces = sim.contacts(name), sim.forces()[name]
        largest = np.abs(points["force"]).sum()
        self.assertGreater(largest, 0)
        for i, body in enumerate(sim.objects.values()):
            net = points["force"][points["object"] == i].sum(axis=0) - points["force"][points["opposite"] == i].sum(axis=0)
            np.testing.assert_allclose(net, forces[body.vertices].sum(axis=0), atol=1e-11 * largest)
        return points

    def assert_geometry(self, sim, points):
        """Points lie on both primitives, a gap apart along the normal."""
        x = np.vstack([sim.x, np.zeros(3)])  # -1: none, whose weight is zero
        for vertices, weights, at in (("vertices", "weights", "point"), ("opposite_vertices", "opposite_weights", "opposite_point")):
            np.testing.assert_allclose(points[weights].sum(axis=1), 1, atol=1e-9)
            np.testing.assert_allclose(np.einsum("ij,ijk->ik", points[weights], x[points[vertices]]), points[at], atol=1e-12)
        np.testing.assert_allclose(np.linalg.norm(points["normal"], axis=1), 1, atol=1e-9)
        np.testing.assert_allclose(points["point"] - points["opposite_point"], points["gap"][:, None] * points["normal"], atol=1e-10)

    def test_a_block_at_rest_presses_with_its_weight(self):
        sim = tack.Simulation(resting, threads=1).run()
        points = self.assert_sums_are_the_forces(sim, "contact")
        self.assert_geometry(sim, points)
        self.assertTrue(np.all(points["gap"] <= 1e-3))
        pairs = sim.contact_pairs()
        self.assertEqual((pairs["first"].tolist(), pairs["second"].tolist()), (["floor"], ["block"]))
        self.assertEqual(pairs["points"].sum(), len(points))
        np.testing.assert_allclose(pairs["normal_force"], weight, rtol=1e-4)
        np.testing.assert_allclose(pairs["force"], [[0, -weight, 0]], atol=1e-4 * weight)
        np.testing.assert_allclose(pairs["area"], side * side, rtol=1e-2)

    def test_every_contact_model_shows_its_points(self):
        for model in ("area_integral", "ipc", "ogc", "gcp", "clipped"):
            with self.subTest(model=model):
                sim = tack.Simulation(with_model(model), set={"time.duration": "0.5 s"}, threads=1).run()
                self.assert_geometry(sim, self.assert_sums_are_the_forces(sim, "contact"))

    def test_parts_of_an_adhesive_force_add_up(self):
        for model in ("area_integral", "clipped"):
            with self.subTest(model=model):
                sim = tack.Simulation(source / "experiments/debonding/pull.yaml", set={"contact.model": model, "expect": []}, threads=1).run(until=0.03)
                names = ["contact"] if model == "area_integral" else ["contact", "clipped_adhesion"]
                for name in names:
                    self.assert_sums_are_the_forces(sim, name)
                probed = sum(sim.contact_pairs(name, part)["normal_force"].sum() for name in names for part in ("adhesion",))
                self.assertLess(probed, 0)
                if model == "area_integral":
                    whole, barrier = sim.contacts(), sim.contacts("contact", "barrier")
                    np.testing.assert_allclose(whole["force"], barrier["force"] + sim.contacts("contact", "adhesion")["force"], atol=1e-12)

    def test_friction_has_its_points(self):
        sim = tack.Simulation(blocks, set={**small, "expect": [], "gravity": [3, -9.81, 0]}, threads=1).run(until=0.15)
        points = self.assert_sums_are_the_forces(sim, "friction")
        tangential = np.linalg.norm(points["force"], axis=1)
        self.assertTrue(np.all(tangential <= 0.5 * points["normal_force"] * (1 + 1e-9)))
        np.testing.assert_allclose(np.einsum("ij,ij->i", points["force"], points["normal"]), 0, atol=1e-9 * tangential.max())

    def test_bonds_have_their_points(self):
        sim = tack.Simulation(source / "experiments/calibration/pull.yaml", set={"expect": []}, threads=1).run(until=0.2)
        self.assert_sums_are_the_forces(sim, "bonds" if "bonds" in sim.forces() else "contact")

    def test_rolling_friction_has_its_points(self):
        scene = next(path for path in sorted((source / "experiments").rglob("*.yaml")) if "rolling: true" in path.read_text(encoding="utf-8"))
        sim = tack.Simulation(scene, set={"expect": []}, threads=1)
        sim.run(callback=lambda s: not any(np.abs(s.forces()["friction"]).max(axis=1) > 0) and s.steps < 400)
        self.assert_sums_are_the_forces(sim, "friction")

    def test_without_contact_there_are_no_points(self):
        sim = tack.Simulation(resting, set={"objects.block.place.translate": [0, 1, 0]}, threads=1)
        self.assertEqual(len(sim.contacts()), 0)
        self.assertEqual(len(sim.contact_pairs()), 0)

    def test_unknown_forces_and_parts_are_refused(self):
        sim = tack.Simulation(resting, threads=1)
        with self.assertRaisesRegex(ValueError, "no force 'gravity'.*there are contact"):
            sim.contacts("gravity")
        with self.assertRaisesRegex(ValueError, "no part 'suction'; it has barrier, adhesion"):
            sim.contacts("contact", "suction")


if __name__ == "__main__":
    unittest.main()
