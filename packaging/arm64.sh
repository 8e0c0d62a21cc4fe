#!/usr/bin/env bash
# Cross-compiles the program for arm64, all that a first build has (TACK_FIRST): build/arm64/bin/tack. Needs g++-aarch64-linux-gnu and mmdebstrap of Debian. The libraries of arm64 are
# unpacked into build/arm64_root, and nothing of this machine is changed. `packaging/arm64.sh run ARGS...` runs the program by emulation (Debian: qemu-user-static).
set -euo pipefail
source=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/..
cd "$source"
export TACK_SYSROOT=$PWD/build/arm64_root
libraries=$TACK_SYSROOT/usr/lib/aarch64-linux-gnu
packages=(libc6-dev libstdc++-12-dev libeigen3-dev libfmt-dev libtbb-dev libyaml-cpp-dev nlohmann-json3-dev libcli11-dev libudunits2-dev libmuparser-dev libsuitesparse-dev libmetis-dev
  libopenblas-pthread-dev libcgal-dev libboost-dev zlib1g-dev libvtk9.1)

if [[ ${1-} == run ]]; then
  cd "$OLDPWD"
  exec qemu-aarch64-static -L "$TACK_SYSROOT" -E LD_LIBRARY_PATH=/usr/lib/aarch64-linux-gnu "$source/build/arm64/bin/tack" "${@:2}"
fi
for tool in aarch64-linux-gnu-g++ mmdebstrap; do command -v "$tool" >/dev/null || { echo "packaging: $tool is missing (Debian: g++-aarch64-linux-gnu mmdebstrap)" >&2; exit 2; }; done
if [[ ! -e $TACK_SYSROOT/unpacked ]]; then
  rm -rf "$TACK_SYSROOT"
  mmdebstrap --quiet --architectures=arm64 --variant=extract --include="$(IFS=,; echo "${packages[*]}")" bookworm "$TACK_SYSROOT" "${DEBIAN_MIRROR:-http://deb.debian.org/debian}"
  # Packages are unpacked, not configured: links of alternatives are missing.
  for name in libopenblas.so libopenblas.so.0 libblas.so.3 liblapack.so.3; do ln -sf "openblas-pthread/$name" "$libraries/$name"; done
  touch "$TACK_SYSROOT/unpacked"
fi
# Headers of VTK are those of this machine: its development package has 360 dependencies.
vtk=$(ls -d /usr/include/vtk-9.1 build/vtk/usr/include/vtk-9.1 2>/dev/null | head -n 1)
cmake -S . -B build/arm64 -G Ninja -DCMAKE_TOOLCHAIN_FILE=packaging/arm64.cmake -DCMAKE_BUILD_TYPE=Release -DTACK_FIRST=ON -DTACK_NATIVE=OFF "-DVTK_INCLUDE=$(readlink -f "$vtk")"
cmake --build build/arm64 -j "${TACK_JOBS:-$(nproc)}" --target tack_cli
