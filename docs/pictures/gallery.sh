#!/usr/bin/env bash
# Makes the pictures of docs/gallery.md anew: docs/pictures/gallery.sh [NAME...]
# Runs the scenes of experiments/batches/gallery.yaml, or those named, into results/gallery (what is done there and has not changed is not run again). Blender draws each as
# docs/pictures/NAME.yaml says (camera, looks, ground) into docs/images/gallery/NAME.png, with the size and the samples that all share. Ends with 1 if a scene did not show what it
# must: the batch says which, and its picture is not to be kept. `SAMPLES=16 docs/pictures/gallery.sh NAME` draws a trial.
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.."
batch=experiments/batches/gallery.yaml runs=results/gallery
shared=("size=[960, 720]" "samples=${SAMPLES:-512}" time=false)

mapfile -t names < <((($#)) && printf '%s\n' "$@" || sed -n 's/^  - {name: \([a-z_]*\),.*/\1/p' "$batch")
only=()
for name in "${names[@]}"; do only+=(--only "base=$name"); done

status=0
./tack batch "$batch" -o "$runs" "${only[@]}" || status=$?
((status <= 1)) || exit "$status"
for name in "${names[@]}"; do
  ./tack render "$runs/cases/base=$name" -q --with blender --view "docs/pictures/$name.yaml" --set "${shared[@]}" -o "docs/images/gallery/$name.png"
done
exit "$status"
