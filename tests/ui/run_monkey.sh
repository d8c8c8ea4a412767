#!/usr/bin/env bash
# run_monkey.sh FOLDER SEED BLOCKS SIZE PROGRAM ARGUMENTS...: random input in the real window, a hundred events per block.
# After each block Esc closes everything that is open and shows hidden panels, Home and a menu bring back camera and layout.
# Passes if nothing crashes and the window can be used again after every block.
set -u
folder=$1 seed=$2 blocks=$3 size=$4
shift 4
mkdir -p "$folder" && cd "$folder" || exit 2

# block NUMBER FIRST_FRAME: the commands of one block.
block() {
    local frame=$2
    echo "$((frame++)) monkey $((seed * 1000 + $1)) 100"
    for _ in {1..12}; do echo "$((frame++)) tap Escape"; done
    echo "$frame wait busy == no"
    for _ in {1..12}; do echo "$((frame++)) tap Escape"; done
    for closed in "dialog == no" "help == no" "list == closed" "selftest_shown == no" "tour == off" "volume == -1" \
        "compare == off" "making == no" "searching == no" "tracing_pixels == no" "panels == yes" "state != failed"; do
        echo "$frame expect $closed"
    done
    echo "$((frame++)) wait busy == no"
    # A scene that was on its way may have arrived, and its camera with it.
    # Of a zoomed picture Home shows all, then the scene's own camera.
    echo "$((frame++)) tap Home"
    echo "$((frame++)) tap Home"
    echo "$((frame++)) wait moving == no"
    echo "$((frame++)) expect at_home == yes"
    # Random input may change the text size: only wide bars have this menu for sure.
    if ((${size%x*} < 1280)); then
        echo "$((frame++)) tap F3 ctrl"
        frame=$((frame + 2))
    else
        for control in "menu Window" "reset the window, and forget what is remembered of it"; do
            echo "$((frame++)) aim_at 0.5 0.5 $control"
            echo "$((frame++)) down left"
            echo "$((frame++)) up left"
            frame=$((frame + 2))
        done
    fi
    for open in settings_panel right_side tabs; do echo "$frame expect $open == yes"; done
    echo "$((frame++)) resize ${size/x/ }"
    echo "$frame wait shown_spp >= 1"
}
{
    echo "0 wait spp >= 1"
    for ((i = 0; i < blocks; ++i)); do block "$i" $((1 + 100 * i)); done
    echo "$((1 + 100 * blocks)) quit"
} >monkey.script
exec "$@" --window "$size" --script monkey.script
