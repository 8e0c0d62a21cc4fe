#!/usr/bin/env bash
# Makes the pictures of README.md and docs/ anew, from the project's own runs: docs/pictures/make.sh
# Runs experiments/batches/{phases,distances,strengths,jkr_dmt,paper_figures,gallery}.yaml and the comparison of solvers into results/ (two and a half hours on two cores; what is
# done there already is not run again), then draws. Needs what `./tack report` and its test need: npm, node, Chromium.
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.."
tack=build/release/bin/tack
images=docs/images

./tack --version
cmake --build --preset release --target tack_meshing tack_report
mkdir -p "$images/gallery"

# draw DIR [ARGS of tack plot] -- PLOT=IMAGE...: plots of a folder under the names that the documents use.
draw() {
  local folder=$1 arguments=() scratch
  shift
  while [[ $1 != -- ]]; do arguments+=("$1"); shift; done
  shift
  scratch=$(mktemp -d)
  "$tack" plot "$folder" "${arguments[@]}" -o "$scratch" >/dev/null
  for pair in "$@"; do cp "$scratch/${pair%%=*}.svg" "$images/${pair##*=}.svg"; done
  rm -r "$scratch"
}

for batch in phases distances strengths jkr_dmt paper_figures; do "$tack" batch "experiments/batches/$batch.yaml" -o "results/$batch"; done
draw results/phases -- phase_shares=phases
draw results/phases/cases/base=plates --x gap --y adhesion --x-range 0 2.5e-3 -- adhesion_over_gap=pull_force_gap
draw results/distances -- iterations=distances_iterations probe_taken=distances_taken
draw results/jkr_dmt --x tabor --y pull_off --log-x --data experiments/measured/data/maugis.csv -- pull_off_by_tabor=jkr_dmt
draw results/paper_figures -- $(for name in 5 9_right 10_stuck 10_iterations 12_taken 13_crossings 13_waist 18; do echo "figure_$name=paper_figure_$name"; done)
draw results/strengths -- step_seconds=strengths_step_seconds iterations=strengths_iterations probe_taken=strengths_taken

[[ -d results/compare_pull ]] || "$tack" compare experiments/compare/pull.yaml -o results/compare_pull
cp results/compare_pull/plots/work_precision.svg "$images/pull_work_precision.svg"

laws=$(mktemp -d)
"$tack" law --type rcc normal_stiffness=1e8 tangential_stiffness=5e7 work_of_adhesion=1 -o "$laws" >/dev/null
for name in traction unloading; do cp "$laws/$name.svg" "$images/law_rcc_$name.svg"; done
rm -r "$laws"

docs/pictures/gallery.sh

node docs/pictures/views.mjs "$tack" build/release/report results/phases/cases "$images"
