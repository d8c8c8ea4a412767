#!/usr/bin/env bash
# count_source.sh ROOT: files, lines and types of the product (C++ and CUDA sources outside tests/), of cpu/ alone, and of the tests.
# Types are the classes, structures, enumerations and unions that ctags finds.
set -euo pipefail
cd "$1"
sources() { git ls-files -- "$@" | grep -E '\.(h|cpp|cu|cuh|inc)$'; }
product() { sources | grep -v '^tests/'; }
row() {
    local files
    files=$(cat)
    printf '%-8s %5d files %6d lines %5d types\n' "$1" "$(wc -l <<<"$files")" "$(xargs cat <<<"$files" | wc -l)" \
        "$(xargs ctags -x --language-force=C++ --c++-kinds=csgu <<<"$files" | wc -l)"
}
product | row product
sources cpu | row cpu
sources tests | row tests
