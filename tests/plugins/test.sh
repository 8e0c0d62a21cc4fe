#!/usr/bin/env bash
# Installs tack into a scratch folder, follows docs/plugins.md there to the letter, and tests that wrong plugins are refused:
#   test.sh SOURCE BUILD SCRATCH
set -euo pipefail
source=$1 build=$2 scratch=$3
guide=$source/docs/plugins.md

rm -rf "$scratch"
mkdir -p "$scratch/home" "$scratch/guide/mine"
export HOME=$scratch/home PATH=$scratch/home/tack-1.0/bin:$PATH
# Plugins are built by the compiler of the program.
CXX=$(sed -n 's/^CMAKE_CXX_COMPILER:[A-Z]*=//p' "$build/CMakeCache.txt")
export CXX
cd "$scratch/guide"

fail() {
  echo "FAIL: $*" >&2
  exit 1
}

# block TEXT [PAGE]: prints the first fenced block after the line of the guide, or of the page, that begins with or contains TEXT.
block() {
  awk -v text="$1" 'index($0, text) { found = 1 } found && /^```/ { if (inside) exit; inside = 1; next } inside' "${2:-$guide}"
}

# The program exports its own functions alone, not Eigen's templates, with which gmsh is built too.
if nm -DC --defined-only "$build/bin/tack" | grep -E '^[0-9a-f]+ . ((vtable|typeinfo|typeinfo name) for )?Eigen::'; then fail "exported"; fi

# The guide, with the present build.
cmake --build "$build" --target tack_library >/dev/null
install=$(block '## Install tack' | grep '^cmake --install')
bash -euc "${install/build\/release/\"$build\"}" >/dev/null
for file in bin/tack bin/tack_studies lib/tack/libtack_{meshing,msh,further}.so lib/libtack.so lib/cmake/tack/tackConfig.cmake include/tack/framework/plugin/headers_digest.hpp \
  share/tack/README.md share/tack/docs/reference/README.md share/tack/experiments/debonding/pull.yaml share/bash-completion/completions/tack share/zsh/site-functions/_tack \
  share/fish/vendor_completions.d/tack.fish share/man/man1/tack.1; do
  [[ -s $HOME/tack-1.0/$file ]] || fail "not installed: $file"
done
cmp -s <(tack completion bash) "$HOME/tack-1.0/share/bash-completion/completions/tack" || fail "the completion that is installed is another program's"

# The launcher of packages starts the best program for the processor, or the requested one.
mkdir -p "$scratch/package/bin" "$scratch/package/libexec/tack/"{x86-64,x86-64-v3}/bin
c++ -std=c++20 -Wall "$source/packaging/launcher.cpp" -o "$scratch/package/bin/tack"
launcher() { TACK_ARCHITECTURE=$1 "$scratch/package/bin/tack" "${@:2}" 2>&1; }
! launcher '' >/dev/null || fail "a package without programs"
for name in x86-64 x86-64-v3; do
  printf '#!/bin/sh\necho %s "$@"\n' "$name" >"$scratch/package/libexec/tack/$name/bin/tack"
  chmod +x "$scratch/package/libexec/tack/$name/bin/tack"
done
best=x86-64
[[ $(grep -cwE -m 1 'avx2.* bmi2|bmi2.* avx2' /proc/cpuinfo) == 0 ]] || best=x86-64-v3
[[ $(launcher '' run 'a b') == "$best run a b" ]] || fail "the launcher started $(launcher '')"
[[ $(launcher x86-64 run) == "x86-64 run" ]] || fail "the launcher started $(launcher x86-64)"
[[ $(launcher x86-64-v9 || true) == *"there is no 'x86-64-v9'; installed are: x86-64-v3, x86-64" ]] || fail "an architecture that is none: $(launcher x86-64-v9 || true)"

for file in CMakeLists.txt parabolic.cpp barzilai_borwein.cpp extreme.cpp pull.yaml solvers.yaml; do
  block "\`mine/$file\`" >"mine/$file"
  [[ -s mine/$file ]] || fail "docs/plugins.md does not have mine/$file"
