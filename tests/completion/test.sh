#!/usr/bin/env bash
# Tests the scripts of `tack completion`, in the installed shells, and the manual page: test.sh PROGRAM FOLDER. Makes a subfolder of FOLDER
set -euo pipefail
program=$1 scratch=$2/completion_test
rm -rf "$scratch" && mkdir -p "$scratch/results/pull" && cd "$scratch"
touch scene.yaml other.YML notes.txt part.stl part.glb probes.csv libmine.so 'with space.yaml'

fail() {
  echo "FAIL: $*" >&2
  exit 1
}

# completed WORD...: prints the completions of the last word by bash, sorted.
completed() {
  "$BASH" --norc -c 'set -u; source /dev/stdin; COMP_WORDS=("$@") COMP_CWORD=$(($# - 1)) COMP_LINE="$*" COMP_POINT=${#COMP_LINE}; _tack || true; ((${#COMPREPLY[@]} == 0)) || printf "%s\n" "${COMPREPLY[@]}"' \
    bash "$@" < <("$program" completion bash) | sort
}
# offers EXPECTED WORD...: fails unless bash offers exactly these lines.
offers() {
  local expected=$1 got
  shift
  got=$(completed "$@" | paste -sd '|')
  [[ $got == "$expected" ]] || fail "bash: '$*': offers '$got', expected '$expected'"
}
# offers_among EXPECTED WORD...: fails unless bash offers the first word, among others.
offers_among() {
  local one=$1
  shift
  completed "$@" | grep -qxF -e "$one" || fail "bash: '$*': does not offer '$one', but '$(completed "$@" | paste -sd '|')'"
}

offers 'calibrate|check|compare|completion' tack c
offers 'other.YML|results|scene.yaml|with space.yaml' tack run ''
offers 'scene.yaml' tack run sc
offers 'scene.yaml' tack run --set time.step = 1 sc
offers 'results' tack run scene.yaml -o ''
offers 'results/pull' tack report results/
offers '' tack run scene.yaml --threads ''
offers '--set|--steps' tack run --s
offers_among --dump-problem tack run scene.yaml --d
offers 'remesh|repair' tack mesh re
offers 'part.glb|part.stl' tack mesh remesh part
offers_among edge_length= tack mesh remesh part.stl e
offers 'holes=' tack mesh repair part.stl h
offers 'remesh|repair' tack mesh -o out.obj re
offers 'minimizer' tack list min
offers_among projected_newton tack list minimizer p
offers 'projected_newton' tack list --plugin libmine.so minimizer proj
offers 'libmine.so' tack list --plugin lib
offers 'probes.csv' tack plot results/pull --data p
offers 'peel|probe-tack' tack new p
offers_among fang tack law --type f
offers 'bash|fish|zsh' tack completion ''
offers '' tack nothing ''
for command in $("$program" --help | sed -n '/^Subcommands:/,/^$/p' | awk '/^  [a-z]/ { print $1 }'); do offers_among "$command" tack ''; done

# By the shell itself, as it is typed.
"$program" completion bash >tack.bash
typed=$("$BASH" --norc -c 'source ./tack.bash; complete -p tack')
[[ $typed == 'complete -F _tack tack' ]] || fail "bash: $typed"

"$program" completion zsh >_tack
if command -v zsh >/dev/null; then zsh -n _tack || fail "zsh cannot read its script"; else echo "zsh is not there: its script is not tried"; fi
"$program" completion fish >tack.fish
if command -v fish >/dev/null; then
  fish --no-execute tack.fish || fail "fish cannot read its script"
  fish -c 'source tack.fish; complete -C "tack comp"' | cut -f 1 | grep -qx compare || fail "fish does not offer compare"
  fish -c 'source tack.fish; complete -C "tack run sc"' | cut -f 1 | grep -qx scene.yaml || fail "fish does not offer a scene"
else
  echo "fish is not there: its script is not tried"
fi
code=0
"$program" completion csh >out 2>err || code=$?
((code == 2)) && grep -q 'bash, zsh, fish' err || fail "another shell: $code: $(cat err)"

"$program" list --man tack.1
for command in run mesh completion; do grep -q "^\.SS tack $command" tack.1 || fail "the manual page does not have $command"; done
if command -v man >/dev/null && command -v groff >/dev/null; then
  warnings=$(LC_ALL=C.UTF-8 MANROFFSEQ='' MANWIDTH=80 man --warnings -E UTF-8 -l -Tutf8 -Z tack.1 2>&1 >/dev/null)
  [[ -z $warnings ]] || fail "the manual page: $warnings"
  MANWIDTH=100 man -l tack.1 | grep -q -- '--dump-problem' || fail "man does not show an option"
else
  echo "man or groff is not there: the manual page is not formatted"
fi
rm -rf "$scratch"
