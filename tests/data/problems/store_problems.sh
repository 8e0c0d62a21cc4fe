#!/usr/bin/env bash
# Stores the problems of this folder anew: hard steps of the experiments, on small meshes. Run from the root of
# the repository (TACK: the program, unless ./tack); problem_set_test.cpp holds the iterations that each may take.
set -euo pipefail
here=$(dirname "$(readlink -f "$0")")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# store NAME REQUEST FILE [--set ...]: one problem of a run, as NAME.problem
store() {
  local name=$1 request=$2 file=$3
  shift 3
  "${TACK:-./tack}" run "$file" -q -o "$scratch/$name" --dump-problem "$request" --set output.frames=false expect=[] "$@" || true
  mv "$scratch/$name"/problems/*.problem "$here/$name.problem"
}

coarse='objects.lower.shape.cells=[8, 1, 3]'
store debonding_front hardest=1 experiments/debonding/peel.yaml --set time.step=5ms "$coarse" 'objects.upper.shape.cells=[5, 1, 2]'
store debonding hardest=1 experiments/debonding/pull.yaml --set time.step=5ms 'objects.lower.shape.cells=[5, 1, 5]'
blocks=('objects.lower.shape.cells=[4, 4, 4]' 'objects.upper.shape.cells=[4, 4, 4]')
store impact hardest=1 experiments/stack/two_blocks.yaml --set "${blocks[@]}"
store large_step hardest=1 experiments/stack/two_blocks.yaml --set "${blocks[@]}" time.step=50ms
store contrast hardest=1 experiments/stack/two_blocks.yaml --set "${blocks[@]}" 'objects.upper.energies.0.young=1 GPa'
store compression hardest=1 experiments/squash/block.yaml --set 'objects.block.shape.cells=[4, 4, 4]' time.step=50ms
store folding step=32 experiments/squash/block.yaml --set 'objects.block.shape.cells=[4, 4, 4]' time.step=50ms
store sliding hardest=1 experiments/slope/slide.yaml --set "objects.block.shape.cells=[5, 1, 3]" time.duration=0.5
store sticky_sliding hardest=1 experiments/shear/both.yaml --set 'objects.upper.shape.cells=[5, 1, 5]'
store sticky_wall hardest=1 experiments/wall_cube/stuck.yaml --set 'objects.cube.shape.cells=[3, 3, 3]' 'objects.wall.shape.cells=[1, 9, 3]'
store twist hardest=1 experiments/twist/mat.yaml --set 'objects.mat.shape.cells=[11, 1, 11]'
store arch_collapse hardest=1 experiments/arch/collapses.yaml --set time.duration=0.15
store parallel_edges hardest=1 tests/data/problems/crossed_bars.yaml
