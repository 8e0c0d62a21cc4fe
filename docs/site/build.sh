#!/usr/bin/env bash
# Builds the site of the documents: build.sh OUTPUT [--serve [ADDRESS]]
# OUTPUT/site is what can be published as it is; beside it stands what it is made from. Needs mkdocs with its theme
# material, mkdocstrings, Doxygen and KaTeX (`./tack docs` installs them).
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
root=$(readlink -f "$here/../..")
mkdir -p "$1"
output=$(readlink -f "$1")
address=${3-127.0.0.1:8000}

"$here/headers.py" "$root" "$output/headers"
version=$(sed -n 's/^project(tack VERSION \([0-9.]*\).*/\1/p' "$root/CMakeLists.txt")
SITE=$here HEADERS=$output/headers OUTPUT=$output VERSION=$version doxygen "$here/Doxyfile"
export TACK_DOCS=$output
cd "$here"  # mkdocstrings would take the script `tack` for the package
if [[ ${2-} == --serve ]]; then exec mkdocs serve --strict -f "$root/mkdocs.yml" --dev-addr "$address"; fi
mkdocs build --strict -f "$root/mkdocs.yml" --site-dir "$output/site" >"$output/mkdocs.log" 2>&1 || { cat "$output/mkdocs.log" >&2; exit 1; }
