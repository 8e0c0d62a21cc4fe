#!/usr/bin/env bash
# Tests the examples of docs/clusters.md: workflows.sh snakemake|dask PROGRAM SOURCE_DIR PYTHON_DIR
# Each has to give the gaps that a batch of the same cases gives. Exits with 77 (skipped) where Snakemake, Dask or the
# Python package is missing.
set -euo pipefail

which=$1 program=$2 source=$3 python_dir=$4
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

cat >batch.yaml <<YAML
name: gaps
base: $source/experiments/first/hang.yaml
set: [output.frames=false]
vary: [{type: grid, keys: {objects.cube.energies.0.young: {values: [0.1 MPa, 0.2 MPa, 0.4 MPa], as: young}}}]
statistics:
  - {name: largest, probe: gap, statistic: max}
  - {name: final, probe: gap, statistic: final}
YAML
column() {  # prints a column of results.csv by its name, which may have a unit after it
  awk -F, -v name="$1" 'NR == 1 {for (i = 1; i <= NF; ++i) if ($i ~ "^" name) c = i} NR > 1 {print $c}' batch/results.csv
}

if [[ $which == snakemake ]]; then
  command -v snakemake >/dev/null || { echo "skipped: snakemake is not installed (Debian: snakemake)"; exit 77; }
  "$program" batch batch.yaml -o batch -q
  call=(snakemake --snakefile "$source/experiments/workflows/Snakefile" --cores 2 --config tack="$program")
  "${call[@]}" out=flow >flow.txt 2>&1 || { cat flow.txt; exit 1; }
  tail -n +2 flow/gaps.csv | tr -d '\r' | cut -d, -f2 >flow.gaps
  column largest >batch.gaps
  [[ $(wc -l <flow.gaps) == 3 ]]
  paste flow.gaps batch.gaps | awk '{d = $1 - $2; if (d < 0) d = -d; if (d > 1e-6 * $2) exit 1}'
  # Called again, nothing runs; a scene that changed runs again.
  cp "$source/experiments/first/hang.yaml" scene.yaml
  touch -d yesterday scene.yaml
  "${call[@]}" out=flow scene="$work/scene.yaml" >first.txt 2>&1
  "${call[@]}" out=flow scene="$work/scene.yaml" >nothing.txt 2>&1
  grep -q "Nothing to be done" nothing.txt
  echo "# changed" >>scene.yaml
  "${call[@]}" out=flow scene="$work/scene.yaml" >again.txt 2>&1
  grep -q "^run  *3" again.txt
  # A failed expectation stops the workflow.
  sed 's/at_most: 1e-3/at_most: 1e-6/' "$source/experiments/first/hang.yaml" >fails.yaml
  "${call[@]}" out=fails scene="$work/fails.yaml" >fails.txt 2>&1 && { echo "a failed expectation was not noticed"; exit 1; }
  [[ ! -e fails/gaps.csv ]]
else
  # The Python that the package was built for.
  python=${TACK_PYTHON:-/usr/bin/python3}
  PYTHONPATH=$python_dir "$python" -c "import dask.distributed, tack" 2>/dev/null ||
    { echo "skipped: dask.distributed (Debian: python3-distributed) or the package tack is missing"; exit 77; }
  "$program" batch batch.yaml -o batch -q
  PYTHONPATH=$python_dir "$python" "$source/experiments/workflows/dask_sweep.py" >dask.txt
  tail -n +2 dask.txt | cut -d, -f2 >dask.gaps
  column final >batch.gaps
  [[ $(wc -l <dask.gaps) == 3 ]]
  paste dask.gaps batch.gaps | awk '{d = $1 - 1e3 * $2; if (d < 0) d = -d; if (d > 1e-4) exit 1}'
fi
echo "$which: the gaps of a batch"
