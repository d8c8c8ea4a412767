#!/usr/bin/env bash
# run_on_device.sh --stage a|b|c [--seconds N] [--kit FOLDER] [--results FOLDER] [--rehearsal]: everything that needs a GPU, in three
# calls. Results are written as they come, so that a call that is cut off loses nothing: RESULTS/stage-X.tsv is the summary, a line
# per step (steps.sh), RESULTS/stage-X.log all output, from which device_tables.py makes tables. Steps that tell most come first;
# after N seconds (default 470) the stage ends, and steps that did not begin are late.
#   a  libraries, devices, a picture per method, both back ends to the bit, a short benchmark, parity without its long cases,
#      memcheck and synccheck
#   b  the whole benchmark with a million triangles, times by events, profiler counters, switches in the viewer, long parity
#   c  variants of the kernels, initcheck, random settings for the rest of the time
# FOLDER is an unpacked kit (pack_for_device.sh), by default the kit of this script; results go to ./results by default. --rehearsal:
# without a GPU, by the programs FOLDER/standin/*_on_host, on small pictures.
# Exit code: 0 all steps passed, 1 a step failed, 2 usage, 4 no device.
set -uo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

usage() {
    sed -n '2,13p' "${BASH_SOURCE[0]}" | sed 's/^# \{0,1\}//' >&2
    exit 2
}
chosen= kit=$here results=$PWD/results rehearsal= stage_seconds=470
while (($#)); do
    case $1 in
        --stage) chosen=${2-}; shift ;;
        --seconds) stage_seconds=${2-}; shift ;;
        --kit) kit=${2-}; shift ;;
        --results) results=${2-}; shift ;;
        --rehearsal) rehearsal=yes ;;
        *) usage ;;
    esac
    shift || usage
