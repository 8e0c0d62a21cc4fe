#!/usr/bin/env bash
# Makes the pictures of docs/gallery.md anew: docs/pictures/gallery.sh [NAME...]
#
# Runs the scenes of experiments/batches/gallery.yaml, or those named, into results/gallery; runs that are
# done and have not changed are not repeated. Blender draws each as docs/pictures/NAME.yaml says (camera,
# looks, ground) into docs/images/gallery/NAME.png. Bases NAME_000, NAME_010, ... are one picture, side by
# side. All pictures share the samples, and the size unless a view has its own: 128 paths per pixel leave
# little grain, and pictures of 90 to 420 kB.
#
# Ends with 1 if a scene did not show what it must: the batch says which, and its picture is not to be
# kept. `SAMPLES=16 docs/pictures/gallery.sh NAME` draws a trial.
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.."
batch=experiments/batches/gallery.yaml runs=results/gallery
shared=("samples=${SAMPLES:-128}" time=false)

mapfile -t bases < <(sed -n 's/^  - {name: \([a-z_0-9]*\),.*/\1/p' "$batch")
mapfile -t names < <((($#)) && printf '%s\n' "$@" || printf '%s\n' "${bases[@]}" | sed 's/_[0-9]*$//' | uniq)
bases_of() { printf '%s\n' "${bases[@]}" | grep -xE "$1(_[0-9]+)?" || { echo "$batch has no base $1" >&2; exit 2; }; }
only=()
for name in "${names[@]}"; do for base in $(bases_of "$name"); do only+=(--only "base=$base"); done; done

status=0
./tack batch "$batch" -o "$runs" "${only[@]}" || status=$?
((status <= 1)) || exit "$status"
for name in "${names[@]}"; do
  view=docs/pictures/$name.yaml folders=() size=()
  for base in $(bases_of "$name"); do folders+=("$runs/cases/base=$base"); done
  grep -q '^size:' "$view" || size=("size=[640, 480]")
  ./tack render "${folders[@]}" -q --with blender --view "$view" --set "${shared[@]}" "${size[@]}" -o "docs/images/gallery/$name.png"
done
exit "$status"
