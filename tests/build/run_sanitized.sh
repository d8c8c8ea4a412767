#!/usr/bin/env bash
# run_sanitized.sh SOURCE BUILD: builds the program and the Python module with the address and undefined-behavior sanitizers in BUILD,
# renders every scene of the project by every method and representation, opens every file of the corpora, and runs the tests of the
# module. Fails at what the sanitizers find, at exit codes other than 0, and 3 for files, and at tests that fail.
set -euo pipefail
source=$1 build=$2

# The module has the program's objects. What its tests need comes from PyPI.
python=$build/venv/bin/python module=OFF targets=(pathlight)
if python3 -m venv "$build/venv" && "$python" -m pip -q --disable-pip-version-check install nanobind numpy pytest; then
    module=ON targets+=(pathlight_python)
else
    echo "the module is left out: no nanobind, numpy and pytest from PyPI"
fi

# Unity build: as few large sources as there can be, whose templates are compiled once.
cmake -S "$source" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_CXX_FLAGS_RELWITHDEBINFO="-O1 -g1" \
    -DCMAKE_UNITY_BUILD=ON -DPL_SANITIZE=address,undefined -DPL_CUDA=OFF -DPL_MPI=OFF -DPL_TESTS=OFF -DCMAKE_DISABLE_FIND_PACKAGE_SDL2=ON \
    -DPL_PYTHON=$module -DPython_EXECUTABLE="$python" >"$build.log" 2>&1 ||
    { cat "$build.log"; exit 1; }
cmake --build "$build" --target "${targets[@]}" -j 2 >>"$build.log" 2>&1 || { tail -50 "$build.log"; exit 1; }

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failed=0 runs=0

# run CODES ARGUMENTS...: the program must end with one of the codes.
run() {
    local codes=$1 code=0
    shift
    "$build/pathlight" "$@" >"$work/told" 2>&1 || code=$?
    runs=$((runs + 1))
    [[ " $codes " == *" $code "* ]] && return
    failed=$((failed + 1))
    echo "exit code $code: pathlight $*"
    tail -40 "$work/told"
}

# render CODES SCENE OPTIONS...
render() {
    local codes=$1
    shift
    run "$codes" render "$@" --backend cpu -o "$work/x.exr"
}

for folder in "$source"/assets/scenes/*/; do
    for way in default precomputed "reinforcement --field table" "reinforcement --field sd-tree" "reinforcement --field lobes" \
        "reinforcement --field neural"; do
        # shellcheck disable=SC2086
        render 0 "$(basename "$folder")" --size 32x32 --spp 4 --guiding always --method $way
    done
done

files() { find "$@" -type f -print0 | sort -z; }
corpus=$source/tests/fuzz/corpus
small=(--size 8x8 --spp 1)
while IFS= read -r -d '' file; do
    render "0 3" "$file" "${small[@]}"
done < <(files "$source"/tests/corpus/{accepted,refused} "$corpus"/{json,gltf,mitsuba} -not -name '*.mtl' -not -name '*.png')
while IFS= read -r -d '' file; do
    cp "$file" "$work/x.obj"
    render "0 3" "$work/x.obj" "${small[@]}"
done < <(files "$corpus/obj")
while IFS= read -r -d '' file; do
    kind=$(basename "$(dirname "$file")")
    cp "$file" "$work/mesh"
    echo "<scene version='3.0.0'><shape type='$kind'><string name='filename' value='mesh'/></shape></scene>" >"$work/x.xml"
    render "0 3" "$work/x.xml" "${small[@]}"
done < <(files "$corpus"/{ply,serialized})
while IFS= read -r -d '' file; do
    name=$(basename "$file")
    image=x.${name%%_*}
    cp "$file" "$work/$image"
    printf 'v -1 -1 0\nv 1 -1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nmtllib x.mtl\nusemtl a\nf 1/1 2/2 3/3\n' >"$work/x.obj"
    printf 'newmtl a\nmap_Kd %s\n' "$image" >"$work/x.mtl"
    render "0 3" "$work/x.obj" "${small[@]}"
    echo "{\"schema\": \"pathlight.scene/1\", \"obj\": \"x.obj\", \"environment\": {\"map\": \"$image\"}}" >"$work/x.json"
    render "0 3" "$work/x.json" "${small[@]}"
done < <(files "$corpus/image")
while IFS= read -r -d '' file; do
    render "0 3" cornell "${small[@]}" --load-field "$file"
done < <(files "$corpus/field")
while IFS= read -r -d '' file; do
    render "0 3" cornell "${small[@]}" --resume "$file"
done < <(files "$corpus/checkpoint")
echo "$runs runs, $failed failed"

# The interpreter is not sanitized: the sanitizers, and the exceptions that they watch, are loaded before it. What it keeps to its end are no
# leaks. Only other builds make the stub, by a module that needs no more than the interpreter.
if [[ $module == ON ]]; then
    LD_PRELOAD="$(c++ -print-file-name=libasan.so) $(c++ -print-file-name=libstdc++.so)" ASAN_OPTIONS=detect_leaks=0 \
        PYTHONMALLOC=malloc PYTHONPATH="$build/python" PATHLIGHT_PROGRAM="$build/pathlight" \
        "$python" -m pytest -q -k "not stub" "$source/tests/python" || failed=$((failed + 1))
fi
exit $((failed > 0))
