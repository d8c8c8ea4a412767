#!/usr/bin/env bash
# pack_for_device.sh [--build FOLDER] [--output FILE] [--no-variants]: makes build/kit.tar.xz, all that a machine with a GPU needs to run
# run_on_device.sh, below 64 MiB: programs for sm_90 with line information, stripped; the same programs with the host stand-in; the
# shared libraries of both, found by RPATH, except the C library's and the compiler's; scenes; scripts; variants of the
# kernels (variants.txt). FOLDER is a build folder, made if it is not there; default build/kit. Needs nvcc and patchelf.
# Exit code: 0 packed, 1 a build failed or the archive is too large, 2 usage, 4 no nvcc or patchelf.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
here=$root/tests/parity
most_bytes=$((64 * 1024 * 1024))

build=$root/build/kit output=$root/build/kit.tar.xz with_variants=yes
while (($#)); do
    case $1 in
        --build) build=$(realpath -m "${2:?}"); shift ;;
        --output) output=$(realpath -m "${2:?}"); shift ;;
        --no-variants) with_variants= ;;
        *) sed -n '2,7p' "${BASH_SOURCE[0]}" | sed 's/^# \{0,1\}//' >&2; exit 2 ;;
    esac
    shift
done
command -v patchelf >/dev/null || { echo "pack_for_device.sh: no patchelf; apt-get install patchelf" >&2; exit 4; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
kit=$work/kit
mkdir -p "$kit"/{lib,standin,assets}

compared=(compare_backends cuda_bench)
programs=("${compared[@]}" device_parity kernel_times)

# variants: the lines of variants.txt
variants() { grep -E '^[a-z]' "$here/variants.txt" || true; }
# All variants share the build folder: what one of them sets is unset before the next.
read -ra unset <<<"$(variants | grep -oE -- '-D[A-Za-z0-9_]+' | sort -u | sed 's/^-D/-U/' | tr '\n' ' ')"

# make_programs CMAKE_OPTIONS -- TARGET...: configures the build folder for the device and builds targets
make_programs() {
    local options=()
    while [[ $1 != -- ]]; do
        options+=("$1")
        shift
    done
    shift
    cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_UNITY_BUILD=ON -DPL_TESTS=ON -DPL_MPI=OFF -DPL_CUDA=ON \
        -DCMAKE_CUDA_ARCHITECTURES=90-real -DPL_CUDA_LINE_INFO=ON "${unset[@]}" "${options[@]}" --log-level=WARNING \
        >"$work/log" 2>&1 || { cat "$work/log" >&2; exit 1; }
    cmake --build "$build" --target "$@" >"$work/log" 2>&1 || { cat "$work/log" >&2; exit 1; }
}

# install_program FROM FOLDER LIB: a stripped copy, which finds libraries in LIB, relative to its folder
install_program() {
    local copy
    copy=$2/$(basename "$1")
    strip -o "$copy" "$1"
    patchelf --force-rpath --set-rpath "\$ORIGIN/$3" "$copy"
}

# Libraries that every machine of the same processor has, in versions that fit its C library and its compiler.
of_the_system='linux-vdso|ld-linux|libc\.|libm\.|libpthread\.|libdl\.|librt\.|libresolv\.|libstdc\+\+\.|libgcc_s\.'

# install_libraries PROGRAM...: copies what they load; RPATH, unlike RUNPATH, holds for libraries of libraries too.
install_libraries() {
    local library
    ldd "$@" | awk '$2 == "=>" { print $3 }' | sort -u | grep -vE "/($of_the_system)" | while read -r library; do
        cp -L "$library" "$kit/lib/"
        patchelf --force-rpath --set-rpath "\$ORIGIN" "$kit/lib/$(basename "$library")"
    done
}

if [[ -n $with_variants ]]; then
    while read -r name options; do
        echo "variant $name: $options"
        read -ra options <<<"$options"
        make_programs "${options[@]}" -- "${compared[@]}"
        mkdir -p "$kit/variants/$name"
        for program in "${compared[@]}"; do
            install_program "$build/kit/$program" "$kit/variants/$name" ../../lib
        done
    done < <(variants)
fi
make_programs -- pathlight pathlight_on_host "${programs[@]}" "${programs[@]/%/_on_host}"
install_program "$build/pathlight" "$kit" lib
install_program "$build/kit/standin/pathlight_on_host" "$kit/standin" ../lib
for program in "${programs[@]}"; do
    install_program "$build/kit/$program" "$kit" lib
    install_program "$build/kit/standin/${program}_on_host" "$kit/standin" ../lib
done
install_libraries "$build/pathlight" "${programs[@]/#/$build/kit/}"
cp -r "$root/assets/scenes" "$kit/assets/"
cp "$here"/{run_on_device.sh,steps.sh,check_libraries.sh,time_switches.sh,device_tables.py} "$kit/"
{
    echo "commit=$(git -C "$root" rev-parse HEAD)$(git -C "$root" diff --quiet HEAD || echo ' with changes')"
    nvcc=$(sed -n 's/^CMAKE_CUDA_COMPILER:[A-Z]*=//p' "$build/CMakeCache.txt")
    echo "nvcc=$("$nvcc" --version | sed -n 's/.*release \([0-9.]*\),.*/\1/p')"
} >"$kit/KIT"
# A dictionary as large as the archive: the programs have the same device code.
tar -C "$work" --sort=name --owner=0 --group=0 --mtime=@0 -cf - kit | xz --lzma2=preset=3,dict=512MiB >"$output"

bytes=$(stat -c %s "$output")
echo "$output: $((bytes / 1024)) KiB, $(find "$kit/lib" -type f | wc -l) libraries, unpacked $(du -sm "$kit" | cut -f1) MiB"
if ((bytes >= most_bytes)); then
    echo "pack_for_device.sh: $output: expected less than $most_bytes bytes, got $bytes" >&2
    exit 1
fi
