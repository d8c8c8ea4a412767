#!/usr/bin/env bash
# check_size.sh NM SIZE PROGRAM TABLE: the kernels of pictures that a build compiles for the CPU and the bytes of machine code in the program may
# each grow by at most a fifth over the values of TABLE: they are the time of a build, which no test can measure on a busy machine. Prints
# what it found; exits 1 if there is more.
set -euo pipefail
nm=$1 size=$2 program=$3 table=$4

# stated NAME: the value of a line "NAME VALUE" of the table
stated() {
    local value
    value=$(awk -v name="$1" '$1 == name { print $2 }' "$table")
    [[ $value =~ ^[0-9]+$ ]] || { echo "$table: expected a line '$1 NUMBER', got '$value'" >&2; exit 1; }
    echo "$value"
}

# Of pictures: the other kernels are few and small.
kernels=$("$nm" -C "$program" | grep -cE ' [A-Za-z] pl::PassCountersOf<.*> pl::run_picture_pass<.*\(pl::PicturePass const&\)$' || true)
bytes=$("$size" -A "$program" | awk '$1 == ".text" { print $2 }')
echo "kernels $kernels (stated: $(stated kernels))"
echo "bytes $bytes (stated: $(stated bytes))"
status=0
for found in "kernels $kernels" "bytes $bytes"; do
    read -r name value <<<"$found"
    most=$(($(stated "$name") * 6 / 5))
    if ((value > most)); then
        echo "$name: expected at most $most, got $value"
        status=1
    fi
    if ((value == 0)); then
        echo "$name: expected some, got none"
        status=1
    fi
done
exit $status
