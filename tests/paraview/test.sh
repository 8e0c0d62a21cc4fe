#!/usr/bin/env bash
# test.sh TACK SOURCE: reads the frames of a run with every kind of object in ParaView; skipped where there is no ParaView.
set -euo pipefail
tack=$1 source=$2
command -v pvpython >/dev/null || { echo "skipped: there is no ParaView (Debian: paraview python3-paraview); ./tack test nightly installs it"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
cp "$source"/tests/blender/{scene.yaml,quads.obj,quads.mtl} .
"$tack" run scene.yaml -q -o run
pvpython "$source/tests/paraview/check.py" run "$source" >log.txt 2>&1 || { cat log.txt; exit 1; }
grep '^agrees: ' log.txt || { cat log.txt; exit 1; }
