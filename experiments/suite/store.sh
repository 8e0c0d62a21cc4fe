#!/usr/bin/env bash
# Stores the problems of this folder anew: of each scene below the step with most Newton iterations, with its minimum, and index.csv, which says which
# step of what that is. Run from the root of the repository (TACK: the program, unless ./tack): store.sh [NAME...], all or those named. Four minutes on
# one thread. Iterations depend on round-off: another machine may find another step of a scene the hardest.
set -euo pipefail
here=$(dirname "$(readlink -f "$0")")
tack=${TACK:-./tack}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
names=("$@")
index=$here/index.csv
header='problem,scene,steps,settings,step,time,unknowns,step_size,quasi_static,minimum_tolerance,iterations,program'
[[ -e $index ]] || echo "$header" >"$index"

# store NAME STEPS FILE [KEY=VALUE...]: the hardest of the first STEPS steps of a run, as NAME.problem
store() {
  local name=$1 steps=$2 file=$3 stored
  shift 3
  ((${#names[@]} == 0)) || [[ " ${names[*]} " == *" $name "* ]] || return 0
  "$tack" run "$file" -q --threads 1 --steps "$steps" -o "$scratch/$name" --dump-problem hardest=1 --set output.frames=false expect=[] "$@" >"$scratch/$name.txt" 2>&1 || true
  stored=$(echo "$scratch/$name"/problems/*.problem)
  [[ -e $stored ]] || { cat "$scratch/$name.txt"; echo "$name: nothing was stored" >&2; return 1; }
  mv "$stored" "$here/$name.problem"
  # Exit code 3: the scene's own solver fails.
  "$tack" solve "$here/$name.problem" --threads 1 --store-minimum --cpu-limit 300 --json "$scratch/$name.json" || true
  python3 - "$index" "$header" "$scratch/$name.json" "$scratch/$name/steps.csv" "$name" "$stored" "$file" "$steps" "$*" <<'PYTHON'
import csv, json, re, sys
index, header, solved, steps_csv, name, stored, scene, steps, settings = sys.argv[1:]
answer = json.load(open(solved))
step = int(re.search(r"\.step(\d+)\.problem$", stored).group(1))
before = [row for row in csv.DictReader(open(steps_csv)) if int(row["step"]) < step]
row = dict(zip(header.split(","), [name, scene, steps, settings, step, before[-1]["time"] if before else "0", answer["unknowns"], answer["step_size"], int(answer["quasi_static"]),
                                   answer["minimum_tolerance"], answer["solves"][0]["iterations"], answer["program"]]))
rows = {r["problem"]: r for r in csv.DictReader(open(index))}
rows[name] = row
with open(index, "w", newline="") as file:
    writer = csv.DictWriter(file, header.split(","), lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows[key] for key in sorted(rows))
PYTHON
}

# Few bodies
store spin 20 experiments/hard/spin_1000rpm.yaml
store squash_hencky 20 experiments/hard/squash_stvk_hencky.yaml
store squash_corotated 20 experiments/hard/squash_fixed_corotated.yaml
store twist_on_itself 20 experiments/hard/twist_on_itself.yaml
store spike_falls 30 experiments/hard/spike_falls.yaml
store spike_on_spike 30 experiments/hard/spike_on_spike.yaml
store edge_on_edge 30 experiments/hard/edge_on_edge.yaml
store friction_tumbles 30 experiments/hard/friction_10_tumbles.yaml
store narrow_sliding 20 experiments/hard/distance_1e-6_sliding.yaml
store small_hangs 20 experiments/hard/scene_1e-6_hangs.yaml
store adhesion_pulled 100 experiments/hard/adhesion_10E_pulled.yaml
store heavy_above 40 experiments/hard/mass_1e5_below.yaml
store fast_impact 20 experiments/hard/speed_1000.yaml
store fast_collision 20 experiments/hard/speed_1000_collision.yaml
store all_at_once 20 experiments/hard/all_at_once.yaml

# Debonding and tape
store peel 1000 experiments/debonding/peel.yaml
store tape 100 experiments/tape_desk/left.yaml 'objects.tape.shape.cells=[100, 6]'

# Sheets and rods
store twisted_cloth 120 experiments/twist/twisted_cloth.yaml 'objects.cloth.shape.cells=[24, 24]'
store cloth_on_ball 60 experiments/stack/cloth_on_sphere.yaml 'objects.cloth.shape.cells=[20, 20]' objects.ball.shape.cells=6
store rod_ring 200 experiments/rod/ring.yaml
store web_ball 120 experiments/spider_web/ball.yaml
store octopus 60 experiments/spider_web/octopus.yaml
store wringer 40 experiments/soft/wringer.yaml

# Solids
store mat 80 experiments/twist/mat.yaml 'objects.mat.shape.cells=[19, 1, 19]'
store six_blocks 65 experiments/squash/six_blocks.yaml
store mats 10 experiments/soft/mats.yaml 'objects.lower.shape.cells=[20, 1, 6]' 'objects.upper.shape.cells=[6, 1, 20]'
store throw 40 experiments/sticky_toys/throw.yaml objects.{star,bear,car,hand}.fill.count=1 'objects.door.shape.cells=[1, 6, 6]' 'objects.floor.shape.cells=[4, 1, 4]'

# Affine bodies
store affine_stack 60 experiments/affine/stack.yaml
store affine_arch 60 experiments/affine/arch_collapses.yaml
store grains 60 experiments/meatball/shaken.yaml objects.rice.fill.count=30
store sushi 100 experiments/sushi/roll.yaml objects.rice.fill.count=12 'objects.nori.shape.cells=[23, 13]'

# Quasi-static steps
store balloon 50 experiments/loads/balloon.yaml
store plastic_indent 100 experiments/plasticity/indent.yaml
