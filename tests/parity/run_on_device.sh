#!/usr/bin/env bash
# run_on_device.sh [--built DIR] [RESULTS]: everything that needs a GPU, in under ten minutes: the parity suite, both back
# ends' pictures bit by bit, a short run of each kernel under compute-sanitizer, the switch of back ends in the viewer, the
# benchmark, and Nsight Compute's analysis of the kernels. Missing tools are left out, and named. Builds for the
# present GPU, or takes programs that were built elsewhere: DIR is a build folder with pathlight, bin/device_parity,
# bench/cuda_bench, and in lib/ the shared libraries that the machine lacks. Leaves one file, RESULTS (default cuda-results.md).
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.." || exit 2
built=
if [[ ${1-} == --built ]]; then
    built=${2:?--built needs a folder}
    shift 2
fi
results=${1:-cuda-results.md}
arch=$(nvidia-smi --query-gpu=compute_cap --format=csv,noheader | head -1 | tr -d .)
[[ $arch =~ ^[0-9]+$ ]] || { echo "no GPU: nvidia-smi names none" >&2; exit 4; }
if [[ -n $built ]]; then
    build=$built
    export LD_LIBRARY_PATH=$PWD/$built/lib${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH} PATHLIGHT_ASSETS=$PWD/assets
    [[ $built == /* ]] && LD_LIBRARY_PATH=${LD_LIBRARY_PATH#"$PWD/"}
else
    build=build/cuda-dev
    cmake --preset cuda-dev -DCMAKE_CUDA_ARCHITECTURES="$arch" &&
        cmake --build --preset cuda-dev --target device_parity cuda_bench pathlight || exit 1
fi
for program in pathlight bin/device_parity bench/cuda_bench; do
    [[ -x $build/$program ]] || { echo "no program $build/$program" >&2; exit 2; }
done
pathlight=$(realpath "$build/pathlight")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failed=0
section() { printf '\n## %s\n```\n' "$1"; }
has() {
    command -v "$1" >/dev/null && return
    printf '\nNot there, so left out: %s\n' "$1"
    return 1
}

# picture BACKEND ARGUMENTS...: renders BACKEND.pfm
picture() {
    local backend=$1
    shift
    rm -f "$work/$backend.pfm"
    "$pathlight" render "$@" --backend "$backend" --spp 16 --size 128x128 --quiet --no-progress -o "$work/$backend.pfm"
}
# Every scene, method and light sampling on both back ends: equal, or which share of the floats differs. The header of
# both files has the same length, and a float is four bytes.
compare_bits() {
    local scene method nee backend differing
    for scene in assets/scenes/*/; do
        scene=$(basename "$scene")
        for method in default precomputed reinforcement; do
            for nee in off on; do
                for backend in cpu cuda; do
                    picture "$backend" "$scene" --method "$method" --nee "$nee" || failed=1
                done
                if cmp -s "$work/cpu.pfm" "$work/cuda.pfm"; then
                    echo "$scene $method nee=$nee: equal"
                    continue
                fi
                if ! [[ -f $work/cpu.pfm && -f $work/cuda.pfm ]]; then
                    echo "$scene $method nee=$nee: no picture"
                    continue
                fi
                # cmp counts from 1; the floats are the last bytes of the file.
                differing=$(cmp -l "$work/cpu.pfm" "$work/cuda.pfm" |
                    awk -v header=$(($(stat -c %s "$work/cpu.pfm") - 128 * 128 * 12)) '
                        { float = int(($1 - 1 - header) / 4); if (float != last || NR == 1) ++count; last = float }
                        END { printf "%.4f", 100 * count / (128 * 128 * 3) }')
                echo "$scene $method nee=$nee: $differing % of the floats differ"
            done
        done
    done
}

# Switches to and fro in the viewer on SDL's dummy driver, twelve times; percentiles of its trace.
time_switches() {
    local script=$work/switches.script trace=$work/switches.jsonl frame=60 i
    echo "0 wait learned >= 4" >"$script"
    for ((i = 0; i < 12; ++i)); do
        {
            echo "$frame tap B"
            echo "$((frame + 2)) wait shown_backend == $([[ $((i % 2)) == 0 ]] && echo cuda || echo cpu)"
            echo "$((frame + 45)) wait shown_spp >= 2"
        } >>"$script"
        frame=$((frame + 60))
    done
    echo "$frame quit" >>"$script"
    SDL_VIDEODRIVER=dummy timeout 600 "$pathlight" view cornell --backend cpu --method reinforcement --size 1280x720 \
        --script "$script" --ui-trace "$trace"
}

{
    printf '# CUDA on %s, %s\n' "$(nvidia-smi --query-gpu=name --format=csv,noheader | head -1)" "$(date -I)"
    printf 'commit %s, nvcc %s, driver %s%s\n' "$(git rev-parse --short HEAD 2>/dev/null || echo unknown)" \
        "$(nvcc --version 2>/dev/null | sed -n 's/.*release \([0-9.]*\),.*/\1/p' | grep . || echo 'not there')" \
        "$(nvidia-smi --query-gpu=driver_version --format=csv,noheader | head -1)" "${built:+, programs of $built}"
    section "Parity"
    "$build/bin/device_parity" || failed=1
    printf '```\n'
    section "Both back ends, bit by bit: 128x128, 16 samples"
    compare_bits
    printf '```\n'
    if has compute-sanitizer; then
        for tool in memcheck racecheck initcheck; do
            section "compute-sanitizer --tool $tool"
            for method in default precomputed reinforcement; do
                compute-sanitizer --tool "$tool" --error-exitcode 9 "$pathlight" render door --backend cuda \
                    --method "$method" --nee on --spp 2 --size 24x24 --volumes 20 --bins 16 --no-progress \
                    -o "$work/sanitizer.pfm" | tail -1 || failed=1
            done
            compute-sanitizer --tool "$tool" --error-exitcode 9 "$pathlight" render cornell --backend cuda \
                --view voronoi --spp 1 --size 24x24 --no-progress -o "$work/sanitizer.pfm" | tail -1 || failed=1
            printf '```\n'
        done
    fi
    section "Switch of back ends in the viewer, 1280x720"
    time_switches || { echo "FAILED: the viewer exited with $?"; failed=1; }
    printf '```\n\n## Speed\n'
    "$build/bench/cuda_bench" 1 || failed=1
    if has ncu; then
        for method in default reinforcement; do
            section "ncu: $method, light samples"
            ncu --section SpeedOfLight --section Occupancy --section WarpStateStats --section MemoryWorkloadAnalysis \
                --kernel-name regex:trace_paths --launch-skip 4 --launch-count 1 "$pathlight" render cornell \
                --backend cuda --method "$method" --nee on --spp 8 --size 1920x1080 --quiet --no-progress \
                -o "$work/ncu.pfm" || echo "ncu could not: counters may need more rights"
            printf '```\n'
        done
    fi
} >"$results" 2>&1
cat "$results"
exit $failed
