#!/usr/bin/env bash
# Makes a wheel that has the Python package, the program and all libraries that they need, build/package/wheel/tack-VERSION-*-manylinux_*.whl:
# packaging/wheel.sh [ARCHITECTURE...]. Needs what `./tack python` has installed, and Debian's patchelf. It is for the Python that PYTHON names (/usr/bin/python3).
# Builds stay in build/package, where packaging/deb.sh has the same.
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.."
architectures=("$@")
((${#architectures[@]})) || architectures=(x86-64 x86-64-v3 x86-64-v4)
root=$PWD/build/package jobs=${TACK_JOBS:-$(nproc)} python=${PYTHON:-/usr/bin/python3}
first=$root/${architectures[0]}
command -v patchelf >/dev/null || { echo "packaging: patchelf is missing (Debian: patchelf)" >&2; exit 2; }
mkdir -p "$root"

for a in "${architectures[@]}"; do
  targets=(tack_library tack_packaged) options=()
  if [[ $a == "${architectures[0]}" ]]; then
    options=(-DTACK_PYTHON=ON "-DPython3_EXECUTABLE=$python")
    # The page of reports needs npm and a network; without it the package has none, and says so when one is asked for.
    targets+=(tack_python)
  fi
  cmake -S . -B "$root/$a" -G Ninja -DCMAKE_BUILD_TYPE=Release "-DTACK_ARCHITECTURE=$a" -DTACK_TESTS=OFF -DTACK_BENCH=OFF "${options[@]}" >"$root/$a.log" || { cat "$root/$a.log"; exit 2; }
  cmake --build "$root/$a" -j "$jobs" --target "${targets[@]}"
done
cmake --build "$first" --target tack_report || echo "packaging: without the page of reports" >&2
cmake --build "$first" --target tack_wheel_stage

# Each instruction set has a folder, of which tack_program.py chooses one.
stage=$first/python/stage
for a in "${architectures[@]}"; do
  mkdir -p "$stage/tack/bin/$a" "$stage/tack/lib/$a"
  cp "$root/$a/python/tack/bin/tack" "$stage/tack/bin/$a/"
  cp "$root/$a/python/tack/lib/libtack.so" "$stage/tack/lib/$a/"
done
rm "$stage/tack/bin/tack" "$stage/tack/lib/libtack.so"
cp -r /usr/share/xml/udunits "$stage/tack/share/tack/"  # the database of units, which libudunits2 reads
version=$(sed -n 's/^CMAKE_PROJECT_VERSION:STATIC=//p' "$first/CMakeCache.txt")
rm -rf "$root/wheel" "$root/plain_wheel"
TACK_VERSION=$version "$python" -m pip wheel --quiet --no-deps --no-build-isolation --disable-pip-version-check --wheel-dir "$root/plain_wheel" "$stage"
"$python" packaging/bundle_libraries.py "$root"/plain_wheel/*.whl "$root/wheel"
