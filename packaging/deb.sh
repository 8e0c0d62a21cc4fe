#!/usr/bin/env bash
# Makes the Debian packages build/package/tack_VERSION_amd64.deb and python3-tack_VERSION_amd64.deb: packaging/deb.sh [ARCHITECTURE...]. Needs what `./tack python` has
# installed to build with, and Debian's dpkg-dev.
# Each architecture is a build of the program for itself, some minutes on all cores; they stay in build/package, so that the next package takes what has changed only.
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.."
architectures=("$@")
((${#architectures[@]})) || architectures=(x86-64 x86-64-v3 x86-64-v4)
root=$PWD/build/package jobs=${TACK_JOBS:-$(nproc)}
first=$root/${architectures[0]}
mkdir -p "$root"

for a in "${architectures[@]}"; do
  others=()
  if [[ $a == "${architectures[0]}" ]]; then
    for b in "${architectures[@]:1}"; do others+=("$root/$b"); done
  fi
  python=()
  [[ $a != "${architectures[0]}" ]] || python=(-DTACK_PYTHON=ON -DPython3_EXECUTABLE=/usr/bin/python3)
  cmake -S . -B "$root/$a" -G Ninja -DCMAKE_BUILD_TYPE=Release "-DTACK_ARCHITECTURE=$a" -DTACK_TESTS=OFF -DTACK_BENCH=OFF "${python[@]}" \
    "-DTACK_PACKAGED=$(IFS=';'; echo "${others[*]}")" >"$root/$a.log" || { cat "$root/$a.log"; exit 2; }
  targets=(tack_cli tack_studies tack_further tack_library)
  [[ $a != "${architectures[0]}" ]] || targets+=(tack_meshing tack_msh tack_hdf5 tack_launcher tack_python)
  cmake --build "$root/$a" -j "$jobs" --target "${targets[@]}"
done
# The page of reports needs npm and a network; without it the package has none, and says so when one is asked for.
cmake --build "$first" --target tack_report || echo "packaging: without the page of reports" >&2
(cd "$root" && cpack --config "$first/CPackConfig.cmake")
packaging/python_deb.sh "$root" "${architectures[@]}"
