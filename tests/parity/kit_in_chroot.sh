#!/usr/bin/env bash
# kit_in_chroot.sh KIT.tar.xz [SUITE [MIRROR]]: unpacks a kit in a bare system of another distribution, by default noble, Ubuntu 24.04,
# and runs it there: all libraries are found, CUDA says that there is no device, and stage a passes by the stand-in. Needs root,
# debootstrap and the network; MIRROR is by default debootstrap's for the suite. The system stays in ${TMPDIR:-/tmp}/kit-SUITE
# for the next run. Exit code: 0 as expected, 1 not, 4 the system could not be made.
set -euo pipefail
kit=$(realpath "$1") suite=${2-noble} mirror=${3-}
system=${TMPDIR:-/tmp}/kit-$suite
if [[ ! -e $system/bin/bash ]]; then
    options=(--variant=minbase) script=$suite
    if [[ ! -e ${DEBOOTSTRAP_DIR:-/usr/share/debootstrap}/scripts/$suite ]]; then
        # Newer than this debootstrap: one of Ubuntu, all of which have one script, and whose keys other systems lack.
        options+=(--no-check-gpg) script=gutsy
    fi
    debootstrap "${options[@]}" "$suite" "$system" "$mirror" "$script" >"$system.log" 2>&1 || {
        tail -3 "$system.log" >&2
        rm -rf "$system"
        exit 4
    }
fi
rm -rf "$system/kit"
tar -C "$system" -xf "$kit"
cat >"$system/check" <<'CHECK'
set -u
cd /kit
problems=0
# expect CODE TEXT COMMAND...: its exit code, and a text in its output
expect() {
    local expected=$1 text=$2 output code
    shift 2
    output=$("$@" 2>&1)
    code=$?
    if [[ $code != "$expected" || $output != *"$text"* ]]; then
        printf 'FAILED: %s: expected exit code %s and "%s", got %s and\n%s\n' "$*" "$expected" "$text" "$code" "$output"
        problems=$((problems + 1))
    fi
}
no_device='no NVIDIA driver, or one older than this build'
expect 0 ' 0 with missing libraries' ./check_libraries.sh /kit
expect 0 ' 0 with missing libraries' ./check_libraries.sh /kit/standin
expect 0 'cpu    available' ./pathlight devices
expect 0 "$no_device" ./pathlight devices
expect 4 "$no_device" ./pathlight render cornell --backend cuda --size 8x8 --spp 1 -o /tmp/a.pfm
expect 0 '' ./pathlight render cornell --backend cpu --size 8x8 --spp 1 -o /tmp/a.pfm
for program in compare_backends cuda_bench kernel_times; do expect 4 "$no_device" ./$program; done
for variant in variants/*/; do
    [[ -d $variant ]] || continue
    for program in "$variant"*; do expect 4 "$no_device" "./$program"; done
done
expect 4 "no device" ./run_on_device.sh --stage a --results /tmp/results
expect 0 'passed' ./run_on_device.sh --stage a --results /tmp/rehearsal --rehearsal
((problems == 0)) && cat /tmp/rehearsal/stage-a.tsv
exit $((problems > 0))
CHECK
echo "system: $(sed -n 's/^PRETTY_NAME=//p' "$system/etc/os-release"), $(chroot "$system" ldd --version | head -1)"
exec unshare -m bash -c 'mount -t proc proc "$0/proc" && mount --bind /dev "$0/dev" && exec chroot "$0" bash /check' "$system"
