#!/usr/bin/env bash
# tidy.sh ROOT [REGEX]: clang-tidy, with the checks of .clang-tidy, of the whole tree, or of the files whose path below ROOT matches. Configures build/tidy and
# compiles nothing; the whole tree is read folder by folder, as it is compiled. Skipped without clang-tidy.
set -euo pipefail
root=$(realpath "$1") regex=${2-}
for tool in clang++ clang-tidy ninja; do command -v "$tool" >/dev/null || { echo "skipped: there is no $tool: ./tack test nightly installs it"; exit 77; }; done
cd "$root"
unity=ON
[[ -z $regex ]] || unity=OFF
mkdir -p build
cmake --preset clang -B build/tidy -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON -DTACK_TESTS=OFF -DTACK_BENCH=OFF "-DTACK_UNITY=$unity" >build/tidy.log || { cat build/tidy.log; exit 1; }
cmake --build build/tidy --target tack_build_info >build/tidy.log  # generated headers
sed -n 's|^  "file": "\(.*\)".*|\1|p' build/tidy/compile_commands.json | sort -u | grep -v '/precompiled\.cpp$' | grep -F "$root/" | grep -E -e "${regex:-.}" >build/tidy.files || { echo "no file matches $regex"; exit 1; }
echo "$(wc -l <build/tidy.files) files"
xargs -a build/tidy.files -d '\n' -n 2 -P "${TACK_JOBS:-$(nproc)}" nice clang-tidy --quiet -p build/tidy 2>/dev/null
