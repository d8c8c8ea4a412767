#!/usr/bin/env bash
# run_script.sh FOLDER SCRIPT PROGRAM ARGUMENTS...: runs the viewer's script in an empty folder. Passes if the program
# exits with 0 and every picture that the script asks for is there as a PNG.
set -u
folder=$1 script=$2
shift 2
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder" || exit 2

"$@" --script "$script" || { echo "the viewer exited with $?"; exit 1; }
missing=0
while read -r file; do
    [[ $(head -c 4 "$file" 2>/dev/null | tail -c 3) == PNG ]] || { echo "no picture: $file"; missing=1; }
done < <(sed -nE 's/^[0-9]+ shot (.*)$/\1/p' "$script")
exit $missing