done
bash -euc "$(block '## Build it, check it, run it')" >out.txt 2>&1 || { cat out.txt; fail "the commands of docs/plugins.md"; }
for line in 'strength: pressure (Pa), positive' 'pull.yaml is OK' 'pass  as low as the gap' 'Barzilai-Borwein at'; do
  grep -qF "$line" out.txt || { cat out.txt; fail "no '$line'"; }
done
! grep -E 'FAIL|WRONG' out.txt || fail "what tack says of the plugin"
cd mine
curve=$(block 'The curve is in' | grep '^gnuplot')
if command -v gnuplot >/dev/null; then bash -euc "$curve" && [[ -s pull.png ]] || fail "no curve"; fi
paste -d , <(cut -d , -f 2 results/pull/probes.csv) <(cut -d , -f 2 results/barzilai_borwein/probes.csv) |
  awk -F , 'NR > 1 && ($1 - $2)^2 > 1e-4 { exit 1 }' || fail "the minimisers do not agree"
grep -q '"path": ".*/mine/build/libmine.so"' results/pull/summary.json || fail "no plugin under provenance"

# Files that runs write work in any folder.
mkdir "$scratch/elsewhere"
cd "$scratch/elsewhere"
tack run "$scratch/guide/mine/results/pull/scene.yaml" -q -o again --steps 3 --dump-problem step=2
printf 'name: stored\nproblems: [again/problems/pull.step2.problem]\nrepeat: 1\ntolerances: [0.1 mm/s]\nsolvers: [{name: a, solver: projected_newton}]\n' >stored.yaml
tack compare stored.yaml -q

# --plugin adds a library to those of the scene, and the scene that the run keeps names it.
sed '/^plugins:/d' "$scratch/guide/mine/pull.yaml" >plain.yaml
! tack run plain.yaml -q -o plain || fail "an adhesion that nobody named"
tack run plain.yaml -q -o plain --steps 2 --plugin "$scratch/guide/mine/build/libmine.so" || fail "run --plugin"
grep -q 'mine/build/libmine.so' plain/scene.yaml || fail "the kept scene does not name the plugin"
tack check plain.yaml --plugin "$scratch/guide/mine/build/libmine.so" >/dev/null || fail "check --plugin"
sed '/^plugins:/d' "$scratch/guide/mine/solvers.yaml" | sed "s|base: pull.yaml|base: $PWD/plain.yaml|" >compared.yaml
tack compare compared.yaml -q -o compared --set steps=1 --plugin "$scratch/guide/mine/build/libmine.so" || fail "compare --plugin"
tack list --plugin "$scratch/guide/mine/build/libmine.so" --schema schema.json
grep -q '"adhesion.parabolic"' schema.json || fail "the schema does not know the plugin"
! tack list adhesion | grep parabolic || fail "a plugin that nobody named"

