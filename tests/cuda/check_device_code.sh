#!/usr/bin/env bash
# check_device_code.sh NVCC ROOT quick|all|machine|--write: rules for the compiled device code, checked without a device.
#   - no contraction: not one fused multiply-add, so that a hit is the same on every back end; the box tests, which are only
#     bounds, have theirs by the rounding down that no contraction has, twice as many as a traversal has double operations
#   - no float is summed by atomics, whose order is another in each run
#   - no exponential or logarithm of the device in kernels that trace paths: its bits differ from the host's
#   - double arithmetic only in the exact edge test of triangles, once per ray that is traced and traversal (small scenes have one of
#     their own)
#   - stacks of the kernels that trace paths of at most 1024 bytes, 512 without lobes and images
#   - an effect that a set lacks has no code in its kernels: no shadow ray, no random numbers, no normals
#   - default path tracing has no code for learning
#   - registers, stack and spills of every kernel as in kernels.sm_90.txt, and the counts of instructions in its machine code
#     as in machine_code.sm_90.txt, if nvcc is the version named there; --write writes these files anew
# quick: only the kernels that compile quickly, for every push; machine: the machine code of these alone. Machine code needs a
# disassembler: $PL_NVDISASM, nvdisasm beside nvcc or on the path, or the one of get_disassembler.sh. Without one, machine exits with
# 77, and the other modes say that they leave it out.
set -euo pipefail
nvcc=$1
root=$2
mode=$3
table=$root/tests/cuda/kernels.sm_90.txt
machine_table=$root/tests/cuda/machine_code.sm_90.txt
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Entries of core/kernel/methods/method_list.h, in its order.
entries=(default precomputed reinforcement sarsa monte_carlo network)

# source NAME: the file of a kernel; pictures have one per entry
source_of() {
    local entry
    for entry in "${!entries[@]}"; do
        [[ ${entries[entry]} == "$1" ]] || continue
        printf '#define PL_METHOD_ENTRY %d\n#include "cuda/kernels/picture_kernels.cuh"\n' "$entry" >"$work/$1.cu"
        echo "$work/$1.cu"
        return
    done
    echo "$root/cuda/kernels/$1.cu"
}

# disassembler: its path; fails if there is none
disassembler() {
    local place
    for place in "${PL_NVDISASM-}" "$(dirname "$nvcc")/nvdisasm" "$root/build/tools/nvdisasm" "$(command -v nvdisasm)"; do
        if [[ -n $place && -x $place ]]; then
            echo "$place"
            return
        fi
    done
    echo "machine code not read: no nvdisasm; tests/cuda/get_disassembler.sh fetches one" >&2
    return 1
}

compile() {
    "$nvcc" -std=c++20 -O3 -DNDEBUG -fmad=false --expt-relaxed-constexpr -diag-suppress=20012,445 -I"$root" \
        -arch=sm_90 -cubin -Xptxas -v --keep --keep-dir "$work" -o "$work/$1.cubin" "$(source_of "$1")" \
        2>"$work/$1.log" || { cat "$work/$1.log"; exit 1; }
}
case $mode in
quick | machine) pictures=(default) learners=() others=(film update) ;;
all | --write)
    pictures=(default precomputed reinforcement)
    learners=(sarsa monte_carlo probe_kernels network)
    others=(views film update)
    ;;
*) echo "mode: expected quick, all, machine or --write, got '$mode'" >&2; exit 2 ;;
esac
paths=("${pictures[@]}" "${learners[@]}")
files=("${paths[@]}" "${others[@]}")
disassembler=$(disassembler) || disassembler=
if [[ $mode == machine && -z $disassembler ]]; then exit 77; fi
for file in "${files[@]}"; do compile "$file"; done

failures=0
# expect WHAT A OPERATOR B
expect() {
    if ! [ "$2" "$3" "$4" ]; then
        echo "FAILED: $1: expected $2 $3 $4"
        failures=$((failures + 1))
    fi
}
# kernel FILE BITS: the PTX of the kernel of this file for one set of effects
kernel() { awk -v tag="ILj$2E" '/\.entry /{inside = index($0, tag) > 0} inside' "$work/$1.ptx"; }
# count FILE BITS PATTERN: in how many lines it occurs
count() { kernel "$1" "$2" | grep -cE -- "$3" || true; }

