"""docs/tutorial.ipynb: its cells run, and its shipped outputs are those of this program."""
import importlib.util
import json
import re
import unittest

import numpy as np

import tack  # noqa: F401
from tack_test_scenes import source

path = source / "docs/tutorial.ipynb"
# Numbers of other machines: instruction sets differ in rounding, and steps of a solve stop within its tolerance.
tolerance = 2e-3


def numbers(text):
    """The numbers of a text, without counts in words."""
    return [float(one) for one in re.findall(r"(?<![\w.])[-+]?\d+\.?\d*(?:e[-+]?\d+)?", text)]


def text_of(output):
    return "".join(output["text"] if output["output_type"] == "stream" else output["data"]["text/plain"])


def figures(cell):
    return [output["data"]["image/png"] for output in cell["outputs"] if "image/png" in output.get("data", {})]


class Notebook(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        try:
            import matplotlib  # noqa: F401
        except ImportError:
            raise unittest.SkipTest("matplotlib is not installed")
        module = importlib.util.spec_from_file_location("notebook", source / "docs/site/notebook.py")
        cls.program = importlib.util.module_from_spec(module)
        module.loader.exec_module(cls.program)
        cls.shipped = json.loads(path.read_text(encoding="utf-8"))
        cls.names = {}
        cls.made = cls.program.run(path, cls.names)

    def code_cells(self):
        pairs = list(zip(self.shipped["cells"], self.made["cells"]))
        self.assertEqual(len(self.shipped["cells"]), len(self.made["cells"]))
        return [(old, new) for old, new in pairs if new["cell_type"] == "code"]

    def test_shipped_outputs_are_those_of_the_cells(self):
        compared = 0
        for old, new in self.code_cells():
            name = "".join(new["source"])
            self.assertEqual(old["execution_count"], new["execution_count"], name)
            self.assertEqual([one["output_type"] for one in old["outputs"]], [one["output_type"] for one in new["outputs"]], name)
            for shipped, made in zip(old["outputs"], new["outputs"]):
                a, b = numbers(text_of(shipped)), numbers(text_of(made))
                self.assertEqual(len(a), len(b), name)
                # Differences of two solutions are noise below the tolerance of a step.
                np.testing.assert_allclose(a, b, rtol=tolerance, atol=2e-7, err_msg=name)
                compared += len(a)
        self.assertGreater(compared, 10)

    def test_every_plot_is_shipped_as_a_figure(self):
        plots = 0
        for old, new in self.code_cells():
            self.assertEqual(len(figures(old)), len(figures(new)))
            if "plt.plot" in "".join(new["source"]) or "plt.semilogx" in "".join(new["source"]):
                self.assertEqual(len(figures(old)), 1)
                plots += 1
        self.assertGreaterEqual(plots, 3)

    def test_axes_have_units(self):
        for _, new in self.code_cells():
            for label in re.findall(r'[xy]label\("([^"]*)"\)|[xy]label="([^"]*)"', "".join(new["source"])):
                self.assertRegex("".join(label), r"\[[^\]]+\]$")

    def test_it_shows_what_it_says(self):
        names = self.names
        self.assertGreater(names["force"].max(), 0)
        self.assertLess(abs(names["force"][-1]), 1e-5)
        soft, middle, stiff = names["peaks"].values()
        self.assertTrue(soft < middle < stiff < 5.1e3)
        self.assertLess(np.abs(names["own"].x - names["ours"].x).max(), 1e-6)
        self.assertEqual(names["results"].summary["status"], "done")
        # The plot of tractions has the whole lower face: its forces are that of the probe.
        held = names["pulled"].sum()
        self.assertEqual(len(names["along"]), 41)
        self.assertTrue(0.07 < held < 0.1)
        self.assertLess((names["pulled"] / names["area"]).max(), 5.05e3)
        self.assertIn("finished", "".join(text_of(one) for one in self.shipped["cells"][3]["outputs"]))


if __name__ == "__main__":
    unittest.main()
