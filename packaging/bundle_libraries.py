#!/usr/bin/env python3
"""Makes a wheel that was built on Debian independent of Debian's libraries, as auditwheel does: bundle_libraries.py WHEEL FOLDER

The shared libraries that the wheel needs are copied into NAME.libs under names with a digest of their contents, so that no other library of the same name is taken for
them, and NEEDED and RPATH of all files are rewritten. Only the libraries of `from_the_system` stay outside. The wheel's tag is the oldest manylinux (PEP 600) that has the
versions of symbols that are needed. The copyright files of all packages whose code is in it go along. Prints the file that it writes into FOLDER.

Needs patchelf, binutils and python3-wheel.
"""
from __future__ import annotations

import hashlib
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile

from wheel.wheelfile import WheelFile

# glibc and the libraries of GCC that every manylinux has (PEP 600, auditwheel's policies). Those policies also allow X11, OpenGL and zlib, which a server or a container need not have:
# they are bundled.
from_the_system = re.compile(r"(ld-linux-x86-64|ld-linux-aarch64|lib(c|m|dl|rt|pthread|util|resolv|anl|mvec|stdc\+\+|gcc_s))\.so\.\d+$")

# The first manylinux_2_N that has a minor version of GLIBCXX_3.4.M, after auditwheel's policies.
first_glibc_with = {28: 31, 29: 34, 30: 35, 31: 38, 32: 39, 33: 41}

# Packages whose headers are compiled in.
header_packages = ["libcgal-dev", "libcli11-dev", "libeigen3-dev", "nlohmann-json3-dev", "pybind11-dev"]


def output_of(*command: str | pathlib.Path) -> str:
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"bundle_libraries.py: {' '.join(map(str, command))}: {done.stderr.strip()}")
    return done.stdout


def is_elf(path: pathlib.Path) -> bool:
    with open(path, "rb") as file:
        return file.read(4) == b"\x7fELF"


def needed(path: pathlib.Path) -> list[str]:
    return output_of("patchelf", "--print-needed", path).split()


def found(path: pathlib.Path, inside: set[str]) -> dict[str, pathlib.Path]:
    """Returns the files that the loader takes for all libraries below this one, by name. Those named `inside` may be loaded by the package itself."""
    lines = output_of("ldd", path)
    if missing := set(re.findall(r"(\S+) => not found", lines)) - inside:
        sys.exit(f"bundle_libraries.py: {path} needs {', '.join(missing)}, which is not installed")
    return {name: pathlib.Path(file) for name, file in re.findall(r"(\S+) => (/\S+)", lines)}


def bundled_name(path: pathlib.Path, soname: str) -> str:
    stem, dot, rest = soname.partition(".so")
    return f"{stem}-{hashlib.sha256(path.read_bytes()).hexdigest()[:8]}{dot}{rest}"


def collect(own: list[pathlib.Path]) -> dict[str, pathlib.Path]:
    """Returns the libraries outside the wheel that its files need, directly or not, by name."""
    libraries: dict[str, pathlib.Path] = {}
    inside = {path.name for path in own}
    for path in own:
        closure = found(path, inside)
        waiting = needed(path)
        while waiting:
            name = waiting.pop()
            if name in libraries or name in inside or from_the_system.match(name):
                continue
            file = closure[name].resolve()
            libraries[name] = file
            waiting += needed(file)
    return libraries


def packages_of(files: list[pathlib.Path]) -> dict[pathlib.Path, str]:
    """Returns the Debian package of each file. /lib is a link to /usr/lib, and packages name either."""
    asked = {path: file for file in files for path in (str(file), str(file).removeprefix("/usr"))}
    answer = subprocess.run(["dpkg-query", "-S", *asked], capture_output=True, text=True).stdout  # its status is 1 where a path has no package
    packages = {asked[path]: package for package, path in re.findall(r"^([\w.+-]+)(?::\w+)?: (/.*)$", answer, re.MULTILINE)}
    if without := [str(file) for file in files if file not in packages]:
        sys.exit(f"bundle_libraries.py: of no Debian package, so that their licence is not known: {', '.join(without)}")
    return packages


