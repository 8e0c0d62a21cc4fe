"""The command `tack` of an installed package, and the choice of the instruction set that packages contain several of.

A package has `bin/tack` and `lib/libtack.so`, or both in a folder for each instruction set. This module is outside the package: the command needs neither NumPy nor libtack.so in
this process.
"""
from __future__ import annotations

import os
import pathlib
import sys

# Instruction sets of x86-64, best first, with the flags of /proc/cpuinfo that the psABI asks for.
_V3 = {"avx", "avx2", "bmi1", "bmi2", "f16c", "fma", "abm", "movbe", "xsave"}
_FLAGS: dict[str, set[str]] = {"x86-64-v4": _V3 | {"avx512f", "avx512bw", "avx512cd", "avx512dq", "avx512vl"}, "x86-64-v3": _V3, "x86-64": set()}


def _processor_flags() -> set[str]:
    try:
        with open("/proc/cpuinfo", encoding="ascii", errors="replace") as lines:
            return next((set(line.split(":", 1)[1].split()) for line in lines if line.startswith("flags")), set())
    except OSError:
        return set()


def file_of(folder: str, name: str) -> pathlib.Path:
    """Returns the path of a file of the package, `bin/tack` or `lib/libtack.so`, for the best instruction set that package and processor have.

    The environment variable TACK_ARCHITECTURE names another one. Raises ImportError if the package or the processor lacks it.
    """
    root = pathlib.Path(__file__).resolve().parent / "tack" / folder
    installed = [architecture for architecture in _FLAGS if (root / architecture / name).is_file()]
    if not installed:
        return root / name
    asked, flags = os.environ.get("TACK_ARCHITECTURE", ""), _processor_flags()
    if asked and asked not in installed:
        raise ImportError(f"TACK_ARCHITECTURE: there is no '{asked}'; installed are: {', '.join(installed)}")
    if asked and not _FLAGS[asked] <= flags:
        raise ImportError(f"TACK_ARCHITECTURE: this processor is no {asked}; leave it out")
    usable = [architecture for architecture in installed if _FLAGS[architecture] <= flags]
    if not usable:
        raise ImportError(f"this package is for processors that are {' or '.join(installed)}; make one for x86-64: packaging/wheel.sh x86-64")
    return root / (asked or usable[0]) / name


def main() -> None:
    """Executes the program of the package with the arguments of this process."""
    try:
        program = file_of("bin", "tack")
        os.execv(program, ["tack", *sys.argv[1:]])
    except ImportError as error:
        print(f"error: {error}", file=sys.stderr)
    except OSError as error:
        print(f"error: {program} cannot be started: {error.strerror}; install the package again", file=sys.stderr)
    sys.exit(2)


if __name__ == "__main__":
    main()
