#!/usr/bin/env bash
# site.sh ROOT SCRATCH: builds the site of the documents in SCRATCH, as `./tack docs` does, and follows its links. Skipped without what it is built with.
set -euo pipefail
for tool in mkdocs doxygen python3; do command -v "$tool" >/dev/null || { echo "skipped: there is no $tool: ./tack docs installs it"; exit 77; }; done
themes=/usr/share/mkdocs/themes/material formulas=/usr/share/javascript/katex
for folder in "$themes" "$formulas"; do [[ -e $folder ]] || { echo "skipped: there is no $folder: ./tack docs installs it"; exit 77; }; done
/usr/bin/python3 -c 'import mkdocstrings, pymdownx' 2>/dev/null || { echo "skipped: Python lacks mkdocstrings or pymdownx: ./tack docs installs them"; exit 77; }
rm -rf "$2/site"
"$1/docs/site/build.sh" "$2"
python3 "$1/tests/docs/site_links.py" "$2/site"
