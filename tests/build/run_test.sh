#!/usr/bin/env bash
# run_test.sh ROOT: what ./run decides, tells and passes on. It runs in a folder of its own, where cmake, ninja, ctest, nvcc and nvidia-smi
# are stand-ins that write down how they were called.
set -u
source=$(realpath "$1")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failures=0
export CALLS="$work/calls" PLAN="$work/plan" OUTPUT="$work/output" GPU="$work/gpu"
unset CI DISPLAY WAYLAND_DISPLAY SDL_VIDEODRIVER

fake() { printf '#!/usr/bin/env bash\n%s\n' "$2" >"$work/bin/$1" && chmod +x "$work/bin/$1"; }
mkdir "$work/bin"
fake cmake 'echo "cmake $*" >>"$CALLS"
if [[ $1 == --build ]]; then bash "$OUTPUT"; exit; fi
mkdir -p build/release
touch build/release/build.ninja
printf "%s\n" "#!/bin/sh" "echo \"pathlight: \$*\"" >build/release/pathlight
chmod +x build/release/pathlight'
fake ninja 'cat "$PLAN"'
fake ctest 'echo "ctest $*" >>"$CALLS"'
fake nvcc ''
fake nvidia-smi '[[ -e $GPU ]]'
export PATH="$work/bin:$PATH"

# start ARGUMENTS: runs the script; its output is in $out and $err, the calls of the stand-ins in $calls.
start() {
    : >"$CALLS"
    "$work/root/run" "$@" >"$work/out" 2>"$work/err" </dev/null
    code=$?
    out=$(<"$work/out") err=$(<"$work/err") calls=$(<"$CALLS")
}
fresh() {
    rm -rf "$work/root" "$GPU"
    mkdir "$work/root"
    cp "$source/run" "$source/CMakePresets.json" "$work/root"
    echo 'ninja: no work to do.' >"$PLAN"
    : >"$OUTPUT"
}
# expect WORDS TEXT, refuse WORDS TEXT: TEXT contains WORDS, or does not.
fail() {
    printf 'FAILED at line %s: %s\ncode %s\nout: %s\nerr: %s\ncalls: %s\n\n' "${BASH_LINENO[1]}" "$1" "$code" "$out" "$err" "$calls"
    failures=$((failures + 1))
}
expect() { [[ $2 == *"$1"* ]] || fail "expected '$1'"; }
refuse() { [[ $2 != *"$1"* ]] || fail "did not expect '$1'"; }
expect_code() { [[ $code == "$1" ]] || fail "expected code $1"; }

# Help at once: nothing is installed, configured or built.
for word in -h --help; do
    fresh
    start "$word"
    expect_code 0
    expect './run -- --help' "$out"
    expect '--with cuda' "$out"
    [[ -z $calls && ! -e $work/root/build ]] || fail 'expected that nothing was done'
done

# Arguments go to the program.
fresh
start --no-install render door -o x.png
expect_code 0
expect 'pathlight: render door -o x.png' "$out"
start --no-install -- --help
expect 'pathlight: --help' "$out"
[[ -z $calls ]] || fail 'expected that a second start configures and builds nothing'
start --no-install
expect 'pathlight: render cornell -o cornell.png' "$out"

# Device code: for a GPU that is here, or where it is asked for; what was asked for once stays.
if [[ ! -e /dev/nvidia0 ]]; then
    fresh
    start --no-install info
    expect '-DPL_CUDA=OFF' "$calls"
    expect './run --with cuda' "$err"
    start --no-install info
    refuse './run --with cuda' "$err"
    start --no-install --with mpi --with cuda info
    expect '-DPL_CUDA=ON' "$calls"
    expect '-DPL_MPI=ON' "$calls"
    start --no-install info
    [[ -z $calls ]] || fail 'expected the build that was asked for'
    expect 'pathlight: info' "$out"
fi
fresh
touch "$GPU"
start --no-install info
expect '-DPL_CUDA=AUTO -UCMAKE_CUDA_ARCHITECTURES' "$calls"
refuse '--with cuda' "$err"
fresh
start --no-install --with opengl
expect_code 2
expect "expected cuda, mpi or python, got 'opengl'" "$err"

# A second start waits for the build of the first, and the program does not hold the lock.
fresh
mkdir -p "$work/root/build"
flock "$work/root/build/.lock" sleep 2 &
while flock -n "$work/root/build/.lock" true; do sleep 0.05; done
start --no-install info
expect_code 0
expect 'Another ./run builds here: waiting for it' "$err"
expect 'pathlight: info' "$out"
wait
printf '%s\n' '#!/bin/sh' "flock -n $work/root/build/.lock echo 'not held'" >"$work/root/build/release/pathlight"
start --no-install info
expect 'not held' "$out"
refuse 'Another ./run' "$err"

# The Python module is made of the program's objects, for an environment that has what it takes; the tests have it, too.
fresh
start --no-install --with python info
expect_code 4
expect 'build/venv lacks nanobind, numpy or pytest' "$err"
fresh
mkdir -p "$work"/root/build/venv/{bin,nanobind,numpy,pytest}
printf '%s\n' '#!/bin/sh' "echo \"$work/root/build/venv\"" >"$work/root/build/venv/bin/python"
chmod +x "$work/root/build/venv/bin/python"
start --no-install --with python info
expect_code 0
expect '-DPL_PYTHON=ON' "$calls"
refuse "-B $work/root/build/module" "$calls"
[[ $(<"$work/root/build/venv/pathlight.pth") == "$work/root/build/release/python" ]] || fail 'expected the path of the module'
expect 'pathlight: info' "$out"
start --no-install info
[[ -z $calls ]] || fail 'expected that a second start configures and builds nothing'
start --no-install test
expect '-DPL_PYTHON=ON' "$calls"

# Tests compile device code wherever nvcc is, in continuous integration for one architecture; a start after them keeps it.
fresh
CI=1 start --no-install test
expect '-DPL_CUDA=AUTO -DPL_TESTS=ON -DPL_WERROR=ON -DCMAKE_CUDA_ARCHITECTURES=90' "$calls"
expect 'ctest --test-dir' "$calls"
start --no-install info
refuse '-DPL_CUDA=OFF' "$calls"
fresh
start --no-install --with cuda test
expect '-DPL_CUDA=ON -DPL_TESTS=ON' "$calls"

# A build without a terminal: how long it takes, where it is, and errors in full.
fresh
for ((step = 1; step <= 100; ++step)); do echo "[$step/100] Building CXX object $step.o"; done >"$PLAN"
cat >"$OUTPUT" <<'END'
echo '[1/100] Building CXX object 1.o'
sleep 11
echo '[37/100] Building CXX object 37.o'
echo 'FAILED: 38.o'
echo 'a.cpp:1: error: x'
echo '    1 | x'
echo 'ninja: build stopped: subcommand failed.'
exit 1
END
start --no-install info
expect_code 1
expect 'Building: 100 steps, about ' "$err"
expect ' min on ' "$err"
expect $'\n[1/100]\n' "$err"
expect $'FAILED: 38.o\na.cpp:1: error: x\n    1 | x\nninja: build stopped: subcommand failed.\nrun: the build failed' "$err"
refuse 'Building CXX object' "$err"
refuse 'pathlight:' "$out"
exit $((failures > 0))
