#!/usr/bin/env bash
# cmake/time_build.sh [TARGET] [CMAKE OPTIONS]   build TARGET (pathlight) from nothing and print the CPU seconds of every file
#
# Ranks translation units by user plus system time, which other work on the machine hardly changes, unlike the clock. Without
# ccache. The last line divides the sum by two: about the wall time on a machine with two idle cores. The folder
# build/time is removed first. Example: cmake/time_build.sh pathlight -DPL_CUDA=OFF
set -euo pipefail

if [[ ${1-} == --launch ]]; then
    # As a compiler launcher: --launch LOG COMMAND...
    log=$2
    shift 2
    for argument; do
        case $argument in
            *.o | *.gch) output=$argument ;;
        esac
    done
    TIMEFORMAT='%U %S'
    code=0
    { time "$@" 2>&3 3>&-; } 3>&2 2>"$log.$$" || code=$?
    printf '%s %s\n' "$(<"$log.$$")" "${output-other}" >>"$log"
    rm -f "$log.$$"
    exit "$code"
fi

script=$(realpath "${BASH_SOURCE[0]}")
root=$(dirname "$(dirname "$script")")
build="$root/build/time"
log="$build/cpu-seconds.txt"
target=${1-pathlight}
(($# == 0)) || shift
rm -rf "$build"
mkdir -p "$build"
: >"$log"
export CCACHE_DISABLE=1
launcher="$script;--launch;$log"
cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_UNITY_BUILD=ON -DPL_TESTS=OFF "$@" \
    -DCMAKE_CXX_COMPILER_LAUNCHER="$launcher" -DCMAKE_CUDA_COMPILER_LAUNCHER="$launcher" >"$build/configure.log"
ninja -C "$build" -j2 --quiet "$target"
awk '{ cpu = $1 + $2; sum += cpu; printf "%7.2f  %s\n", cpu, $3 }
     END { printf "%7.2f  in %d files; on two idle cores about %.0f seconds\n", sum, NR, sum / 2 }' "$log" | sort -rn
