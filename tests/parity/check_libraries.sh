#!/usr/bin/env bash
# check_libraries.sh FOLDER: does every program of the folder find all its shared libraries? Prints those that are not found, and
# exits 1 if any.
set -euo pipefail
failures=0
checked=0
for program in "$1"/*; do
    [[ -f $program && $(head -c 4 "$program" | tr -d '\0') == $'\x7fELF' ]] || continue
    checked=$((checked + 1))
    needed=$(ldd "$program")
    if grep 'not found' <<<"$needed"; then
        echo "$program: libraries are missing" >&2
        failures=$((failures + 1))
    fi
done
echo "$checked programs, $failures with missing libraries"
((checked > 0 && failures == 0))
