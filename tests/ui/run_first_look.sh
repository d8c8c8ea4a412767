#!/usr/bin/env bash
# run_first_look.sh FOLDER SCRIPTS PROGRAM: a first start without options, a second one, and a first one with a scene of the user's own.
# Passes if each shows what it should.
set -u
folder=$1 scripts=$2 program=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder" || exit 2

"$program" --remember "$folder/home" --window 1280x720 --script "$scripts/first_look.script" || exit 1
[[ -f $folder/home/viewer.json ]] || { echo "nothing is remembered"; exit 1; }
"$program" --remember "$folder/home" --window 1280x720 --script "$scripts/second_look.script" || exit 1
"$program" view cornell --remember "$folder/other" --window 1280x720 --script "$scripts/second_look.script" || exit 1