# refused LIBRARY PATTERN: tests that a plugin is refused with its source location.
cd "$scratch/elsewhere"
block '## A cohesive law with history variables' "$source/docs/extending.md" >fading.cpp
block '## Add an interaction' "$source/docs/extending.md" >tether.cpp
block '## Ask for unknowns' "$source/docs/extending.md" >moisture.cpp
block '## Add a contact model' "$source/docs/extending.md" >penalty.cpp
block '## Add a time integrator' "$source/docs/extending.md" >sdirk3.cpp
cmake -S "$source/tests/plugins" -B build -G Ninja -DMINE="$scratch/guide/mine" -DFADING="$PWD/fading.cpp" -DTETHER="$PWD/tether.cpp" -DMOISTURE="$PWD/moisture.cpp" -DPENALTY="$PWD/penalty.cpp" -DSDIRK3="$PWD/sdirk3.cpp" -DCMAKE_PREFIX_PATH="$HOME/tack-1.0" >/dev/null
cmake --build build >/dev/null
scene=$scratch/elsewhere/scene.yaml
refused() {
  sed "s|\[build/libmine.so\]|[$1]|" "$scratch/guide/mine/pull.yaml" >"$scene"
  local code=0 message
  message=$(tack run "$scene" -q 2>&1) || code=$?
  ((code == 2)) || fail "$1: exit code $code: $message"
  [[ $message == "error: $scene:4:11: plugins: "* ]] || fail "$1: no place: $message"
  grep -qE "$2" <<<"$message" || fail "$1: $message"
  [[ ! -e results/pull ]] || fail "$1: results of what was refused"
}
cp "$scratch/guide/mine/build/libmine.so" other_headers.so
sed -i -E 's/headers [0-9a-f]{16}/headers 0000000000000000/' other_headers.so
cp other_headers.so other_version.so
sed -i -E 's/tack 1\.0\.0/tack 9.0.0/' other_version.so
head -c 2000 other_version.so >cut.so
echo "no library" >text.so
refused missing.so "there is no library '$scratch/elsewhere/missing.so'; build the plugin, or correct the path"
refused text.so "is no shared library, or a damaged one"
refused cut.so "is no shared library, or a damaged one"
refused "$HOME/tack-1.0/lib/tack/libtack_meshing.so" "is no plugin of tack; link it with .* tack::plugin"
refused other_headers.so "another tack: it was built for headers 0000000000000000, this program is headers [0-9a-f]{16}; build it anew"
refused other_version.so "another tack: it was built for tack 9\.0\.0, this program is tack 1\.0\.0; build it anew"
refused build/libchecked.so "another tack: it was built for _GLIBCXX_DEBUG 1, this program is _GLIBCXX_DEBUG 0"
refused build/libnothing.so "registers no component; write TACK_REGISTER"
refused build/libtaken.so "probe 'gap' is registered in framework/probes/positions.cpp and again in .*taken.cpp; choose another name"
refused build/libunresolved.so "cannot load the plugin: .*undefined symbol: tack::no_such_function\(int\); it must be linked with what it calls"
refused build/liblanes.so "undefined symbol: tack::no_such_function\(tack::packs_of_3::Pack\*\); .* link tack::native as well"
refused "nothing.so, $scratch/elsewhere/text.so" "there is no library .*nothing.so"

# An embedding program: a crate falls by implicit Euler's g h^2 n (n + 1) / 2.
mkdir own
block '`own/CMakeLists.txt`' >own/CMakeLists.txt
block '`own/own.cpp`' >own/own.cpp
cmake -S own -B own/build -G Ninja -DCMAKE_PREFIX_PATH="$HOME/tack-1.0" >/dev/null
cmake --build own/build >/dev/null
cat >falling.yaml <<'END'
name: falling
time: {step: 10 ms, duration: 0.1 s}
gravity: [0, -10, 0]
objects: [{name: crate, shape: {type: box, size: [0.1, 0.1, 0.1]}, energies: [{type: neo_hookean, young: 1e5, poisson: 0.3, density: 1000}]}]
END
own/build/own falling.yaml | tail -1 | grep -qx '0.100 s: [0-9]* iterations, 0.052500 m' || { own/build/own falling.yaml; fail "a program of one's own"; }

# A plugin in Python, if the Python package is built.
package=$build/python
for python in python3 /usr/bin/python3; do
  if [[ -e $package/tack/lib/libtack.so && -e $package/tack/__init__.py ]] && "$python" -c 'import numpy' 2>/dev/null; then
    (cd "$scratch/guide/mine" && PYTHONPATH=$package "$python" -c 'import tack; s = tack.Simulation("pull.yaml"); s.step(); print("stepped", s.steps)') | grep -qx 'stepped 1' ||
      fail "a plugin in Python"
    break
  fi
done

# A bond law.
sed "s|\[build/libmine.so\]|[$scratch/guide/mine/build/libmine.so, build/libfading.so]|; s|{type: parabolic[^}]*}|{type: fading}|" "$scratch/guide/mine/pull.yaml" >"$scene"
tack run "$scene" -q -o fading --steps 3 && grep -q '"type": "fading"\|type: fading' fading/scene.yaml || fail "a law of bonds from outside"

# Interactions: a crate on a rope that a fixed bar reels in, soaked from above.
cat >hoist.yaml <<'END'
name: hoist
plugins: [build/libtether.so, build/libmoisture.so]
time: {step: 20 ms, duration: 0.4 s}
objects:
  - {name: bar, shape: {type: box, size: [0.1, 0.1, 0.1]}, place: {translate: [0, 1, 0]}, motion: [fixed]}
  - {name: crate, shape: {type: box, size: [0.1, 0.1, 0.1]}, energies: [{type: neo_hookean, young: 1e5, poisson: 0.3, density: 1000}]}
