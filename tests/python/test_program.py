"""The command of packages, tack_program.py: which file it executes."""
import importlib.util
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest
from unittest import mock

import tack_program

V3 = "avx avx2 bmi1 bmi2 f16c fma abm movbe xsave"
V4 = V3 + " avx512f avx512bw avx512cd avx512dq avx512vl"


class Program(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name).resolve()
        module = self.root / "tack_program.py"
        module.write_text(pathlib.Path(tack_program.__file__).read_text(encoding="utf-8"), encoding="utf-8")
        spec = importlib.util.spec_from_file_location("packaged_program", module)
        self.program = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(self.program)

    def install(self, *folders):
        for folder in folders:
            file = self.root / "tack" / "bin" / folder / "tack"
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(f'#!/bin/sh\necho "{folder}: $0 $*"\nexit 7\n', encoding="utf-8")
            file.chmod(0o755)

    def chosen(self, flags, asked=""):
        with mock.patch.object(self.program, "_processor_flags", lambda: set(flags.split())), mock.patch.dict(os.environ, {"TACK_ARCHITECTURE": asked}):
            return self.program.file_of("bin", "tack").parent.name

    def test_the_best_that_package_and_processor_have_is_chosen(self):
        self.install("x86-64", "x86-64-v3", "x86-64-v4")
        self.assertEqual([self.chosen(flags) for flags in ("sse2", V3, V4, V4.replace("avx512vl", ""))], ["x86-64", "x86-64-v3", "x86-64-v4", "x86-64-v3"])
        self.assertEqual(self.chosen(V4, "x86-64"), "x86-64")

    def test_what_is_absent_is_said(self):
        self.install("x86-64", "x86-64-v3")
        with self.assertRaisesRegex(ImportError, "there is no 'x86-64-v4'; installed are: x86-64-v3, x86-64$"):
            self.chosen(V4, "x86-64-v4")
        with self.assertRaisesRegex(ImportError, "this processor is no x86-64-v3"):
            self.chosen("sse2", "x86-64-v3")

    def test_a_package_for_better_processors_says_so(self):
        self.install("x86-64-v3")
        with self.assertRaisesRegex(ImportError, "for processors that are x86-64-v3"):
            self.chosen("sse2")

    def test_a_package_for_one_machine_has_no_folders(self):
        self.install("")
        self.assertEqual(self.chosen("sse2", "x86-64-v3"), "bin")

    def test_arguments_and_exit_code_pass_through(self):
        self.install("x86-64")
        done = subprocess.run([sys.executable, self.root / "tack_program.py", "run", "a b.yaml"], capture_output=True, text=True, env={**os.environ, "TACK_ARCHITECTURE": ""})
        self.assertEqual((done.returncode, done.stderr), (7, ""))
        self.assertTrue(done.stdout.endswith("tack run a b.yaml\n"), done.stdout)

    def test_a_broken_package_is_an_error_of_one_line(self):
        done = subprocess.run([sys.executable, self.root / "tack_program.py"], capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)
        self.assertIn(str(self.root / "tack" / "bin" / "tack"), done.stderr)
