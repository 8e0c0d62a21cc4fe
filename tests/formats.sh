#!/usr/bin/env bash
# formats.sh BUILD: lets the compiler check the format strings of all messages, which a release build leaves out for its time
# (TACK_CHECK_FORMATS). Nothing is written. Skipped where there is no ninja.
set -euo pipefail
build=$1
command -v ninja >/dev/null && [[ -f $build/build.ninja ]] || { echo "skipped: needs a build by ninja"; exit 77; }
cd "$build"
# Of each file that is compiled: the same command with the checks, so that the precompiled header does not fit and is read as a header.
ninja -t commands bin/tack | grep -e ' -c ' | grep -ve '/cmake_pch.hxx.cxx$' -e '/precompiled.cpp$' |
  sed -e 's/-DFMT_CONSTEVAL=[^ ]*//' -e 's/ -MD / /' -e 's/ -M[TF] [^ ]*//g' -e 's/ -o [^ ]*//' -e 's/ -Winvalid-pch//' -e 's/$/ -w -fsyntax-only/' |
  xargs -d '\n' -n 1 -P "$(nproc)" bash -c
