"""Changes of a scene between steps."""
import unittest

import tack

scene = {
    "name": "change", "time": {"step": 0.01, "duration": 1, "integrator": "quasi_static"},
    "objects": [{"name": "block", "shape": {"type": "box", "size": [0.01, 0.01, 0.01]}, "energies": [{"type": "neo_hookean", "young": 1e5, "poisson": 0, "density": 1000}],
                 "motion": [{"type": "fixed", "select": {"type": "face", "direction": [0, -1, 0]}},
                            {"type": "translate", "velocity": [0, -1e-3, 0], "select": {"type": "face", "direction": [0, 1, 0]}}]}],
    "probes": [{"name": "force", "type": "reaction", "object": "block", "select": {"type": "face", "direction": [0, 1, 0]}, "direction": [0, -1, 0]}],
}


class Changes(unittest.TestCase):
    def test_a_translation_goes_on_with_another_velocity_and_the_change_is_kept(self):
        sim = tack.Simulation(scene)
        block = sim["block"]

        def turn(s):
            if s.steps == 10:
                s.change({"objects.block.motion.1.velocity": [0, 2e-3, 0]})

        sim.run(until=0.15, callback=turn)
        self.assertAlmostEqual(block.x[:, 1].max(), 0.005 - 1e-4 + 1e-4, places=12)
        self.assertEqual([(c["step"], c["key"]) for c in sim.changes], [(10, "objects.block.motion.1.velocity")])
        self.assertAlmostEqual(sim.changes[0]["time"], 0.1)

    def test_a_material_changes(self):
        sim = tack.Simulation(scene)
        sim.run(until=0.1)
        soft = sim.probes()["force"]
        sim.change({"objects.block.energies.0.young": 3e5})
        sim.step()
        self.assertAlmostEqual(sim.probes()["force"] / soft, 3 * 1.1, delta=0.05)

    def test_what_cannot_go_on_is_refused_and_changes_nothing(self):
        sim = tack.Simulation(scene)
        sim.run(until=0.05)
        with self.assertRaisesRegex(tack.InputError, "another mesh|vertices"):
            sim.change({"objects.block.shape.size": [0.02, 0.01, 0.01], "objects.block.shape.cells": [2, 1, 1]})
        sim.step()
        self.assertEqual(sim.changes, [])
        self.assertEqual(sim.steps, 6)


if __name__ == "__main__":
    unittest.main()