done
[[ $chosen == [abc] && $stage_seconds =~ ^[1-9][0-9]*$ ]] || usage
kit=$(cd "$kit" && pwd) || exit 2
[[ $results == /* ]] || results=$PWD/$results
programs=$kit${rehearsal:+/standin} suffix=${rehearsal:+_on_host}
pathlight=$programs/pathlight$suffix
[[ -x $pathlight ]] || { echo "run_on_device.sh: no program $pathlight" >&2; exit 2; }

# shellcheck source=steps.sh
source "$here/steps.sh"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export PATHLIGHT_ASSETS=$kit/assets SDL_VIDEODRIVER=dummy

# For variants: a scene that is traced from shared memory, and one with lobes that is not.
scenes_c=cornell,coats
# Sizes for a device, and for a rehearsal on a CPU.
if [[ -z $rehearsal ]]; then
    compare_options=(--side 128 --passes 16) compare_c=("${compare_options[@]}" --scenes "$scenes_c")
    bench_a=(--seconds 0.2 --sizes 512x512,1920x1080)
    bench_b=(--seconds 0.4 --also coats,staircase --ball-rows 501)
    bench_c=(--seconds 0.2 --sizes 1920x1080 --also coats,staircase --ball-rows 501)
    times_options=(--scenes cornell,staircase)
    parity_a=('~[merge]') parity_b=('[merge]')
    profiled=(--spp 512 --size 1920x1080) launches_skipped=30
else
    time_scale=10
    compare_options=(--side 12 --passes 2 --volumes 20 --scenes cornell,door)
    compare_c=(--side 12 --passes 2 --volumes 20 --scenes "$scenes_c")
    bench_a=(--seconds 0.01 --sizes 16x16)
    bench_b=(--seconds 0.01 --sizes 16x16 --ball-rows 20)
    bench_c=("${bench_a[@]}" --also coats)
    times_options=(--scenes cornell --width 16 --height 16 --passes 2 --megabytes 1)
    parity_a=('An update with the same training samples is equal to the bit')
    parity_b=('The same seed gives the same bits on the device')
    profiled=(--spp 2 --size 16x16) launches_skipped=0
fi

# picture STEP SECONDS ARGUMENTS...: renders on the device
picture() {
    local name=$1 limit=$2
    shift 2
    step "$name" "$limit" "$pathlight" render "$@" --backend cuda --no-progress -o "$work/$name.pfm"
}

# sanitize TOOL: every method and a view under a tool of compute-sanitizer
sanitize() {
    local tool=$1 method
    needs "$tool" compute-sanitizer || return 0
    local small=(render --backend cuda --spp 2 --size 24x24 --no-progress -o "$work/sanitizer.pfm")
    local checker=(compute-sanitizer --tool "$tool" --error-exitcode 9)
    for method in default precomputed reinforcement; do
        step "$tool-$method" 60 "${checker[@]}" "$pathlight" "${small[@]}" door --method "$method" --nee on --guiding always --volumes 20 --bins 16
    done
    step "$tool-view" 60 "${checker[@]}" "$pathlight" "${small[@]}" cornell --view voronoi
}

stage_a() {
    step libraries 20 "$here/check_libraries.sh" "$programs"
    step devices 60 "$pathlight" devices
    # The first picture pays for the context, and decides whether there is a device at all.
    picture picture-default 60 cornell --method default --spp 4 --size 64x64
    local code=$?
    if ((code == 4)); then
        tell "no device: see the lines above"
        end_stage
        exit 4
    fi
    local method
    for method in precomputed reinforcement; do
        picture "picture-$method" 60 cornell --method "$method" --spp 4 --size 64x64
    done
    for method in sarsa monte-carlo; do
        picture "picture-$method" 60 cornell --method reinforcement --learn "target=$method" --spp 4 --size 64x64
    done
    step compare 200 "$programs/compare_backends$suffix" "${compare_options[@]}"
    step bench 100 "$programs/cuda_bench$suffix" "${bench_a[@]}"
    step parity 120 "$programs/device_parity$suffix" "${parity_a[@]}"
    sanitize memcheck
    sanitize synccheck
}

# profile STEP METHOD METRICS KERNELS SKIP COUNT: so many launches of the kernels of a pattern; the clocks stay as they are.
profile() {
    needs "$1" ncu || return 0
    step "$1" 60 ncu --clock-control none --csv --metrics "$3" --kernel-name "regex:$4" --launch-skip "$5" --launch-count "$6" \
        "$pathlight" render cornell --backend cuda --method "$2" --nee on --guiding always "${profiled[@]}" --quiet --no-progress \
        -o "$work/profile.pfm"
}
profile_kernels() {
    local ceilings=gpu__time_duration.sum
    ceilings+=,sm__throughput.avg.pct_of_peak_sustained_elapsed
    ceilings+=,gpu__compute_memory_throughput.avg.pct_of_peak_sustained_elapsed
    local metrics=$ceilings
    metrics+=,smsp__issue_active.avg.pct_of_peak_sustained_active
    metrics+=,sm__warps_active.avg.pct_of_peak_sustained_active
    metrics+=,smsp__thread_inst_executed_per_inst_executed.ratio
    metrics+=,smsp__inst_executed.sum,smsp__thread_inst_executed.sum
    metrics+=,l1tex__data_pipe_lsu_wavefronts.sum,smsp__inst_executed_op_global_red.sum
    profile profile-default default "$metrics" trace_paths "$launches_skipped" 1
    profile profile-reinforcement reinforcement "$metrics" trace_paths "$launches_skipped" 1
    # Two passes and more, so that every kernel is among them.
    profile ceilings reinforcement "$ceilings" . "$((10 * launches_skipped))" 32
}

stage_b() {
    step bench 180 "$programs/cuda_bench$suffix" "${bench_b[@]}"
    step times 60 "$programs/kernel_times$suffix" "${times_options[@]}"
    profile_kernels
    step switches 60 "$here/time_switches.sh" "$pathlight" "$work"
    step parity-long 200 "$programs/device_parity$suffix" "${parity_b[@]}"
}

stage_c() {
    local variant name
    for variant in "$kit"/variants/*; do
        [[ -d $variant ]] || continue
        name=$(basename "$variant")
        step "variant-$name-compare" 60 "$variant/compare_backends" "${compare_c[@]}"
        step "variant-$name-bench" 60 "$variant/cuda_bench" "${bench_c[@]}"
    done
    step variant-none-bench 60 "$programs/cuda_bench$suffix" "${bench_c[@]}"
    sanitize initcheck
    local rest=$(($(seconds_left) - 30))
    if [[ -n $rehearsal ]] || ((rest < 2)); then rest=2; fi
    step random $((rest + 30)) "$programs/compare_backends$suffix" --random --seed "${RANDOM_SEED:-1}" --seconds "$rest"
}

begin_stage "$chosen" "$results" "$stage_seconds"
tell "@run	stage=$chosen	date=$(date -u +%FT%TZ)	gpu=$(nvidia-smi --query-gpu=name,driver_version --format=csv,noheader 2>/dev/null |
    head -1)	rehearsal=${rehearsal:-no}	kit=$(tr '\n' ' ' <"$kit/KIT" 2>/dev/null)"
"stage_$chosen"
end_stage
