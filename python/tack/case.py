"""Runs one case of a batch or a calibration in a process of its own: `python -m tack.case run SCENE -o FOLDER --threads N`, with the exit codes of `tack run`.

SIGTERM, which a case gets at its time limit, ends the run with everything written. An exception that is no error of the scene is a failure, as in the program: left to Python, it would end
with the code of a failed expectation.
"""
from __future__ import annotations

import argparse
import json
import pathlib
import resource
import sys

import tack
from tack import _tack

done, expectation_failed, bad_input, failed, interrupted = 0, 1, 2, 3, 130


def main() -> int:
    parser = argparse.ArgumentParser(prog="tack.case")
    parser.add_argument("command", choices=["run"])
    parser.add_argument("scene")
    parser.add_argument("-o", "--output", required=True)
    parser.add_argument("--threads", type=int, default=0)
    parser.add_argument("--memory", type=float, help="limit of private memory [GB]")
    parser.add_argument("--resume", action="store_true")
    options = parser.parse_args()
    try:
        _tack.let_termination_interrupt()
        if options.memory is not None:
            limit = int(1e9 * options.memory)
            resource.setrlimit(resource.RLIMIT_DATA, (limit, limit))
        tack.run(options.scene, output=options.output, threads=options.threads, resume=options.resume)
        status = json.loads((pathlib.Path(options.output) / "summary.json").read_text(encoding="utf-8"))["status"]
        return {"done": done, "interrupted": interrupted}.get(status, expectation_failed)
    except tack.InputError as error:
        print(f"error: {error}", file=sys.stderr)
        return bad_input
    except tack.SimulationError as error:
        print(f"error: {error}", file=sys.stderr)
        return failed
    except KeyboardInterrupt:
        return interrupted
    except MemoryError:
        print("error: not enough memory for this scene; use fewer cells, or let it have more", file=sys.stderr)
        return failed
    except Exception as error:
        print(f"internal error: {type(error).__name__}: {error}", file=sys.stderr)
        return failed


if __name__ == "__main__":
    sys.exit(main())
