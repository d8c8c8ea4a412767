# steps.sh: steps of a stage, each under its own time limit, for run_on_device.sh. Sourced; needs bash 5.
#
# begin_stage NAME FOLDER SECONDS    files FOLDER/stage-NAME.log (all output, as it comes) and FOLDER/stage-NAME.tsv (the summary)
# step NAME SECONDS COMMAND...       runs a program; its output goes to the log and to standard output
# needs NAME TOOL                    whether the tool is there; a summary line says if it is not
# end_stage                          the last summary line; returns 0 if no step has failed, else 1
#
# Summary lines: step, status, seconds, note, separated by tabs. Status: ok; failed (exit code in the note), crashed (signal in the
# note), timeout; late (the stage had no time left for it); missing (a tool). All but ok and missing fail the stage.
#
# All time limits are multiplied by time_scale: a rehearsal may run beside other work.
time_scale=1

begin_stage() {
    stage=$1 log=$2/stage-$1.log summary=$2/stage-$1.tsv stage_start=$EPOCHREALTIME
    deadline=$((SECONDS + time_scale * $3)) failures=0 missing=0
    mkdir -p "$2" && : >"$log" && printf 'step\tstatus\tseconds\tnote\n' >"$summary"
}

# tell TEXT...: to the log and to standard output
tell() { printf '%s\n' "$*" | tee -a "$log"; }

seconds_since() { awk -v start="$1" -v end="$EPOCHREALTIME" 'BEGIN { printf "%.2f", end - start }'; }

# record STEP STATUS SECONDS NOTE
record() {
    printf '%s\t%s\t%s\t%s\n' "$1" "$2" "$3" "$4" >>"$summary"
    tell "@step	step=$1	status=$2	seconds=$3	note=$4"
    case $2 in
        ok) ;;
        missing) missing=$((missing + 1)) ;;
        *) failures=$((failures + 1)) ;;
    esac
}

# seconds_left: of the stage
seconds_left() { echo $((deadline - SECONDS)); }

step() {
    local name=$1 limit=$((time_scale * $2)) start=$EPOCHREALTIME code seconds
    shift 2
    if (($(seconds_left) < 1)); then
        record "$name" late 0 "the stage has no time left"
        return 1
    fi
    if ((limit > $(seconds_left))); then limit=$(seconds_left); fi
    tell "@begin	step=$name	limit=$limit	command=$*"
    timeout --kill-after=5 "$limit" "$@" </dev/null 2>&1 | tee -a "$log"
    code=${PIPESTATUS[0]}
    seconds=$(seconds_since "$start")
    # 137 is a kill: by timeout after a TERM that was ignored, or by the system.
    if ((code == 0)); then
        record "$name" ok "$seconds" ""
    elif ((code == 124)) || { ((code == 137)) && ((${seconds%.*} >= limit)); }; then
        record "$name" timeout "$seconds" "limit $limit s"
    elif ((code > 128)); then
        record "$name" crashed "$seconds" "signal $(kill -l $((code - 128)) 2>/dev/null || echo $((code - 128)))"
    else
        record "$name" failed "$seconds" "exit code $code"
    fi
    return "$code"
}

needs() {
    if command -v "$2" >/dev/null; then return 0; fi
    record "$1" missing 0 "no $2 on this machine"
    return 1
}

end_stage() {
    local status=passed
    if ((failures > 0)); then status=failed; fi
    printf 'stage\t%s\t%s\t%s\n' "$status" "$(seconds_since "$stage_start")" "$failures failed, $missing missing" >>"$summary"
    cat "$summary"
    [[ $status == passed ]]
}
