#!/usr/bin/env bash
# Draws the traction of every registered law for docs/theory/adhesion_laws.md and bonds.md with `tack law`: docs/theory/images/laws.sh [TACK]
# All laws have a strength of 10 kPa and, where it is a parameter, a work of adhesion of 10 J/m^2.
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")"
tack=$(readlink -f "${1:-../../../build/release/bin/tack}")
scratch=$(mktemp -d)
trap 'rm -r "$scratch"' EXIT

# law NAME PICTURE... -- [ARGUMENTS of tack law]: pictures of a law as law_NAME[_PICTURE].svg; `traction` has no suffix.
law() {
  local name=$1 pictures=()
  shift
  while [[ $1 != -- ]]; do pictures+=("$1"); shift; done
  shift
  "$tack" law "$@" -o "$scratch/$name" >/dev/null
  for picture in "${pictures[@]}"; do
    if [[ $picture == traction ]]; then cp "$scratch/$name/traction.svg" "law_$name.svg"
    else cp "$scratch/$name/$picture.svg" "law_${name}_$picture.svg"; fi
  done
}

both=(peak_traction=10kPa work_of_adhesion=10J/m^2)
mixed=(tangential_strength=20kPa mixed_mode=benzeggagh_kenane tangential_work=30J/m^2)
printf 'gap [mm], traction [kPa]\n0, 0\n0.2, 6\n0.5, 10\n1, 9\n1.5, 3\n2, 0\n' > "$scratch/measured.csv"
printf 'type: damage\nenvelope: {type: table, file: measured.csv}\n' > "$scratch/damage.yaml"

law fang traction energy -- --type fang "${both[@]}"
law fang_squared traction -- --type fang form=squared peak_traction=10kPa peak_distance=1mm
law xu_needleman traction -- --type xu_needleman "${both[@]}"
law lennard_jones traction -- --type lennard_jones "${both[@]}"
law dugdale traction -- --type dugdale "${both[@]}"
law table traction -- --type table file="$scratch/measured.csv"
law expression traction -- --type expression 'traction=s * sin(3.14159265 * d / l)' 'parameters={s: 10 kPa, l: 2 mm}' range=2mm
law xu_needleman_coupled traction -- --type xu_needleman_coupled "${both[@]}"
law bilinear traction unloading -- --type bilinear "${both[@]}" "${mixed[@]}"
law exponential traction unloading -- --type exponential "${both[@]}"
law bonded traction -- --type bonded peak_traction=10kPa tangential_strength=20kPa
law damage traction unloading -- "$scratch/damage.yaml"
law rcc traction unloading rate healing -- --type rcc normal_stiffness=1e7 tangential_stiffness=5e6 work_of_adhesion=10J/m^2 viscosity=0.1 healing=1e-4 saturation=10kPa
law rcc_explicit traction -- --type rcc_explicit normal_stiffness=1e7 tangential_stiffness=5e6 work_of_adhesion=10J/m^2 viscosity=0.1
law viscoelastic traction unloading rate work_over_speed -- --type viscoelastic "${both[@]}" onset=1mm branch_stiffness=3e7 relaxation_time=0.1s
./thin_svg.py law_*.svg
