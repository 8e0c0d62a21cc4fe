"""Errors, the process around the package, and what notebooks show."""
import html
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import tack
from tack_test_scenes import source, blocks, small, falling, run_python


class Notebooks(unittest.TestCase):
    def test_notebooks_show_reports(self):
        if not (pathlib.Path(tack.__file__).parent / "share/report.html").exists():
            self.skipTest("the page of reports is not built")
        sim = tack.Simulation(blocks, set=small)
        sim.step()
        shown = sim._repr_html_()
        self.assertTrue(shown.startswith("<iframe"))
        self.assertGreater(len(shown), 100000)
        self.assertIn('"status":"unfinished"', html.unescape(shown))
        self.assertIn("at 0.01 s of 0.6 s", repr(sim))

    def test_names_of_scenes_need_not_be_names_of_files(self):
        if not (pathlib.Path(tack.__file__).parent / "share/report.html").exists():
            self.skipTest("the page of reports is not built")
        with tempfile.TemporaryDirectory() as folder:
            for name in ("peel 90/10", f"{folder}/scene", ".."):
                self.assertIn(f'"name":"{name}"', html.unescape(tack.Simulation({**falling, "name": name})._repr_html_()))
            self.assertEqual(list(pathlib.Path(folder).iterdir()), [])

    def test_a_simulation_that_has_ended_says_so(self):
        sim = tack.Simulation(falling).run()
        self.assertIn("finished at 0.1 s", repr(sim))
        if not (pathlib.Path(tack.__file__).parent / "share/report.html").exists():
            self.skipTest("the page of reports is not built")
        self.assertIn('"status":"done"', html.unescape(sim._repr_html_()))


class Cases(unittest.TestCase):
    """The process of a case of a batch (tack.case)."""

    def test_every_exception_ends_a_case_with_an_error_and_a_code_of_its_own(self):
        with tempfile.TemporaryDirectory() as folder:
            for raised, code, message in [("None", 3, "internal error: FileNotFoundError: .*summary.json"), ("MemoryError()", 3, "^error: not enough memory for this scene"),
                                          ("RuntimeError('none')", 3, "^internal error: RuntimeError: none$"), ("OSError(28, 'no space')", 3, "^internal error: OSError: .*no space"),
                                          ("tack.InputError('one')", 2, "^error: one$"), ("tack.SimulationError('two')", 3, "^error: two$"), ("KeyboardInterrupt()", 130, "^$")]:
                ended = run_python(f"""
import sys, tack, tack.case
def fail(*_, **__):
    if ({raised}) is not None: raise {raised}
tack.run = fail
sys.argv = ["tack", "run", "scene.yaml", "-o", {folder!r}]
sys.exit(tack.case.main())""")
                self.assertEqual(ended.returncode, code, ended.stderr)
                self.assertRegex(ended.stderr.strip(), message)

    def test_a_package_that_cannot_be_imported_fails_the_case(self):
        from tack import case_program
        ended = run_python("import sys\nsys.modules['tack.case'] = None\n" + case_program._start)
        self.assertEqual(ended.returncode, 3)
        self.assertRegex(ended.stderr, "^error: the Python package of tack cannot be imported: .*tack.case")


class Errors(unittest.TestCase):
    def test_errors_name_the_source_location(self):
        with self.assertRaisesRegex(tack.InputError, "yong.*young"):
            tack.Simulation(falling, set={"objects.cube.energies.0.yong": "1 MPa"})
        with self.assertRaises(ValueError):
            tack.Simulation("nowhere.yaml")
        with self.assertRaisesRegex(tack.InputError, "is not a results folder"):
            tack.read(source / "docs")

    def test_a_locale_with_commas_changes_nothing(self):
        with tempfile.TemporaryDirectory() as folder:
            made = shutil.which("localedef") and subprocess.run(["localedef", "-i", "de_DE", "-f", "UTF-8", f"{folder}/de_DE.UTF-8"], capture_output=True)
            if not made or made.returncode != 0:
                self.skipTest("no locale with commas can be made here")
            code = """
import locale, resource, tack
resource.setrlimit(resource.RLIMIT_CPU, (30, 31))
scene = {"name": "p", "parameters": {"w": "0.1 m", "h": "5 ms"}, "time": {"step": "h", "duration": "0.5 s"}, "objects": [
    {"name": "b", "shape": {"type": "box", "size": ["0.5 * w", "w", "1.5 * w"]}, "energies": [{"type": "neo_hookean", "young": "0.1 MPa"}],
     "motion": [{"type": "formula", "x": "0.5 * t", "select": {"type": "face", "direction": [0, 1, 0]}}]}]}
if SET: locale.setlocale(locale.LC_ALL, "de_DE.UTF-8")
sim = tack.Simulation(scene, threads=1)
sim.step()
print(sim.x.tolist())
"""
            environment = {**os.environ, "LOCPATH": folder}
            plain, commas = (run_python(code.replace("SET", answer), env=environment) for answer in ("False", "True"))
            self.assertEqual(commas.returncode, 0, commas.stderr)
            self.assertEqual(commas.stdout, plain.stdout)

    def test_characters_beyond_the_first_plane(self):
        for about in ("\u00fc 1 \u00b5m", "\U0001d6fe = 3", "\U0001f600"):
            sim = tack.Simulation({**falling, "about": about})
            self.assertIn(about, sim.scene())
            self.assertIn(about, tack.Simulation(falling, set={"about": about}).scene())

    def test_ctrl_c(self):
        code = f"""
import tack, sys
sim = tack.Simulation({str(blocks)!r}, set={{"objects.lower.shape.cells": [24, 24, 24], "objects.upper.shape.cells": [24, 24, 24], "time.duration": "100 s"}})
print("ready", flush=True)
try:
    sim.run()
except KeyboardInterrupt:
    steps = sim.steps
    print("stopped", flush=True)
"""
        process = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True)
        try:
            self.assertEqual(process.stdout.readline().strip(), "ready")
            time.sleep(1)
            process.send_signal(signal.SIGINT)
            out, _ = process.communicate(timeout=60)
        finally:
            process.kill()
        self.assertEqual(out.strip(), "stopped")
        self.assertEqual(process.returncode, 0)

    def test_no_traces_are_left_in_the_process(self):
        result = run_python(f"import signal, tack; sim = tack.Simulation({str(blocks)!r}); sim.step(); "
                            "assert signal.getsignal(signal.SIGINT) is signal.default_int_handler; print(sim.steps)")
        self.assertEqual(result.stdout.strip(), "1", result.stderr)

if __name__ == "__main__":
    unittest.main()
