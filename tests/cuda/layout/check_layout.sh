#!/usr/bin/env bash
# check_layout.sh PRINT_LAYOUT NVCC ROOT: do the C++ compiler and the device compiler agree on every size, alignment and offset of
# what crosses to the device? PRINT_LAYOUT prints the numbers of the former, the PTX of device_layout.cu has the numbers of the latter.
set -euo pipefail
print_layout=$1 nvcc=$2 root=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$nvcc" -std=c++20 -O3 -DNDEBUG -fmad=false --expt-relaxed-constexpr -diag-suppress=20012,445 -I"$root" -arch=sm_90 -ptx \
    -o "$work/device.ptx" "$root/tests/cuda/layout/device_layout.cu"
# Stores are volatile: all are there, in order. Their values are constants, moved to registers before.
awk '
    $1 == "mov.u32" || $1 == "mov.b32" { gsub(/[,;]/, ""); value[$2] = $3 }
    $1 ~ /^st\.volatile/ {
        register = $NF
        sub(/;/, "", register)
        if (register !~ /^%/) print register
        else if (register in value && value[register] ~ /^[0-9]+$/) print value[register]
        else { print "not a constant: " $0; exit 1 }
    }' "$work/device.ptx" >"$work/device" || { tail -1 "$work/device"; exit 1; }
"$print_layout" >"$work/host"

# same FILE: whether the numbers of FILE, by the C++ compiler, equal the numbers of the device
same() { diff <(cut -f1 "$1") "$work/device" >/dev/null; }
if ! same "$work/host"; then
    echo "FAILED: layouts differ. C++ compiler, device compiler, what:"
    paste "$work/device" "$work/host" | awk -F '\t' '$1 != $2 { print $2 ", " $1 ", " $3 " (after " last ")" } $3 ~ /^size/ { last = $3 }' |
        head -20
    exit 1
fi
# A member at another place is noticed.
awk -F '\t' 'BEGIN { OFS = "\t" } /offset/ && ++count == 40 { $1 += 4 } 1' "$work/host" >"$work/moved"
if same "$work/moved"; then
    echo "FAILED: a member that was moved by 4 bytes was not noticed"
    exit 1
fi
echo "$(wc -l <"$work/host") numbers of $(grep -o 'size of .*' "$work/host" | sort -u | wc -l) types agree"
