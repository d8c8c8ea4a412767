#!/usr/bin/env bash
# picture_hashes.sh PATHLIGHT [JOBS]: prints a hash of every picture and learned field that decides whether a change of the code
# has changed a bit: all shipped scenes x methods x views, with and without light samples, all learning targets, and the fields
# after 16 passes. Compare two programs: diff <(picture_hashes.sh OLD) <(picture_hashes.sh NEW)
set -euo pipefail
program=$(realpath "$1")
jobs=${2:-2}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
assets=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../assets/scenes" && pwd)

scenes=()
for folder in "$assets"/*/; do scenes+=("$(basename "$folder")"); done
read -ra methods <<<"$("$program" render --list-methods | awk '{print $1}' | tr '\n' ' ')"
read -ra views <<<"$("$program" render --list-views | awk '{print $1}' | tr '\n' ' ')"

# hash NAME ARGUMENTS..: renders and prints "NAME hash"; the hash of a failure is its message
hash_picture() {
    local name=$1 out=$work/${1//[ \/]/_}
    shift
    if "$program" render "$@" --size 40x32 --threads 1 --no-progress -q -o "$out.pfm" >"$out.log" 2>&1; then
        printf '%s %s\n' "$name" "$(sha256sum <"$out.pfm" | cut -c1-16)"
    else
        printf '%s failed %s\n' "$name" "$(sha256sum <"$out.log" | cut -c1-16)"
    fi
    rm -f "$out.pfm" "$out.log"
}
# The field's numbers belong to the picture's passes; seconds in its header are left out by hashing the inspection.
hash_field() {
    local name=$1 out=$work/${1//[ \/]/_}
    shift
    "$program" render "$@" --spp 16 --size 40x32 --threads 1 --no-progress -q --save-field "$out.field" -o "$out.pfm" >/dev/null 2>&1
    printf '%s %s\n' "$name" "$(sha256sum <"$out.field" | cut -c1-16)"
    rm -f "$out.field" "$out.pfm"
}
export -f hash_picture hash_field
export program work

{
    for scene in "${scenes[@]}"; do
        for method in "${methods[@]}"; do
            for view in "${views[@]}"; do
                echo "hash_picture '$scene $method $view' $scene --method $method --view $view --nee off --spp 3"
            done
            echo "hash_picture '$scene $method beauty nee' $scene --method $method --nee on --spp 5"
        done
        for target in expected-sarsa sarsa monte-carlo; do
            for from in all indirect; do
                echo "hash_picture '$scene $target $from nee' $scene --method reinforcement --nee on --learn target=$target,from=$from --spp 4"
            done
            echo "hash_field '$scene field $target' $scene --method reinforcement --nee off --learn target=$target"
            echo "hash_field '$scene field $target nee' $scene --method reinforcement --nee on --learn target=$target"
        done
        for roulette in albedo off; do
            echo "hash_picture '$scene roulette $roulette' $scene --method reinforcement --nee off --roulette $roulette --spp 4"
        done
    done
} | xargs -P "$jobs" -d '\n' -n 1 bash -c 'eval "$0"' | sort
