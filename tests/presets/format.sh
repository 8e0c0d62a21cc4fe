#!/usr/bin/env bash
# format.sh ROOT: checks that clang-format with .clang-format changes no header. To mend one: clang-format -i FILE. Skipped without clang-format.
set -euo pipefail
command -v clang-format >/dev/null || { echo "skipped: there is no clang-format: ./tack test nightly installs it"; exit 77; }
cd "$1"
find geometry framework energies solvers python tests -name '*.hpp' -print0 | xargs -0 clang-format --dry-run -Werror
