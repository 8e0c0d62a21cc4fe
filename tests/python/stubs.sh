#!/usr/bin/env bash
# stubs.sh BUILD PYTHON: mypy's stubtest holds _tack.pyi against the compiled module, and mypy checks the package and finds its types (py.typed); skipped without them (Debian: mypy).
set -euo pipefail
package=$1/python python=${2:-python3}
[[ -e $package/tack/lib/libtack.so ]] || { echo "the package is not built: ./tack python"; exit 77; }
"$python" -c 'import numpy, scipy, mypy.stubtest' 2>/dev/null || { echo "$python lacks NumPy, SciPy or mypy (Debian: mypy)"; exit 77; }
cd "$(mktemp -d)"
# Metaclass and constructor of the classes are those of pybind11.
printf '%s\n' 'tack\._tack\.(Object|Problem|Running|Fit)(\.__init__)?' >allowed
printf '[mypy]\nignore_missing_imports = True\n' >mypy.ini
PYTHONPATH=$package MYPYPATH=$package "$python" -m mypy.stubtest tack._tack --allowlist allowed --ignore-unused-allowlist --mypy-config-file mypy.ini
MYPYPATH=$package "$python" -m mypy --config-file mypy.ini "$package/tack"
# A script of a user, for whom mypy looks at installed packages alone: its mistake is found, so that the comment is needed.
echo 'import tack
number: int = tack.Simulation("scene.yaml")  # type: ignore[assignment]' >use.py
printf '[mypy]\n' >user.ini
PYTHONPATH=$package "$python" -m mypy --config-file user.ini --warn-unused-ignores use.py
