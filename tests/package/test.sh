#!/usr/bin/env bash
# Makes the Debian packages, unpacks them, and runs what is in them; as root, and where debootstrap is, also installs them in a clean Debian 12:
#   test.sh SOURCE SCRATCH
# The builds stay in SOURCE/build/package. Exits with 77 where packages cannot be made. TACK_DEB_ARCHITECTURES="x86-64": fewer instruction sets, sooner.
set -euo pipefail
source=$1 scratch=$2/package_test

fail() {
  echo "FAIL: $*" >&2
  exit 1
}
for tool in dpkg-deb dpkg-shlibdeps cpack; do command -v "$tool" >/dev/null || { echo "skipped: there is no $tool"; exit 77; }; done

rm -rf "$scratch" && mkdir -p "$scratch/work"
read -ra architectures <<<"${TACK_DEB_ARCHITECTURES:-x86-64 x86-64-v3 x86-64-v4}"
"$source/packaging/deb.sh" "${architectures[@]}" >"$scratch/deb.log" 2>&1 || { tail -30 "$scratch/deb.log"; fail "packaging/deb.sh"; }
package=$(ls "$source"/build/package/tack_*.deb)
dpkg-deb -I "$package" | grep -q 'Depends:.*libc6' || fail "no dependencies"
! dpkg-deb -I "$package" | grep -E 'Depends:.*(-dev|g\+\+|cmake)' || fail "it asks for a compiler"
python_package=$(ls "$source"/build/package/python3-tack_*.deb)
dpkg-deb -I "$python_package" | grep -q 'Depends: tack (= .*python3-numpy.*libtbb12' || fail "dependencies of python3-tack"
dpkg-deb -x "$package" "$scratch/root"
! compgen -G "$scratch/root/usr/lib/python3*" >/dev/null || fail "the package tack has the Python package as well"
dpkg-deb -x "$python_package" "$scratch/root"
for file in bin/tack lib/tack/libtack_meshing.so lib/tack/libtack_msh.so lib/tack/libtack_hdf5.so share/man/man1/tack.1 share/bash-completion/completions/tack share/tack/experiments/debonding/pull.yaml \
  share/doc/{tack,python3-tack}/copyright lib/python3/dist-packages/tack_program.py lib/python3/dist-packages/tack/{__init__.py,_tack.pyi} include/tack/geometry/types.hpp lib/cmake/tack/tackConfig.cmake; do
  [[ -s $scratch/root/usr/$file ]] || fail "the package does not have $file"
done
for a in "${architectures[@]}"; do
  for file in lib/python3/dist-packages/tack/lib/$a/libtack.so libexec/tack/$a/bin/{tack,tack_studies,libtack_further.so}; do
    [[ -s $scratch/root/usr/$file ]] || fail "the packages do not have $file"
  done
done

[[ -e $scratch/root/usr/lib/python3/dist-packages/tack/py.typed ]] || fail "the package does not have py.typed, without which type checkers ignore its types"

# used COMMAND...: what the README shows, a mesh by CGAL, one by Gmsh, a study, and what the results say of the program.
cat >"$scratch/use.sh" <<'END'
set -euo pipefail
tack=$1 share=$2 architecture=$3
export TACK_ARCHITECTURE=$architecture
"$tack" --version | grep -q -e "-march=$architecture " || { "$tack" --version; exit 1; }
"$tack" run "$share/experiments/debonding/pull.yaml" -q -o "pull_$architecture"
grep -q -e "\"flags\": \".*-march=$architecture " "pull_$architecture/summary.json"
"$tack" mesh sdf "$share/experiments/meshing/turned.yaml" --object ring -o ring.msh
"$tack" mesh tetrahedralize ring.msh -o ring.vtu edge_length=2mm
"$tack" law --type fang peak_traction=10kPa work_of_adhesion=15J/m^2 --young 1MPa >law.txt
"$tack" completion bash | bash -n
"$tack" new probe-tack -o probe_tack.yaml
"$tack" check probe_tack.yaml >check.txt
"$tack" list cohesive zone | grep -q docs/theory/bonds.md
rm probe_tack.yaml
END
# The Python package: it finds the libraries and the page of reports of the package tack, and has its bits.
cat >"$scratch/use.py" <<'END'
import pathlib
import sys

