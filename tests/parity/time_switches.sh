#!/usr/bin/env bash
# time_switches.sh PATHLIGHT FOLDER: switches between CPU and CUDA in the viewer, twelve times to and fro, on SDL's dummy driver.
# Prints percentiles of the frames, and a record "@switch" for each switch (record.h): milliseconds from the key to the first frame
# of the other back end.
set -euo pipefail
script=$2/switches.script trace=$2/switches.jsonl frame=60
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
SDL_VIDEODRIVER=dummy "$1" view cornell --backend cpu --method reinforcement --size "${SWITCH_SIZE:-1280x720}" --script "$script" \
    --ui-trace "$trace"
sed -n 's/.*"event":"switch".*"latency_ms":\([0-9.]*\).*/@switch\tms=\1/p' "$trace"
measured=$(grep -c '"event":"switch"' "$trace")
((measured == 12)) || { echo "expected 12 switches in the trace, got $measured" >&2; exit 1; }
