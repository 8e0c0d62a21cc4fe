#!/usr/bin/env bash
# stubs.sh BUILD PYTHON: mypy's stubtest holds _tack.pyi against the compiled module, and mypy checks the package; skipped without them (Debian: mypy).
set -euo pipefail
package=$1/python python=${2:-python3}
[[ -e $package/tack/lib/libtack.so ]] || { echo "the package is not built: ./tack python"; exit 77; }
command -v stubtest >/dev/null || { echo "skipped: there is no stubtest (Debian: mypy)"; exit 77; }
"$python" -c 'import numpy, scipy' 2>/dev/null || { echo "$python lacks NumPy or SciPy"; exit 77; }
cd "$(mktemp -d)"
# Names of Python's import system, and signatures that pybind11 does not give to `inspect`.
printf '%s\n' 'tack._tack.__.*__' >allowed
printf '[mypy]\nignore_missing_imports = True\n' >mypy.ini
PYTHONPATH=$package MYPYPATH=$package stubtest tack._tack --allowlist allowed --ignore-unused-allowlist --mypy-config-file mypy.ini
MYPYPATH=$package mypy --config-file mypy.ini "$package/tack"
