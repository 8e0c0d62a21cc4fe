"""Stored steps, solved by the program's minimisers."""
import unittest

import numpy as np

import tack
from tack_test_scenes import source

impact = source / "tests/data/problems/impact.problem"


class Solving(unittest.TestCase):
    def test_one_solver_gives_one_answer_and_several_a_list(self):
        own = tack.solve(impact)
        self.assertTrue(own["converged"])
        self.assertLess(own["distance"], 0.01)
        exact, hasty = tack.solve(impact, ["newton_pcg", {"type": "projected_newton", "max_iterations": 1}], threads=1)
        self.assertEqual(exact["status"], "converged")
        self.assertFalse(hasty["converged"])
        self.assertLess(np.abs(exact["x"] - own["x"]).max(), 1e-4)

    def test_wrong_arguments_are_refused_by_name(self):
        with self.assertRaisesRegex(tack.InputError, "newton_pcg"):
            tack.solve(impact, "newton_pgc", minimum=False)
        with self.assertRaisesRegex(tack.InputError, "cannot read"):
            tack.solve("missing.problem")

    def test_no_distance_is_measured_without_a_minimum(self):
        self.assertIsNone(tack.solve(impact, minimum=False)["distance"])


if __name__ == "__main__":
    unittest.main()
