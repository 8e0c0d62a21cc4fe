#!/usr/bin/env bash
# Makes a wheel, installs it into an environment of its own, and runs what docs/tutorial.md says; as root, and where debootstrap is, in a Debian 12 that has Python and
# NumPy, but none of the libraries that tack needs:
#   wheel.sh SOURCE SCRATCH
# The builds stay in SOURCE/build/package. Exits with 77 where wheels cannot be made. TACK_WHEEL_ARCHITECTURES="x86-64": fewer instruction sets, sooner.
# TACK_WHEEL=FILE: tries a wheel that is there.
set -euo pipefail
source=$1 scratch=$2/wheel_test python=/usr/bin/python3

fail() {
  echo "FAIL: $*" >&2
  exit 1
}
for tool in patchelf readelf dpkg-query; do command -v "$tool" >/dev/null || { echo "skipped: there is no $tool"; exit 77; }; done
"$python" -c 'import ensurepip, numpy, setuptools, wheel' 2>/dev/null || { echo "skipped: $python lacks venv, NumPy, setuptools or wheel (./tack test nightly installs them)"; exit 77; }

rm -rf "$scratch" && mkdir -p "$scratch/work"
read -ra architectures <<<"${TACK_WHEEL_ARCHITECTURES:-x86-64 x86-64-v3 x86-64-v4}"
wheel=${TACK_WHEEL-}
if [[ ! $wheel ]]; then
  "$source/packaging/wheel.sh" "${architectures[@]}" >"$scratch/wheel.log" 2>&1 || { tail -30 "$scratch/wheel.log"; fail "packaging/wheel.sh"; }
  wheel=$(ls "$source"/build/package/wheel/tack-*manylinux_2_*_x86_64.whl)
fi

# What it contains: each library with a licence, and no path of the machine that it was built on.
"$python" -m zipfile -e "$wheel" "$scratch/content"
for a in "${architectures[@]}"; do
  [[ -s $scratch/content/tack/lib/$a/libtack.so && -s $scratch/content/tack/bin/$a/tack ]] || fail "the wheel does not have $a"