kernel_names='trace_paths|show_view|refine_film|mark_borders|volume_values|gather_records|add_samples|set_samples|read_film|read_halves|show_film|largest_value|run_step'
step_names='absorb_samples|update_means|weigh_row|build_row_choice|absorb_light_samples|move_mixture|move_reach|build_row'
# Of a mangled name in text: kernel and its set or step.
name_functions='
    function part(text, names) { return match(text, names) ? substr(text, RSTART, RLENGTH) : "-" }
    function name_kernel(text) {
        name = part(text, kernel_names)
        set = part(text, "ILj[0-9]+E")
        gsub(/[^0-9-]/, "", set)
        if (name == "run_step") set = part(text, step_names)
    }'

# registers FILE: kernel, its set or step, registers, stack frame, bytes of spill stores and loads
registers() {
    awk -v file="$1" -v kernel_names="$kernel_names" -v step_names="$step_names" "$name_functions"'
        /Compiling entry function/ { name_kernel($0) }
        /bytes stack frame/ { stack = $1; spills = $5 + $9 }
        /Used [0-9]+ registers/ {
            registers = part($0, "Used [0-9]+")
            sub("Used ", "", registers)
            printf "%-19s %-14s %-16s %9d %6d %6d\n", file, name, set, registers, stack, spills
        }' "$work/$1.log"
}
# machine_code FILE: kernel, its set or step, and how many instructions it has of some kinds: loads by bits (ld16: 16 or fewer) except
# loads of the stack, of these the generic ones, which look up their address space; loads and stores of the stack; votes, shuffles,
# matches of lanes; atomics with and without a result
machine_code() {
    "$disassembler" -c "$work/$1.cubin" | awk -v file="$1" -v kernel_names="$kernel_names" -v step_names="$step_names" "$name_functions"'
        function count(kind) { ++counts[kind] }
        function finish() {
            if (name == "") return
            printf "%-19s %-14s %-20s", file, name, set
            for (i = 1; i <= kinds; ++i) printf kind_names[i] == "generic" ? " %7d" : " %6d", counts[kind_names[i]]
            print ""
            split("", counts)
        }
        BEGIN { kinds = split("all ld128 ld64 ld32 ld16 generic ldl stl vote shfl match atom red", kind_names, " ") }
        /^\t\.section\t\.text\./ { finish(); name_kernel($0); next }
        match($0, /^ +\/\*[0-9a-f]+\*\/ +/) {
            count("all")
            instruction = substr($0, RLENGTH + 1)
            sub(/^@!?U?P[0-9T]+ +/, "", instruction)
            sub(/[ ;].*/, "", instruction)
            if (instruction ~ /^LDG?\./) {
                if (instruction ~ /\.128/) count("ld128")
                else if (instruction ~ /\.64/) count("ld64")
                else if (instruction ~ /\.[US](8|16)/) count("ld16")
                else count("ld32")
                if (instruction ~ /^LD\./) count("generic")
            }
            else if (instruction ~ /^LDL/) count("ldl")
            else if (instruction ~ /^STL/) count("stl")
            else if (instruction ~ /^VOTE/) count("vote")
            else if (instruction ~ /^SHFL/) count("shfl")
            else if (instruction ~ /^MATCH/) count("match")
            else if (instruction ~ /^ATOM/) count("atom")
            else if (instruction ~ /^RED/) count("red")
        }
        END { finish() }'
}

# compare TABLE FUNCTION TITLE: the rows of FUNCTION for all files against the rows of TABLE; --write replaces it
compare() {
    {
        echo "# nvcc $("$nvcc" --version | sed -n 's/.*release \([0-9.]*\),.*/\1/p'), sm_90. Made by check_device_code.sh --write"
        echo "$3"
        local file
        for file in "${files[@]}"; do "$2" "$file" | sort; done
    } >"$work/table"
    if [[ $mode == --write ]]; then
        cp "$work/table" "$1"
    elif [[ $(head -1 "$1") == "$(head -1 "$work/table")" ]]; then
        awk -v files="${files[*]}" 'NR <= 2 || index(" " files " ", " " $1 " ")' "$1" >"$work/expected"
        diff "$work/expected" "$work/table" || { echo "FAILED: kernels differ from $1"; failures=$((failures + 1)); }
    else
        echo "$(basename "$1") not compared: the table is for another nvcc"
    fi
}

machine_head=$(printf '%-19s %-14s %-20s %6s %6s %6s %6s %6s %7s %6s %6s %6s %6s %6s %6s %6s' file kernel 'effects or step' all ld128 \
    ld64 ld32 ld16 generic ldl stl vote shfl match atom red)
if [[ -n $disassembler ]]; then compare "$machine_table" machine_code "$machine_head"; fi
if [[ $mode == machine ]]; then exit $((failures > 0)); fi

