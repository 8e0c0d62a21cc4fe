#!/usr/bin/env bash
# preset.sh ROOT PRESET [TOOL...]: builds everything by a preset and runs its tests, a nightly test of the release build. Skipped without a tool that the preset needs.
set -euo pipefail
cd "$1"
preset=$2
for tool in "${@:3}"; do command -v "$tool" >/dev/null || { echo "skipped: there is no $tool: ./tack test nightly installs it"; exit 77; }; done
cmake --preset "$preset"
cmake --build --preset "$preset"
# The page of reports is the same whatever compiles the program.
for folder in report share; do [[ ! -d build/release/$folder || -e build/$preset/$folder ]] || ln -s "../release/$folder" "build/$preset/$folder"; done
ctest --preset "$preset" -LE "nightly|docs"
