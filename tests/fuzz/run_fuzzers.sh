#!/usr/bin/env bash
# run_fuzzers.sh SOURCE BUILD CLANG SECONDS ENTRY...: builds the fuzzers in BUILD and runs each for so many seconds over its
# committed corpus. New inputs stay in BUILD/corpus, those that end a fuzzer in BUILD/found, and that is a failure.
set -euo pipefail
source=$1 build=$2 clang=$3 seconds=$4
shift 4

cmake -S "$source" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_CXX_FLAGS_RELWITHDEBINFO="-O1 -g" \
    -DCMAKE_CXX_COMPILER="$clang" -DPL_FUZZ=ON -DPL_CUDA=OFF -DPL_TESTS=OFF >"$build.log" 2>&1 || { cat "$build.log"; exit 1; }
cmake --build "$build" --target fuzzers -j 2 >>"$build.log" 2>&1 || { tail -50 "$build.log"; exit 1; }

failed=0
for entry in "$@"; do
    seeds=("$source/tests/fuzz/corpus/$entry")
    case $entry in
        obj | json) seeds+=("$source/tests/corpus/accepted" "$source/tests/corpus/refused") ;;
        script) seeds+=("$source/tests/ui/scripts") ;;
    esac
    mkdir -p "$build/corpus/$entry" "$build/found"
    echo "fuzz_$entry: $seconds s"
    "$build/fuzz/fuzz_$entry" -max_total_time="$seconds" -timeout=60 -rss_limit_mb=2048 -max_len=16384 -print_final_stats=1 \
        -artifact_prefix="$build/found/$entry-" "$build/corpus/$entry" "${seeds[@]}" >"$build/$entry.log" 2>&1 ||
        { failed=1; tail -40 "$build/$entry.log"; }
    grep -E 'number_of_executed_units|new_units_added' "$build/$entry.log" || true
done
exit $failed
