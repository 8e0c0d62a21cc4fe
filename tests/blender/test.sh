#!/usr/bin/env bash
# test.sh TACK SOURCE: exports a run with every kind of object and opens each format in Blender; skipped where there is no Blender.
set -euo pipefail
tack=$1 source=$2
command -v blender >/dev/null || { echo "skipped: there is no Blender (Debian: blender); ./tack test nightly installs it"; exit 77; }
here=$source/tests/blender
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
cp "$here"/scene.yaml "$here"/quads.obj "$here"/quads.mtl .
"$tack" run scene.yaml -q -o run
for format in $(cat "$here/formats"); do "$tack" export run --to "$format"; done
# The script of docs/exporting.md, as it stands there.
awk '/^```python$/ {inside = 1; next} /^```$/ {if (inside) exit} inside' "$source/docs/exporting.md" >play.py
grep -q MESH_CACHE play.py
blender -b --factory-startup --python-exit-code 1 --python play.py --python "$here/check.py" -- run/export/pc2 "$source" >log.txt 2>&1 || { cat log.txt; exit 1; }
grep -q '^all formats agree$' log.txt || { cat log.txt; exit 1; }
grep '^agrees: ' log.txt
# A mesh that was modelled in Blender, simulated and played on itself.
run_blender() { blender -b "$@" >log.txt 2>&1 || { cat log.txt; exit 1; }; }
run_blender --factory-startup --python-exit-code 1 --python "$here/own_mesh.py" -- make "$source"
cp "$here/ring.yaml" .
"$tack" run ring.yaml -q -o ring
run_blender ring.blend --python-exit-code 1 --python "$here/own_mesh.py" -- play "$source"
grep '^agrees: ' log.txt || { cat log.txt; exit 1; }
