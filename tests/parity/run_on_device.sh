#!/usr/bin/env bash
# run_on_device.sh [RESULTS]: everything that needs a GPU, in under ten minutes: the parity suite, a short run of each
# kernel under compute-sanitizer (if it is there), and the benchmark. Builds for the architecture of the GPU that is
# there. Leaves one file, RESULTS (default cuda-results.md).
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.." || exit 2
results=${1:-cuda-results.md}
arch=$(nvidia-smi --query-gpu=compute_cap --format=csv,noheader | head -1 | tr -d .)
[[ $arch =~ ^[0-9]+$ ]] || { echo "no GPU: nvidia-smi names none" >&2; exit 4; }
cmake --preset cuda-dev -DCMAKE_CUDA_ARCHITECTURES="$arch" &&
    cmake --build --preset cuda-dev --target device_parity cuda_bench pathlight || exit 1
build=build/cuda-dev
failed=0
section() { printf '\n## %s\n```\n' "$1"; }
{
    printf '# CUDA on %s, %s\n' "$(nvidia-smi --query-gpu=name --format=csv,noheader | head -1)" "$(date -I)"
    printf 'commit %s, nvcc %s, driver %s\n' "$(git rev-parse --short HEAD 2>/dev/null || echo unknown)" \
        "$(nvcc --version | sed -n 's/.*release \([0-9.]*\),.*/\1/p')" \
        "$(nvidia-smi --query-gpu=driver_version --format=csv,noheader | head -1)"
    section "Parity"
    "$build/bin/device_parity" || failed=1
    printf '```\n'
    if command -v compute-sanitizer >/dev/null; then
        for tool in memcheck racecheck initcheck; do
            section "compute-sanitizer --tool $tool"
            for method in default precomputed reinforcement; do
                compute-sanitizer --tool "$tool" --error-exitcode 9 "$build/pathlight" render door --backend cuda \
                    --method "$method" --nee on --spp 2 --size 24x24 --volumes 20 --bins 16 --no-progress \
                    -o "$build/sanitizer.pfm" | tail -1 || failed=1
            done
            compute-sanitizer --tool "$tool" --error-exitcode 9 "$build/pathlight" render cornell --backend cuda \
                --view voronoi --spp 1 --size 24x24 --no-progress -o "$build/sanitizer.pfm" | tail -1 || failed=1
            printf '```\n'
        done
    fi
    printf '\n## Speed\n'
    "$build/bench/cuda_bench" 1 || failed=1
} >"$results" 2>&1
cat "$results"
exit $failed