done
[[ -e $scratch/content/tack/py.typed ]] || fail "the wheel does not have py.typed, without which type checkers ignore its types"
listed=$(ls "$scratch"/content/tack-*.dist-info/licenses/BUNDLED.txt)
[[ $(find "$scratch/content/tack.libs" -name '*.so*' | wc -l) -gt 40 ]] || fail "few libraries in tack.libs"
for package in libtbb12 libvtk9.1 libgmsh4.8 libcholmod3 libopenblas0-pthread libcgal-dev; do
  [[ -s ${listed%/*}/$package.txt ]] && grep -q "^$package " "$listed" || fail "no licence of $package"
done
[[ -s ${listed%/*}/common-licenses-GPL-3.txt ]] || fail "no text of the GPL 3"
find "$scratch/content/tack" -name '*.so' -o -path '*/bin/*/tack' | while read -r file; do
  path=$(patchelf --print-rpath "$file")
  [[ $path == '$ORIGIN'* && $path != *:/* ]] || fail "$file looks for libraries in $path"
done
find "$scratch/content/tack.libs" -name '*.so*' | while read -r file; do
  [[ ! $(patchelf --print-rpath "$file") && $(patchelf --print-soname "$file") == "${file##*/}" ]] || fail "$file has a path, or another name"
done
rm -rf "$scratch/content"

# used PREFIX: the commands of the tutorial, those of docs/python.md, a mesh by CGAL, one by Gmsh. gnuplot and node are absent in the bare Debian, which is said.
cat >"$scratch/use.sh" <<'END'
set -euo pipefail
env=$1 bare=$2
export PATH=$env/bin:$PATH
package=$(echo "$env"/lib/python3*/site-packages/tack)
share=$package/share/tack
for file in "$package"/bin/*/tack "$package"/lib/*/libtack.so "$package"/lib/tack/*.so; do
  ldd "$file" >libraries.txt
  ! grep 'not found' libraries.txt || { echo "$file"; exit 1; }
  # All but glibc and the run-time libraries of GCC are those of the wheel.
  ! grep '=> /' libraries.txt | grep -v -e "=> $env" -e "=> /lib/x86_64-linux-gnu/lib\(c\|m\|dl\|rt\|pthread\|util\|resolv\|stdc++\|gcc_s\)\.so" || { echo "$file"; exit 1; }
done

tack --version
cp "$share"/experiments/tutorial/*.yaml .
sed -n 's,^\./tack ,,p' "$share/docs/tutorial.md" | while read -r line; do
  read -ra words < <(sed 's/ *#.*//' <<<"$line")
  echo "tack ${words[*]}"
  if [[ ${words[0]} == plot ]] && ! command -v gnuplot >/dev/null; then
    code=0; tack "${words[@]}" >plot.txt 2>&1 || code=$?
    [[ $code -eq 1 ]] && grep -q 'no pictures, as gnuplot is missing' plot.txt || { cat plot.txt; exit 1; }
  elif [[ ${words[0]} == report && ! -e $share/report.html ]]; then
    ! tack "${words[@]}" 2>report.txt || { echo "a report without a page"; exit 1; }
    grep -q 'the page of reports is not built' report.txt || { cat report.txt; exit 1; }
  else
    tack "${words[@]}" >/dev/null
  fi
done
grep -q '"status": "done"' results/stamp/summary.json
[[ $(wc -l <results/stamps/results.csv) -eq 16 ]]
[[ -s results/stamp_solvers/compare.md ]]

if [[ $bare == bare ]]; then
  ! tack render results/stamp -o stamp.png 2>render.txt || { echo "rendered without node"; exit 1; }
  grep -q -e nodejs -e 'page of reports' render.txt || { cat render.txt; exit 1; }
fi
tack mesh sdf "$share/experiments/meshing/turned.yaml" --object ring -o ring.msh
tack mesh tetrahedralize ring.msh -o ring.vtu edge_length=2mm
tack new probe-tack -o probe_tack.yaml
tack check probe_tack.yaml >/dev/null
tack list cohesive zone | grep -q docs/theory/bonds.md
tack export results/stamp --to obj -o stamp_obj >/dev/null
[[ -n $(find stamp_obj -name '*.obj') ]]
tack calibrate "$share/experiments/calibration/pull_fit.yaml" -o fit >/dev/null
[[ -s fit/calibration.json ]]
code=0; tack run nothing.yaml 2>error.txt || code=$?
[[ $code -eq 2 ]] && grep -q nothing.yaml error.txt
code=0; TACK_ARCHITECTURE=x86-64-v9 tack --version 2>error.txt || code=$?
[[ $code -eq 2 ]] && grep -q "there is no 'x86-64-v9'; installed are: .*x86-64" error.txt
for a in "$package"/bin/*; do
  a=${a##*/}
  if TACK_ARCHITECTURE=$a tack --version >version.txt 2>&1; then grep -q -e "-march=$a " version.txt; else grep -q "this processor is no $a" version.txt; fi
done
"$env/bin/python" -m tack --version | grep -q '^tack '
END
cat >"$scratch/use.py" <<'END'
import numpy as np

import tack

sim = tack.Simulation("stamp.yaml")
sim.run(until=0.05)
recorded = tack.read("results/stamp")
at = np.argmin(np.abs(recorded.probes["time"] - sim.time))
assert sim.probes()["force"] == recorded.probes["force"][at], "the command and Python have other bits"
assert np.isfinite(sim.forces()["contact"]).all()
again = tack.run("stamp.yaml", set={"time.duration": "20 ms", "expect": []}, output="results/short")
assert again.summary["status"] == "done"
cases = tack.batch("stamps.yaml", only=["strength=5kPa*young=1MPa*"], output="results/one")
assert "done" in list(cases.table["status"])
END

# installed PYTHON ENV: an environment with NumPy as the only package from outside, where nothing can be fetched.
cat >"$scratch/install.sh" <<'END'
set -euo pipefail
python=$1 env=$2 wheel=$3
"$python" -m venv --system-site-packages "$env"
"$env/bin/pip" install --quiet --no-index --disable-pip-version-check "$wheel"
END
bash "$scratch/install.sh" "$python" "$scratch/env" "$wheel" >"$scratch/install.log" 2>&1 || { cat "$scratch/install.log"; fail "pip install"; }
echo "$(basename "$wheel"): $(du -BM --apparent-size "$wheel" | cut -f1), installed $(du -shBM --apparent-size "$scratch"/env/lib/python3*/site-packages/tack "$scratch"/env/lib/python3*/site-packages/tack.libs | cut -f1 | tr '\n' ' ')"

if ((EUID == 0)) && command -v debootstrap >/dev/null; then
  bare=$scratch/bare
  debootstrap --variant=minbase --include=python3-venv,python3-numpy bookworm "$bare" "${DEBIAN_MIRROR:-http://deb.debian.org/debian}" >"$scratch/debootstrap.log" 2>&1 || { tail -3 "$scratch/debootstrap.log"; fail "debootstrap"; }
  ! ls "$bare"/usr/lib/x86_64-linux-gnu | grep -E 'libtbb|libcholmod|libvtk|libgmsh|libopenblas|libfmt|libyaml-cpp|libX11' || fail "the bare Debian has libraries that tack needs"
  mount -t proc proc "$bare/proc"
  trap 'umount "$bare/proc"' EXIT
  mkdir "$bare/use"
  cp "$wheel" "$scratch"/{use.sh,use.py,install.sh} "$bare/use/"
  # Without a network.
  unshare --net chroot "$bare" bash -euc "cd /use; bash install.sh python3 /use/env /use/$(basename "$wheel"); bash use.sh /use/env bare; env/bin/python use.py" >"$scratch/use.log" 2>&1 || { tail -20 "$scratch/use.log"; fail "in a bare Debian"; }
  # The command needs no NumPy.
  chroot "$bare" bash -euc "cd /use; python3 -m venv alone; alone/bin/pip install --quiet --no-index --no-deps $(basename "$wheel"); alone/bin/tack check stamp.yaml" >"$scratch/alone.log" 2>&1 || { tail -20 "$scratch/alone.log"; fail "without NumPy"; }
  umount "$bare/proc"
  trap - EXIT
  rm -rf --one-file-system "$bare"
  echo "ran in a bare Debian 12"
else
  (cd "$scratch/work" && bash "$scratch/use.sh" "$scratch/env" here && "$scratch/env/bin/python" "$scratch/use.py") >"$scratch/use.log" 2>&1 || { tail -20 "$scratch/use.log"; fail "in an environment of this machine"; }
  echo "not root, or no debootstrap: ran in an environment of this machine"
fi
rm -rf "$scratch/work" "$scratch/env"
