#!/usr/bin/env bash
# Makes build/package/python3-tack_VERSION_amd64.deb from builds that packaging/deb.sh has made: python_deb.sh ROOT ARCHITECTURE...
# The package depends on the package tack, whose libraries, page of reports and experiments it uses.
set -euo pipefail
root=$1 first=$1/$2
shift
stage=$root/python3-tack package=$root/python3-tack/usr/lib/python3/dist-packages/tack built=$first/python/tack
version=$(sed -n 's/^CMAKE_PROJECT_VERSION:STATIC=//p' "$first/CMakeCache.txt")
extension=$(ls "$built"/_tack.cpython-*.so)
minor=$(sed 's/.*_tack\.cpython-3\([0-9]*\)-.*/\1/' <<<"$extension")

rm -rf "$stage" && mkdir -p "$package/bin" "$stage/DEBIAN" "$stage/usr/share/doc/python3-tack"
cp "$built"/*.py "$built"/*.pyi "$built/py.typed" "$extension" "$package/"
cp "$first/python/tack_program.py" "$package/.."
ln -s ../../../../../bin/tack "$package/bin/tack"
cp "$first/copyright" "$stage/usr/share/doc/python3-tack/"
libraries=("$package/$(basename "$extension")")
for a in "$@"; do
  mkdir -p "$package/lib/$a"
  cp "$root/$a/python/tack/lib/libtack.so" "$package/lib/$a/"
  libraries+=("$package/lib/$a/libtack.so")
done
strip --strip-unneeded "${libraries[@]}"
chmod -R u=rwX,go=rX "$stage"
chmod 644 "${libraries[@]}"

# dpkg-shlibdeps reads debian/control of the folder that it runs in.
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir "$scratch/debian" && printf 'Source: tack\n\nPackage: python3-tack\nArchitecture: any\n' >"$scratch/debian/control"
depends=$(cd "$scratch" && dpkg-shlibdeps -O --ignore-missing-info -l"$package/lib/$1" "${libraries[@]}" 2>shlibdeps.log) || { cat "$scratch/shlibdeps.log" >&2; exit 2; }
cat >"$stage/DEBIAN/control" <<END
Package: python3-tack
Version: $version
Architecture: $(dpkg --print-architecture)
Section: python
Maintainer: tack maintainers <tack@localhost>
Installed-Size: $(du -sk --exclude=DEBIAN "$stage" | cut -f1)
Depends: tack (= $version), python3 (>= 3.$minor), python3 (<< 3.$((minor + 1))), python3-numpy, ${depends#shlibs:Depends=}
Recommends: python3-scipy, python3-matplotlib
Description: Python package of tack
 Steps scenes, reads results, and has the incremental potential with its derivatives as arrays.
END
dpkg-deb --root-owner-group --build "$stage" "$root/python3-tack_${version}_$(dpkg --print-architecture).deb" >/dev/null
rm -rf "$stage"