import numpy as np

import tack

share, recorded = pathlib.Path(sys.argv[1]), sys.argv[2]
sim = tack.Simulation(share / "experiments/debonding/pull.yaml")
sim.run(until=0.01)
probes = tack.read(recorded).probes
assert sim.probes()["adhesion"] == probes["adhesion"][np.argmin(np.abs(probes["time"] - sim.time))], "the program and Python have other bits"
tack.Simulation(share / "experiments/meshing/turned.yaml")  # by libtack_meshing.so
if (share / "report.html").exists():
    assert "<iframe" in tack.read(recorded)._repr_html_()
END
cd "$scratch/work"
here=("${architectures[0]}")
for level in "${architectures[@]:1}"; do TACK_ARCHITECTURE=$level "$scratch/root/usr/bin/tack" --version >/dev/null 2>&1 && here+=("$level"); done
for architecture in "${here[@]}"; do
  bash "$scratch/use.sh" "$scratch/root/usr/bin/tack" "$scratch/root/usr/share/tack" "$architecture" >use.log 2>&1 || { tail -20 use.log; fail "of $architecture"; }
  TACK_ARCHITECTURE=$architecture PYTHONPATH=$scratch/root/usr/lib/python3/dist-packages /usr/bin/python3 "$scratch/use.py" "$scratch/root/usr/share/tack" "pull_$architecture" >use.log 2>&1 ||
    { tail -20 use.log; fail "of Python, $architecture"; }
done
"$scratch/root/usr/bin/tack" --version | grep -q -e "-march=${here[-1]} " || fail "the best for this processor is not what is started"
echo "ran: ${here[*]}"

if ((EUID == 0)) && command -v debootstrap >/dev/null; then
  clean=$scratch/clean
  debootstrap --variant=minbase bookworm "$clean" "${DEBIAN_MIRROR:-http://deb.debian.org/debian}" >"$scratch/debootstrap.log" 2>&1 || { tail -3 "$scratch/debootstrap.log"; echo "no clean Debian: skipped"; exit 0; }
  mount -t proc proc "$clean/proc"
  trap 'umount "$clean/proc"' EXIT
  cp "$package" "$python_package" "$scratch/use.sh" "$scratch/use.py" "$clean/tmp/"
  chroot "$clean" sh -euc "export DEBIAN_FRONTEND=noninteractive; apt-get update -qq; apt-get install -qq -y --no-install-recommends /tmp/$(basename "$package"); ! command -v c++ g++ gcc" >"$scratch/install.log" 2>&1 ||
    { tail -20 "$scratch/install.log"; fail "apt-get in a clean Debian"; }
  chroot "$clean" bash -euc "mkdir /tmp/use; cd /tmp/use; bash /tmp/use.sh tack /usr/share/tack ${here[-1]}" >"$scratch/use.log" 2>&1 || { tail -20 "$scratch/use.log"; fail "in a clean Debian"; }
  chroot "$clean" sh -euc "export DEBIAN_FRONTEND=noninteractive; apt-get install -qq -y --no-install-recommends /tmp/$(basename "$python_package")" >"$scratch/install.log" 2>&1 || { tail -20 "$scratch/install.log"; fail "apt-get of python3-tack in a clean Debian"; }
  chroot "$clean" bash -euc "cd /tmp/use; python3 /tmp/use.py /usr/share/tack pull_${here[-1]}; python3 -m tack --version" >"$scratch/use.log" 2>&1 || { tail -20 "$scratch/use.log"; fail "of Python in a clean Debian"; }
  umount "$clean/proc"
  trap - EXIT
  rm -rf --one-file-system "$clean"
  echo "ran in a clean Debian 12, without a compiler"
else
  echo "not root, or no debootstrap: not installed in a clean Debian"
fi
rm -rf "$scratch/root" "$scratch/work"
