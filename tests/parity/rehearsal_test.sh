#!/usr/bin/env bash
# rehearsal_test.sh STANDIN ROOT [all]: plays run_on_device.sh without a GPU, by the programs of the folder STANDIN, and reads its
# summaries: stage a passes, tools that the machine lacks are named; a step whose pictures differ, that crashes or takes too long
# fails the stage and leaves the results of the steps before. all: the other stages too, and a kit with a variant.
set -uo pipefail
standin=$(realpath "$1") root=$(realpath "$2") all=${3-}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
problems=0

# expect WHAT EXPECTED GOT
expect() {
    if [[ $3 != "$2" ]]; then
        echo "FAILED: $1: expected '$2', got '$3'"
        problems=$((problems + 1))
    fi
}

# make_kit FOLDER: a kit of links, whose programs a test may replace
make_kit() {
    mkdir -p "$1/standin" "$1/variants"
    ln -s "$root/assets" "$1/assets"
    ln -s "$standin"/* "$1/standin/"
}
# replace KIT PROGRAM LINE...: a shell script in place of a program
replace() {
    local file=$1/standin/$2_on_host
    shift 2
    rm "$file"
    printf '%s\n' '#!/usr/bin/env bash' "$@" >"$file"
    chmod +x "$file"
}
# skip KIT PROGRAM...: programs that do nothing, with success
skip() {
    local kit=$1 program
    shift
    for program; do replace "$kit" "$program" 'exit 0'; done
}

# play KIT STAGE [ENVIRONMENT...]: the exit code; its files go to KIT/results
play() {
    env "${@:3}" "$root/tests/parity/run_on_device.sh" --stage "$2" --kit "$1" --results "$1/results" --rehearsal \
        >"$1/output" 2>&1
    code=$?
}
# status KIT STAGE STEP: the status in its summary line, its note after a colon
status() { awk -F '\t' -v step="$3" '$1 == step { print $2 ($4 == "" ? "" : ": " $4) }' "$1/results/stage-$2.tsv"; }
# count KIT STAGE STATUS
count() { awk -F '\t' -v status="$3" '$2 == status && $1 != "stage"' "$1/results/stage-$2.tsv" | wc -l; }
shows() { # what was written, after a failure of the test itself
    [[ $problems == "$1" ]] || { cat "$2/output"; cat "$2/results/"*.tsv; }
}

# Tools that take the place of NVIDIA's: they run the program behind their options.
mkdir "$work/tools"
# shellcheck disable=SC2016
printf '%s\n' '#!/usr/bin/env bash' 'while [[ ! -x $1 || -d $1 ]]; do shift; done' 'exec "$@"' >"$work/tools/ncu"
chmod +x "$work/tools/ncu"
cp "$work/tools/ncu" "$work/tools/compute-sanitizer"
with_tools="PATH=$work/tools:$PATH"

stage_a_passes() {
    local kit=$work/whole before=$problems
    make_kit "$kit"
    play "$kit" a "$with_tools"
    expect "stage a: exit code" 0 "$code"
    expect "stage a: last line" "passed: 0 failed, 0 missing" "$(status "$kit" a stage)"
    expect "stage a: steps" 18 "$(count "$kit" a ok)"
    expect "stage a: cases that are equal to the bit" 24 "$(grep -c '^@compare	.*result=equal' "$kit/results/stage-a.log")"
    expect "stage a: rows of the benchmark" 18 "$(grep -c '^@bench	' "$kit/results/stage-a.log")"
    shows "$before" "$kit"
}

missing_tools_are_named() {
    local kit=$work/tools-missing before=$problems
    make_kit "$kit"
    skip "$kit" pathlight device_parity compare_backends cuda_bench
    mkdir "$work/bin"
    local tool
    for tool in bash env sed awk cat tee date mktemp dirname basename mkdir rm head tr timeout ldd grep; do
        ln -s "$(command -v "$tool")" "$work/bin/$tool"
    done
    play "$kit" a "PATH=$work/bin"
    expect "without tools: exit code" 0 "$code"
    expect "without tools: memcheck" "missing: no compute-sanitizer on this machine" "$(status "$kit" a memcheck)"
    expect "without tools: last line" "passed: 0 failed, 2 missing" "$(status "$kit" a stage)"
    shows "$before" "$kit"
}

# Steps that fail, among others that pass.
faults_fail_the_stage() {
    local kit=$work/faults before=$problems
    make_kit "$kit"
    skip "$kit" cuda_bench device_parity
    # shellcheck disable=SC2016
    replace "$kit" pathlight '[[ $* == *picture-sarsa* ]] && { echo before the crash; kill -SEGV $$; }' \
        '[[ $* == *picture-monte-carlo* ]] && exit 3' 'exit 0'
    replace "$kit" compare_backends "exec '$standin/compare_backends_on_host' --side 4 --passes 1 --scenes cornell --volumes 5 --spoil"
    play "$kit" a "$with_tools"
    expect "faults: exit code" 1 "$code"
    expect "faults: difference of a picture" "failed: exit code 1" "$(status "$kit" a compare)"
    expect "faults: cases that differ" 1 "$(grep -c '^@compare	.*result=differs' "$kit/results/stage-a.log")"
    expect "faults: crash" "crashed: signal SEGV" "$(status "$kit" a picture-sarsa)"
    expect "faults: output before the crash" 1 "$(grep -c '^before the crash' "$kit/results/stage-a.log")"
    expect "faults: exit code of a program" "failed: exit code 3" "$(status "$kit" a picture-monte-carlo)"
    expect "faults: a step before" ok "$(status "$kit" a picture-reinforcement)"
    expect "faults: a step after" ok "$(status "$kit" a bench)"
    expect "faults: last line" "failed: 3 failed, 0 missing" "$(status "$kit" a stage)"
    shows "$before" "$kit"
}

# Steps that never end, by steps.sh itself, so that the test need not wait for the limits of a stage.
late_steps_fail() {
    local before=$problems late=$work/late
    mkdir "$late"
    (
        # shellcheck source=steps.sh
        source "$root/tests/parity/steps.sh"
        begin_stage x "$late/results" 600
        step first 600 echo done
        step hangs 5 bash -c 'echo started; exec sleep 1000'
        step ignores-term 1 bash -c 'trap "" TERM; while :; do sleep 1; done'
        deadline=$SECONDS
        step last 600 true
        end_stage
    ) >"$late/output" 2>&1
    expect "late steps: exit code" 1 "$?"
    expect "late steps: a step before" ok "$(status "$late" x first)"
    expect "late steps: time limit" "timeout: limit 5 s" "$(status "$late" x hangs)"
    expect "late steps: output before the limit" 1 "$(grep -c '^started' "$late/results/stage-x.log")"
    expect "late steps: killed" "timeout: limit 1 s" "$(status "$late" x ignores-term)"
    expect "late steps: no time left" "late: the stage has no time left" "$(status "$late" x last)"
    shows "$before" "$late"
}

no_device_ends_the_stage() {
    local kit=$work/no-device before=$problems
    make_kit "$kit"
    # shellcheck disable=SC2016
    replace "$kit" pathlight '[[ $1 == render ]] && { echo "CUDA: the driver shows no device" >&2; exit 4; }' 'exit 0'
    play "$kit" a
    expect "no device: exit code" 4 "$code"
    expect "no device: step" "failed: exit code 4" "$(status "$kit" a picture-default)"
    expect "no device: reason" 1 "$(grep -c 'the driver shows no device' "$kit/results/stage-a.log")"
    shows "$before" "$kit"
}

other_stages_pass() {
    local kit=$work/others before=$problems stage
    make_kit "$kit"
    mkdir "$kit/variants/plain"
    local program
    for program in compare_backends cuda_bench; do ln -s "$standin/${program}_on_host" "$kit/variants/plain/$program"; done
    for stage in b c; do
        play "$kit" $stage "$with_tools" SWITCH_SIZE=64x64
        expect "stage $stage: exit code" 0 "$code"
        expect "stage $stage: last line" "passed: 0 failed, 0 missing" "$(status "$kit" $stage stage)"
    done
    expect "stage b: switches" 12 "$(grep -c '^@switch	' "$kit/results/stage-b.log")"
    expect "stage b: parts of a pass that are timed" 30 "$(grep -c '^@work	' "$kit/results/stage-b.log")"
    expect "stage c: the variant is compared" ok "$(status "$kit" c variant-plain-compare)"
    expect "stage c: random cases that differ" 0 "$(grep -c '^@random	.*result=differs' "$kit/results/stage-c.log")"
    shows "$before" "$kit"
}

if [[ $all == all ]]; then
    other_stages_pass
else
    stage_a_passes
    missing_tools_are_named
    faults_fail_the_stage
    late_steps_fail
    no_device_ends_the_stage
fi
((problems == 0)) && echo "rehearsal: as expected"
exit $((problems > 0))
