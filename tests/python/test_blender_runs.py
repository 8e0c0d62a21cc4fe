"""The parts of report/blender_runs.py that need no Blender."""
import sys
import unittest
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "report"))
import blender_runs  # noqa: E402


class Rotations(unittest.TestCase):
    def test_the_direction_against_gravity_is_up_in_pictures(self):
        random = np.random.default_rng(1)
        for up in [*random.normal(size=(20, 3)), np.array([-0.48, 0.876, 0])]:
            turn = blender_runs.rotation_to_z(up)
            np.testing.assert_allclose(turn @ up, [0, 0, np.linalg.norm(up)], atol=1e-12)
            np.testing.assert_allclose(turn @ turn.T, np.eye(3), atol=1e-12)
            self.assertGreater(np.linalg.det(turn), 0)

    def test_axes_turn_as_importers_of_blender_turn_them(self):
        np.testing.assert_array_equal(blender_runs.rotation_to_z(np.array([0, 1, 0])) @ [1, 2, 3], [1, -3, 2])
        np.testing.assert_array_equal(blender_runs.rotation_to_z(np.array([0, 0, 2])), np.eye(3))


class Pictures(unittest.TestCase):
    def test_a_number_replaces_the_last_pattern_of_the_name_alone(self):
        for pattern, picture in [("film_%04d.png", "film_0007.png"), ("/50% strain/pic_%03d.png", "/50% strain/pic_007.png"), ("/a_%02d/100%/%d_%01d.png", "/a_%02d/100%/%d_7.png"),
                                 ("/a_%02d_%03d.png", "/a_%02d_007.png")]:
            self.assertEqual(blender_runs.numbered_picture(pattern, 7), picture)
        self.assertEqual(blender_runs.numbered_picture("film_%02d.png", 123), "film_123.png")


class Thickness(unittest.TestCase):
    def test_rods_particles_and_offset_surfaces_reach_beyond_their_vertices(self):
        run = object.__new__(blender_runs.Run)
        run.turn, run.size = np.eye(3), 10
        shape = {"vertices": 1, "radius": 0.0, "face_sizes": [], "look": {}}
        sheet = {**shape, "face_sizes": [3], "x": np.array([[[0, 0, 5.0]], [[0, 0, 4.0]]])}
        grain = {**shape, "radius": 0.5, "x": np.array([[[0, 0, 4.4]], [[0, 0, 4.45]]])}
        dot = {**shape, "x": np.array([[[0, 0, 2.0]], [[0, 0, 2.0]]])}
        for objects, lowest in [([sheet], 4), ([sheet, grain], 3.9), ([{**sheet, "look": {"offset": 0.2}}, grain], 3.8), ([{**grain, "look": {"offset": 0.1}}], 3.8),
                                ([sheet, {**dot, "look": {"hide": True}}], 4), ([dot], 2 - 10 * blender_runs.DEFAULT_RADIUS),
                                ([{**dot, "radius": 1e-6}], 2 - 10 * blender_runs.SMALLEST_RADIUS)]:
            run.objects = objects
            self.assertAlmostEqual(run.box([0, 1])[0][2], lowest)


if __name__ == "__main__":
    unittest.main()
