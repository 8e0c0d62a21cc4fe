#!/usr/bin/env bash
# run.sh BUILD PYTHON: the tests of the package in the build tree; skipped where it is not built, or Python lacks what it needs.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
package=$1/python python=${2:-python3}
[[ -e $package/tack/lib/libtack.so ]] || { echo "the package is not built: ./tack python"; exit 77; }
"$python" -c 'import numpy, scipy' 2>/dev/null || { echo "$python lacks NumPy or SciPy"; exit 77; }
cd "$(mktemp -d)"
PYTHONPATH=$package "$python" -m unittest discover -s "$here"
