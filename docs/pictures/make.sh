#!/usr/bin/env bash
# Makes the pictures of README.md and docs/ anew, from the project's own runs: docs/pictures/make.sh [GROUP...]
# Groups are the functions below, in their order. What a group runs stays in results/, and is not run again where nothing has changed. All of them take most of a day on two
# cores: `solvers` hours, `gallery`, `paper`, `phases` and `distances` about an hour each, the others minutes. Each picture has one maker: this script names all but those of the
# gallery, which are made by gallery.sh.
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.."
images=docs/images

# draw DIR [ARGS of tack plot] -- PLOT=IMAGE...: plots of a folder under the names that the documents use.
draw() {
  local folder=$1 arguments=() scratch
  shift
  while [[ $1 != -- ]]; do arguments+=("$1"); shift; done
  shift
  scratch=$(mktemp -d)
  ./tack plot "$folder" "${arguments[@]}" -o "$scratch" >/dev/null
  for pair in "$@"; do cp "$scratch/${pair%%=*}.svg" "$images/${pair##*=}"; done
  rm -r "$scratch"
}

batch() { ./tack batch "experiments/batches/$1.yaml" -o "results/$1"; }
compare() { [[ -d results/compare_$1 ]] || ./tack compare "experiments/compare/$1.yaml" -o "results/compare_$1"; }

pipeline() { docs/pictures/pipeline.py; }  # pipeline.svg

phases() {
  batch phases
  draw results/phases -- phase_shares=phases.svg
}

pull() {
  ./tack run experiments/debonding/pull.yaml -q -o results/pull
  draw results/pull --x gap --y adhesion --x-range 0 2.5e-3 -- adhesion_over_gap=pull_force_gap.svg
}

laws() {
  local scratch
  scratch=$(mktemp -d)
  ./tack law --type rcc normal_stiffness=1e8 tangential_stiffness=5e7 work_of_adhesion=1 -o "$scratch" >/dev/null
  cp "$scratch/traction.svg" "$images/law_rcc_traction.svg"
  cp "$scratch/unloading.svg" "$images/law_rcc_unloading.svg"
  rm -r "$scratch"
}

distances() {
  batch distances
  draw results/distances -- iterations=distances_iterations.svg
}

strengths() {
  batch strengths
  draw results/strengths -- iterations=strengths_iterations.svg
}

measured() {
  batch jkr_dmt
  draw results/jkr_dmt --x tabor --y pull_off --log-x --data experiments/measured/data/maugis.csv -- pull_off_by_tabor=jkr_dmt.svg
  batch viscoelastic_jkr
  draw results/viscoelastic_jkr --x tau --y enhancement --log-x --data experiments/measured/data/viscoelastic_jkr.csv -- enhancement_by_tau=viscoelastic_jkr.svg
  batch viscoelastic_peel
  draw results/viscoelastic_peel --x pull --y speed --log-x --log-y --data experiments/viscoelastic/peel.csv -- speed_by_pull=viscoelastic_peel.svg
}

calibration() {
  ./tack calibrate experiments/calibration/tack_fit.yaml -o results/tack_fit
  draw results/tack_fit -- fit_fast=tack_fit_fast.svg fit_medium=tack_fit_medium.svg fit_slow=tack_fit_slow.svg
}

# integrators_beam.svg integrators_bounce.svg integrators_creep.svg integrators_impact.svg integrators_top.svg
integrators() { ./tack python experiments/integrators/measure.py; }

paper() {
  batch paper_figures
  draw results/paper_figures -- figure_5=paper_figure_5.svg figure_9_right=paper_figure_9_right.svg figure_10_stuck=paper_figure_10_stuck.svg \
    figure_10_iterations=paper_figure_10_iterations.svg figure_12_taken=paper_figure_12_taken.svg figure_13_crossings=paper_figure_13_crossings.svg \
    figure_13_waist=paper_figure_13_waist.svg figure_15=paper_figure_15.svg figure_15_traction=paper_figure_15_traction.svg figure_18=paper_figure_18.svg
}

wall_cube() {
  local runs=()
  for name in free_fall slides detaches stuck stuck_rough; do
    ./tack run "experiments/wall_cube/$name.yaml" -q -o "results/wall_cube/$name"
    runs+=("results/wall_cube/$name")
  done
  ./tack render "${runs[@]}" -q --view docs/pictures/wall_cube.yaml -o "$images/paper_figure_14.png"
}

solvers() {
  for name in pull slope two_blocks hard_steps; do compare "$name"; done
  draw results/compare_pull -- work_precision=pull_work_precision.svg
  draw results/compare_slope -- work_precision=slope_work_precision.svg
  draw results/compare_two_blocks -- work_precision=two_blocks_work_precision.svg
  draw results/compare_hard_steps -- work_precision=hard_steps_work_precision.svg performance_profile=hard_steps_performance_profile.svg
}

gallery() { docs/pictures/gallery.sh; }

report() {
  ./tack run experiments/debonding/pull.yaml -q -o results/pull
  ./tack report results/pull >/dev/null
  node docs/pictures/report.mjs build/release/report results/pull/report.html "$images/report.png"
}

groups=(pipeline phases pull laws distances strengths measured calibration integrators paper wall_cube solvers gallery report)
for group in "$@"; do
  [[ " ${groups[*]} " == *" $group "* ]] || { echo "$group: no such group; there are ${groups[*]}" >&2; exit 2; }
done
for group in "${@:-${groups[@]}}"; do "$group"; done
