"""The program that runs a case of a batch or a calibration by this Python, as `tack run` does."""
from __future__ import annotations

import pathlib
import shlex
import shutil
import sys
import tempfile
import weakref

# Blocks SIGTERM before NumPy starts threads, which would take it from the thread that waits for it (tack.case). A failed import ends with the code of a failed run, which tack.case has.
_start = """
import signal, sys
signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGTERM])
try:
    from tack.case import main
except Exception as error:
    print(f"error: the Python package of tack cannot be imported: {error}", file=sys.stderr)
    sys.exit(3)
sys.exit(main())
"""


class CaseProgram:
    """A script, at `path`, that lasts as long as the object or its `with` block."""

    def __init__(self) -> None:
        folder = tempfile.mkdtemp()
        self._remove = weakref.finalize(self, shutil.rmtree, folder, ignore_errors=True)
        program = pathlib.Path(folder) / "tack"
        package = pathlib.Path(__file__).resolve().parents[1]
        program.write_text(f'#!/bin/sh\nPYTHONPATH={shlex.quote(str(package))}${{PYTHONPATH:+:$PYTHONPATH}} exec {shlex.quote(sys.executable)} -c {shlex.quote(_start)} "$@"\n',
                           encoding="utf-8")
        program.chmod(0o755)
        self.path = str(program)

    def __enter__(self) -> str:
        return self.path

    def __exit__(self, *_: object) -> None:
        self._remove()