def add_licences(folder: pathlib.Path, libraries: list[pathlib.Path]) -> None:
    """Writes the copyright files of the packages, the licences that they refer to, and a list with their versions, whose sources Debian keeps."""
    folder.mkdir()
    packages = packages_of(libraries)
    installed = {*packages.values(), *(name for name in header_packages if pathlib.Path("/usr/share/doc", name).exists())}
    common = {"GPL-3"}  # that of the wheel as a whole
    for package in sorted(installed):
        text = pathlib.Path("/usr/share/doc", package, "copyright").read_text(encoding="utf-8", errors="replace")
        (folder / f"{package}.txt").write_text(text, encoding="utf-8")
        common |= {name.rstrip(".") for name in re.findall(r"/usr/share/common-licenses/([\w.-]+)", text)}
    for name in common:
        if (text_file := pathlib.Path("/usr/share/common-licenses", name)).exists():
            shutil.copy(text_file.resolve(), folder / f"common-licenses-{name}.txt")
    lines = ["This wheel contains libraries of Debian, unchanged but for their names and those of the libraries that they load, and code of headers. Debian keeps their sources:",
             "https://snapshot.debian.org. It links Gmsh (GPL 2 or later) and packages of CGAL (GPL 3 or later), and as a whole it is under the GPL 3.", ""]
    for package in sorted(installed):
        version, source = output_of("dpkg-query", "-W", "-f", "${Version} ${source:Package}", package).split()
        names = sorted(file.name for file, owner in packages.items() if owner == package) or ["headers"]
        lines.append(f"{package} {version}, of the source package {source}: {', '.join(names)}")
    (folder / "BUNDLED.txt").write_text("\n".join(lines) + "\n", encoding="utf-8")


def manylinux(files: list[pathlib.Path], machine: str) -> str:
    """Returns the oldest platform tag that has the versions of symbols that the files need."""
    glibc, glibcxx = 17, 0
    for file in files:
        names = output_of("readelf", "-W", "--version-info", file).split("Version needs section", 1)[-1]
        glibc = max([glibc, *(int(minor) for minor in re.findall(r"Name: GLIBC_2\.(\d+)", names))])
        glibcxx = max([glibcxx, *(int(minor) for minor in re.findall(r"Name: GLIBCXX_3\.4\.(\d+)", names))])
    if glibcxx > max(first_glibc_with):
        sys.exit(f"bundle_libraries.py: no manylinux is known that has GLIBCXX_3.4.{glibcxx}")
    return f"manylinux_2_{max([glibc, *(first for minor, first in first_glibc_with.items() if minor <= glibcxx)])}_{machine}"


def main() -> None:
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    source, target = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    with tempfile.TemporaryDirectory() as scratch:
        root = pathlib.Path(scratch).resolve()
        with zipfile.ZipFile(source) as archive:
            archive.extractall(root)
        info = next(root.glob("*.dist-info"))
        own = [path for path in sorted(root.rglob("*")) if path.is_file() and is_elf(path)]
        for path in own:
            path.chmod(0o755)
            output_of("strip", "--strip-unneeded", path)
        libraries = collect(own)
        folder = root / f"{info.name.split('-')[0]}.libs"
        folder.mkdir()
        renamed = {name: bundled_name(file, name) for name, file in libraries.items()}
        for name, file in libraries.items():
            shutil.copy(file, folder / renamed[name])
            (folder / renamed[name]).chmod(0o755)
        copies = [folder / name for name in renamed.values()]
        # Copies have no path of their own: the loader looks where the file that began the search does (RPATH, unlike RUNPATH). Each call of patchelf appends another copy of all names,
        # but patchelf 0.14 writes wrong ones in a call for two kinds of changes.
        for path in [*own, *copies]:
            options = [word for name in needed(path) if name in renamed for word in ("--replace-needed", name, renamed[name])]
            if options:
                output_of("patchelf", *options, path)
            if path in copies:
                output_of("patchelf", "--remove-rpath", path)
                output_of("patchelf", "--set-soname", path.name, path)
                if output_of("patchelf", "--print-soname", path).strip() != path.name:
                    sys.exit(f"bundle_libraries.py: patchelf did not rename {path}")
            else:
                inside = [entry for entry in output_of("patchelf", "--print-rpath", path).strip().split(":") if entry.startswith("$ORIGIN")]
                up = "/".join([".."] * (len(path.relative_to(root).parts) - 1))
                output_of("patchelf", "--force-rpath", "--set-rpath", ":".join([*inside, f"$ORIGIN/{up}/{folder.name}"]), path)
            if left := [name for name in needed(path) if name in renamed]:
                sys.exit(f"bundle_libraries.py: {path} still needs {left}")
        for path in own:
            for name, file in found(path, {other.name for other in own}).items():
                if not from_the_system.match(name) and not file.resolve().is_relative_to(root):
                    sys.exit(f"bundle_libraries.py: {path} still takes {file}")
        add_licences(info / "licenses", list(libraries.values()))
        machine = re.search(r"linux_(\w+)\.whl$", source.name).group(1)
        tag = manylinux([*own, *copies], machine)
        about = info / "WHEEL"
        about.write_text(re.sub(r"(Tag: .*-)linux_\w+", rf"\g<1>{tag}", about.read_text()))
        (info / "RECORD").unlink()
        target.mkdir(parents=True, exist_ok=True)
        wheel = target / re.sub(r"linux_\w+\.whl$", f"{tag}.whl", source.name)
        wheel.unlink(missing_ok=True)
        with WheelFile(str(wheel), "w") as file:
            file.write_files(str(root))
    print(wheel)


if __name__ == "__main__":
    main()
