#!/usr/bin/env bash
# check_flags.sh ROOT CXX: flags that change arithmetic are refused when the build is configured, and so is a build without the
# flags that keep it; others are not. Configures a project that is nothing but cmake/Options.cmake.
set -u
root=$(realpath "$1") compiler=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failures=0

printf '%s\n' 'cmake_minimum_required(VERSION 3.25)' 'project(flags LANGUAGES CXX)' 'set(CMAKE_BUILD_TYPE Release)' \
    "include(\"\${OPTIONS}\")" >"$work/CMakeLists.txt"

# expect ACCEPTED|WORDS OPTIONS FLAGS..
expect() {
    local expected=$1 options=$2 told
    shift 2
    told=$(cmake -S "$work" -B "$work/build" --fresh -DOPTIONS="$options" -DCMAKE_CXX_COMPILER="$compiler" \
        -DCMAKE_CXX_FLAGS="$*" 2>&1)
    local code=$?
    # CMake breaks long lines.
    if [[ $expected == accepted && $code -eq 0 ]] || { [[ $code -ne 0 ]] && tr -s '\n ' ' ' <<<"$told" | grep -q "$expected"; }; then
        return
    fi
    printf 'FAILED: %s with flags "%s": expected %s, got code %s and\n%s\n' "$options" "$*" "$expected" "$code" "$told"
    failures=$((failures + 1))
}

options=$root/cmake/Options.cmake
expect accepted "$options"
expect accepted "$options" -O2 -ffinite-math-only
expect accepted "$options" -ffp-contract=fast
expect 'denormal numbers are flushed' "$options" -ffast-math

# The flags of the project undo the flags of the caller.
mkdir "$work/cmake"
cp "$root/cmake/Arithmetic.cmake" "$work/cmake"
sed 's/-fno-fast-math//' "$options" >"$work/cmake/Options.cmake"
expect 'NaN is not found' "$work/cmake/Options.cmake" -ffinite-math-only
if [[ $(uname -m) != x86_64 ]] || grep -qw fma /proc/cpuinfo; then
    sed 's/-ffp-contract=off/-ffp-contract=fast/' "$options" >"$work/cmake/Options.cmake"
    expect 'products and sums are fused' "$work/cmake/Options.cmake"
fi
exit $((failures > 0))
