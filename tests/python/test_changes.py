"""Changes of a scene between steps."""
import unittest

import numpy as np
import tack

scene = {
    "name": "change", "time": {"step": 0.01, "duration": 1, "integrator": "quasi_static"},
    "objects": [{"name": "block", "shape": {"type": "box", "size": [0.01, 0.01, 0.01], "cells": [2, 2, 2]}, "energies": [{"type": "neo_hookean", "young": 1e5, "poisson": 0, "density": 1000}],
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

    def test_a_changed_load_and_a_changed_velocity_are_those_of_a_scene_with_times(self):
        block = dict(scene["objects"][0], loads=[{"type": "body_force", "value": [0, -100, 0]}])
        ramp = {"type": "body_force", "value": [0, -100, 0], "ramp": [[0, 1], [0.1, 1], [0.1001, 3], [1, 3]]}
        path = {"type": "formula", "y": "t < 0.1 ? -1e-3 * t : -1e-4 + 2e-3 * (t - 0.1)", "select": block["motion"][1]["select"]}
        timed = tack.Simulation(dict(scene, objects=[dict(block, loads=[ramp], motion=[block["motion"][0], path])]))
        sim = tack.Simulation(dict(scene, objects=[block]))
        sim.run(until=0.1)
        sim.change({"objects.block.loads.0.value": [0, -300, 0], "objects.block.motion.1.velocity": [0, 2e-3, 0]})
        sim.run(until=0.2)
        timed.run(until=0.2)
        np.testing.assert_allclose(sim["block"].x, timed["block"].x, rtol=0, atol=1e-9)
        self.assertAlmostEqual(sim.probes()["force"] / timed.probes()["force"], 1, places=5)

    def test_a_wrong_key_in_a_callback_leaves_the_simulation_as_it_is(self):
        sim, other = tack.Simulation(scene), tack.Simulation(scene)
        with self.assertRaisesRegex(tack.InputError, "unknown key 'velocty' in motion 'translate'; did you mean 'velocity'"):
            sim.run(until=0.1, callback=lambda s: s.change({"objects.block.motion.1.velocty": [0, 0, 0]}) if s.steps == 5 else None)
        sim.run(until=0.1)
        other.run(until=0.1)
        self.assertTrue((sim["block"].x == other["block"].x).all())
        self.assertEqual(sim.changes, [])

    def test_what_cannot_go_on_is_refused_and_changes_nothing(self):
        sim = tack.Simulation(scene)
        sim.run(until=0.05)
        with self.assertRaisesRegex(tack.InputError, "another mesh|vertices"):
            sim.change({"objects.block.shape.size": [0.02, 0.01, 0.01], "objects.block.shape.cells": [3, 2, 2]})
        sim.step()
        self.assertEqual(sim.changes, [])
        self.assertEqual(sim.steps, 6)


if __name__ == "__main__":
    unittest.main()