interactions:
  - {type: tether, from: bar, start: [0, 0.95, 0], to: crate, end: [0, 0.05, 0], stiffness: 100 N/m, reel: [[0 s, 1], [0.2 s, 0.8]]}
  - {type: moisture, object: crate, modulus: 1e4, swelling: 0.1, diffusivity: 1e-3, capacity: 1e3, wet: {type: face, direction: [0, 1, 0]}, level: 1}
probes: [{name: height, type: centre_of_mass, object: crate, direction: [0, 1, 0]}]
expect: [{name: it is lifted, probe: height, statistic: max, at_least: 5 mm}]
END
tack check hoist.yaml >check.txt || { cat check.txt; fail "interactions from outside"; }
grep -q ropes check.txt && grep -q swelling check.txt || { cat check.txt; fail "the terms of interactions from outside"; }
tack run hoist.yaml -q -o hoist || fail "a run with interactions from outside"

# The scene of the contact model in docs/extending.md: a crate falls on a floor and rests where the penalty carries its weight.
block 'A scene that shows it' "$source/docs/extending.md" >resting.yaml
echo "plugins: [build/libpenalty.so]" >>resting.yaml
tack run resting.yaml -q -o resting || fail "a contact model from outside"

# Integrators of several stages: a bar vibrates, with an error that falls by 2^order where steps are halved, and a block rebounds without gaining energy.
cat >bar.yaml <<'END'
name: bar
plugins: [build/libsdirk3.so, build/librho_bathe.so]
time: {step: 1 ms, duration: 20 ms}
solver: {type: projected_newton, tolerance: 1e-10, force_tolerance: 1e-10}
objects:
  - {name: bar, shape: {type: box, size: [0.1, 0.1, 0.1]}, energies: [{type: neo_hookean, young: 2e4}], velocity: [1 mm/s, 0, 0],
     motion: [{type: fixed, select: {type: face, direction: [0, -1, 0]}}]}
probes: [{name: position, type: centre_of_mass, object: bar, direction: [1, 0, 0]}]
output: {frames: false}
END
for name in sdirk3:3 rho_bathe:2; do
  for step in 0.4 0.2 0.1; do
    tack run bar.yaml -q -o "bar_$step" --set "time.integrator=${name%:*}" "time.step=$step ms" || fail "a bar with ${name%:*}"
    tail -1 "bar_$step/probes.csv" | cut -d , -f 2
  done | awk -v expected="${name#*:}" '{ x[NR] = $1 } END { order = log((x[1] - x[2]) / (x[2] - x[3])) / log(2); print order; exit !((order - expected)^2 < 0.04) }' >order.txt ||
    fail "the order of ${name%:*} is $(cat order.txt)"
done
tack run "$source/experiments/integrators/impact.yaml" -q -o rebound --set "plugins=[build/librho_bathe.so]" "time.integrator={type: rho_bathe, rho_inf: 0.3}" || fail "an impact with an integrator from outside"

# A plugin without optimisation, with assertions; a plugin named twice.
sed "s|\[build/libmine.so\]|[build/libunoptimised.so, $scratch/elsewhere/build/../build/libunoptimised.so]|" "$scratch/guide/mine/pull.yaml" >"$scene"
tack run "$scene" -q || fail "a plugin without optimisation"

# A run resumes with its plugin, and with no other plugin.
run=(tack run "$scene" -q -o resumed --set output.checkpoint_interval=0.01)
cp build/libunoptimised.so changing.so
sed -i "s|\[build/libunoptimised.so, [^]]*\]|[changing.so]|" "$scene"
"${run[@]}" --steps 12 || fail "a run with checkpoints"
"${run[@]}" --steps 20 --resume || fail "a run goes on with its plugin"
echo >>changing.so
code=0
message=$("${run[@]}" --resume 2>&1) || code=$?
((code == 2)) && grep -q "plugin '$scratch/elsewhere/changing.so' was rebuilt since then" <<<"$message" || fail "a rebuilt plugin: $code: $message"
rm -rf "$scratch"