for file in "${files[@]}"; do
    expect "fused multiply-adds in $file" "$(grep 'fma\.' "$work/$file.ptx" | grep -vc 'fma\.rm\.f32' || true)" -eq 0
    expect "atomic sums of floats in $file" "$(grep -cE '(^|[[:space:]])(atom|red)[a-z0-9_.]*\.b?f(16|32|64)' "$work/$file.ptx" || true)" -eq 0
done
# Sets: 0 nothing, 4 light samples, 7 smooth normals and environment too, 1351 images and many lights too, 63 lobes instead, 131071 all
# but instances, 524287 all. Philox' key schedule and its first multiplier count the draws; doubles count the traversals; rounding down
# only images and maps need. Smooth normals are recognized by their square roots: the rest of their code is less than the difference of
# two compilations.
measure() {
    local file=$1 bits
    shift
    size=() draws=() doubles=() floors=() roots=() boxes=()
    for bits in "$@"; do
        size[bits]=$(kernel "$file" "$bits" | grep -cE $'^\t(@!?%p[0-9]+ )?[a-z]')
        draws[bits]=$(count "$file" "$bits" '-766435501|3528531795')
        doubles[bits]=$(count "$file" "$bits" '(add|sub|mul|div|sqrt)[a-z.]*\.f64')
        roots[bits]=$(count "$file" "$bits" 'sqrt\.')
        boxes[bits]=$(count "$file" "$bits" 'fma\.rm\.f32')
        floors[bits]=$(count "$file" "$bits" 'cvt\.rmi\.')
    done
}
for file in "${pictures[@]}"; do
    measure "$file" 0 4 7 63 1351 131071 524287
    expect "$file: instructions without and with light samples" "${size[0]}" -lt "${size[4]}"
    expect "$file: roots without and with normals and environment" "${roots[4]}" -lt "${roots[7]}"
    expect "$file: instructions without and with lobes" "${size[7]}" -lt "${size[63]}"
    expect "$file: instructions with lobes and all effects but instances" "${size[63]}" -lt "${size[131071]}"
    expect "$file: instructions with images and all effects but instances" "${size[1351]}" -lt "${size[131071]}"
    expect "$file: instructions without and with instances" "${size[131071]}" -lt "${size[524287]}"
    expect "$file: random numbers without and with light samples" "${draws[0]}" -lt "${draws[4]}"
    expect "$file: random numbers for normals and environment" "${draws[4]}" -eq "${draws[7]}"
    expect "$file: random numbers without and with lobes" "${draws[7]}" -lt "${draws[63]}"
    expect "$file: double operations without and with shadow rays" "$((2 * doubles[0]))" -eq "${doubles[4]}"
    expect "$file: double operations for one ray" "${doubles[0]}" -le 18
    expect "$file: double operations for normals, environment and lobes" "${doubles[4]}" -eq "${doubles[63]}"
    expect "$file: roundings down without images" "${floors[63]}" -eq "${floors[0]}"
    expect "$file: roundings down with images" "${floors[524287]}" -gt "${floors[63]}"
done
for file in "${learners[@]}"; do
    measure "$file" 7 524287
    expect "$file: instructions with some and all effects" "${size[7]}" -lt "${size[524287]}"
    expect "$file: double operations for two rays" "${doubles[7]}" -le 36
    expect "$file: roundings down without and with images" "${floors[7]}" -lt "${floors[524287]}"
done
for file in "${paths[@]}"; do
    measure "$file" 7
    expect "$file: fused operations of box tests" "${boxes[7]}" -eq "$((2 * doubles[7]))"
    expect "$file: exponentials and logarithms of the device" "$(grep -cE '(ex2|lg2)\.approx' "$work/$file.ptx" || true)" -eq 0
    # Planes of instances are made where rays meet them.
    expect "$file: double divisions and roots" "$(count "$file" 7 '(div|sqrt)[a-z.]*\.f64')" -eq 0
done

# most_stack FILE PATTERN: of the kernels that trace paths with these sets of effects
most_stack() { registers "$1" | awk -v sets="$2" '$2 == "trace_paths" && $3 ~ sets && $5 > most { most = $5 } END { print most + 0 }'; }
for file in "${paths[@]}"; do
    expect "$file: stack without lobes and images" "$(most_stack "$file" '^[047]$')" -le 512
    expect "$file: stack without instances" "$(most_stack "$file" '^([047]|63|1351|131071)$')" -le 1024
    expect "$file: stack" "$(most_stack "$file" .)" -le 1792
done

compare "$table" registers "$(printf '%-19s %-14s %-16s %9s %6s %6s' file kernel 'effects or step' registers stack spills)"
exit $((failures > 0))
