"""Stored steps, solved by the program's minimisers."""
import unittest

import numpy as np

import tack
from tack_test_scenes import newton, source

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

    def test_functions_are_measured_beside_the_program_s_minimisers(self):
        own, program = tack.solve(impact, [newton, "newton_pcg"], threads=1)
        self.assertEqual((own["solver"], program["solver"]), ("newton", "newton_pcg"))
        self.assertEqual((own["status"], program["status"]), ("converged", "converged"))
        self.assertGreater(own["iterations"], 0)
        self.assertGreater(own["evaluations"], 0)
        self.assertLess(np.abs(own["x"] - program["x"]).max(), 1e-4)
        self.assertEqual(tack.solve(impact, newton)["solver"], "newton")

    def test_what_a_function_does_wrong_is_said(self):
        start = tack.solve(impact, lambda problem: problem.start)
        self.assertFalse(start["converged"])
        self.assertRegex(start["status"], "the minimiser returned a point that has not converged: (the stopping norm is|forces are out of balance by)")
        with self.assertRaisesRegex(ZeroDivisionError, "division") as raised:
            tack.solve(impact, lambda problem: 1 / 0)
        self.assertIn("step ", "".join(raised.exception.__notes__))

    def test_no_distance_is_measured_without_a_minimum(self):
        self.assertIsNone(tack.solve(impact, minimum=False)["distance"])


if __name__ == "__main__":
    unittest.main()
