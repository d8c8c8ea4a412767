#!/usr/bin/env bash
# window_place.sh PROGRAM OPENBOX: a window under a window manager with title bars, started and closed three times. Passes if it opens
# where it was closed, to the pixel.
set -u
program=$1
work=$(mktemp -d)
cd "$work" || exit 2
"$2" --startup "touch $work/managed" >/dev/null 2>&1 &
manager=$!
trap 'kill "$manager" 2>/dev/null; rm -rf "$work"' EXIT
# A window that is mapped while the manager starts may wait for ever.
for ((i = 0; i < 600; ++i)); do [[ -e managed ]] && break; sleep 0.1; done
[[ -e managed ]] || { echo "$2 has not started within a minute"; exit 2; }

# place: of the inside of the window, as it was remembered.
place() { python3 -c 'import json, sys; w = json.load(open(sys.argv[1]))["window"]; print(w["x"], w["y"], w["width"], w["height"])' \
    "$work/viewer.json"; }
# start: until the first picture, and a moment in which a window manager may move the window.
start() {
    printf '0 wait shown_spp >= 1\n60 quit\n' >quit.script
    "$program" view cornell --backend cpu --size 96x96 --remember "$work" --script quit.script || exit 1
}
cat >viewer.json <<'END'
{"schema": "pathlight.viewer/1", "window": {"x": 90, "y": 70, "width": 900, "height": 600, "maximized": false}}
END
first=$(place)
for run in 1 2 3; do
    start
    [[ $(place) == "$first" ]] || { echo "after run $run: $(place), expected $first"; exit 1; }
done
echo "the window stays at $first"
