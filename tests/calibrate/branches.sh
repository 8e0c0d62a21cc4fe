#!/usr/bin/env bash
# Success rate of `tack calibrate` on synthetic tack curves at three speeds: branches.sh PROGRAM SOURCE_DIR [SEEDS] [FOLDER]
# Fits three relaxing branches and the work of the bonds of experiments/calibration/tack.yaml to its own curves with 1% noise. The initial guesses are wrong by a factor of 2.5, in
# directions that differ from seed to seed. A fit is right if all four values are within 5%; 10 of 12 seeds must be right. All seeds share the points of their initial designs.
set -euo pipefail

program=$1 source=$2 seeds=${3:-12}
work=${4:-$(mktemp -d)}
mkdir -p "$work"
[[ -n ${4:-} ]] || trap 'rm -rf "$work"' EXIT
cd "$work"

speeds=(40 4 0.4)
for speed in "${speeds[@]}"; do
  # The expectations of the scene are those of 4 mm/s.
  "$program" run "$source/experiments/calibration/tack.yaml" -q --threads 1 --set "speed=$speed mm/s" -o "exact_$speed" >/dev/null 2>&1 || [[ $? == 1 ]]
done

right=0
for ((seed = 1; seed <= seeds; ++seed)); do
  for speed in "${speeds[@]}"; do
    awk -F, -v seed="$seed$speed" '
      NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i; print "travel,force"; next }
      { a[++n] = $column["travel"]; b[n] = $column["force"]; if (b[n] > most) most = b[n] }
      END { srand(10 * seed); for (i = 1; i <= n; ++i) printf "%.9g,%.9g\n", a[i], b[i] + 0.01 * most * sqrt(-2 * log(1 - rand())) * cos(6.283185307179586 * rand()) }
    ' "exact_$speed/probes.csv" >"tack_$speed.csv"
  done
  read -r g1 g2 g3 w < <(awk -v s=$seed 'BEGIN { split("60e3 30e3 15e3 4", truth, " "); for (k = 1; k <= 4; ++k) { f = int(s / 2 ^ (k - 1)) % 2 ? 2.5 : 0.4; printf "%g ", truth[k] * f } print "" }')
  cat >fit.yaml <<YAML
name: branches
experiments:
  - {name: fast, base: $source/experiments/calibration/tack.yaml, set: [speed=40 mm/s], data: tack_40.csv, x: travel, y: force, noise: 1%}
  - {name: medium, base: $source/experiments/calibration/tack.yaml, set: [speed=4 mm/s], data: tack_4.csv, x: travel, y: force, noise: 1%}
  - {name: slow, base: $source/experiments/calibration/tack.yaml, set: [speed=0.4 mm/s], data: tack_0.4.csv, x: travel, y: force, noise: 1%}
fit:
  g1: {from: 5 kPa, to: 500 kPa, start: $g1}
  g2: {from: 5 kPa, to: 500 kPa, start: $g2}
  g3: {from: 2 kPa, to: 200 kPa, start: $g3}
  work: {from: 1 J/m^2, to: 20 J/m^2, start: $w}
search: {design: 48, chains: 1}
YAML
  rm -f fit/calibration.csv  # of the seed before: a fit that fails has none
  if ! "$program" calibrate fit.yaml -q -o fit >fit.log 2>&1; then
    echo "seed $seed: the calibration failed"
    cat fit.log
    continue
  fi
  row=$(awk -F, '
    BEGIN { truth["g1"] = 60e3; truth["g2"] = 30e3; truth["g3"] = 15e3; truth["work"] = 4; right = "right:" }
    $1 in truth { off = $3 / truth[$1] - 1; text = text sprintf(" %s %+.2f%%", $1, 100 * off); if (off * off > 25e-4) right = "WRONG:"; ++n }
    END { if (n != 4) right = "WRONG:"; print right text }' fit/calibration.csv)
  echo "seed $seed, start $g1 $g2 $g3 $w: $row, $(($(wc -l <fit/evaluations.csv) - 1)) points"
  [[ $row != right* ]] || right=$((right + 1))
done
echo "right in $right of $seeds"
((12 * right >= 10 * seeds))
