#!/usr/bin/env bash
# check_mpi.sh ROOT CXX: where no MPI is found, a build does without it and says so, unless it is asked for. Configures a project that
# is nothing but cmake/Mpi.cmake, in which every way of finding MPI is closed.
set -u
root=$(realpath "$1") compiler=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failures=0

printf '%s\n' 'cmake_minimum_required(VERSION 3.25)' 'project(mpi LANGUAGES CXX)' "include(\"$root/cmake/Mpi.cmake\")" \
    "message(STATUS \"built: \${PL_MPI_BUILT}; \${PL_MPI_MISSING}\")" >"$work/CMakeLists.txt"

# expect CODE WORDS OPTION..: configures with the options.
expect() {
    local code=$1 words=$2 told got
    shift 2
    told=$(cmake -S "$work" -B "$work/build" --fresh -DCMAKE_CXX_COMPILER="$compiler" -DMPI_SKIP_COMPILER_WRAPPER=ON \
        -DMPI_SKIP_GUESSING=ON -DCMAKE_DISABLE_FIND_PACKAGE_PkgConfig=ON "$@" 2>&1)
    got=$?
    [[ $got == "$code" ]] && tr -s '\n ' ' ' <<<"$told" | grep -q "$words" && return
    printf 'FAILED: options "%s": expected code %s and "%s", got code %s and\n%s\n' "$*" "$code" "$words" "$got" "$told"
    failures=$((failures + 1))
}

expect 0 'built: OFF; no MPI was found' -DPL_MPI=AUTO
expect 0 'built: OFF; configured with PL_MPI=OFF' -DPL_MPI=OFF
expect 1 'PL_MPI=ON: no MPI was found' -DPL_MPI=ON
exit $((failures > 0))
