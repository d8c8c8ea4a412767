#!/usr/bin/env bash
# wheel_test.sh ROOT BUILD PYTHON: a wheel of the module works in an environment of its own, away from the source: it brings its scenes,
# and passes the tests of the module, notebooks among them. Exit code 77, with words, where PyPI is not reached.
set -euo pipefail
root=$(realpath "$1") build=$(realpath "$2") python=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
unset PATHLIGHT_ASSETS PYTHONPATH
pip() { "$work/venv/bin/python" -m pip --disable-pip-version-check -q "$@"; }

"$python" -m venv "$work/venv"
pip install pytest matplotlib || { echo "skipped: no pytest and matplotlib from PyPI"; exit 77; }
began=$SECONDS
pip wheel "$root" --no-deps --wheel-dir "$work" --config-settings=build-dir="$build-wheel"
wheel=$(ls "$work"/*.whl)
echo "$(basename "$wheel"): $(stat -c %s "$wheel") bytes, $((SECONDS - began)) s"
pip install "$wheel"

# Scenes come from the wheel, not from the source: one of a name that the source lacks is found, by sessions and subcommands.
scenes=$("$work/venv/bin/python" -c 'import pathlib, pathlight; print(pathlib.Path(pathlight.__file__).parent / "assets/scenes")')
mkdir "$scenes/moved"
for suffix in json obj mtl; do cp "$scenes/cornell/cornell.$suffix" "$scenes/moved/moved.$suffix"; done
sed -i 's/cornell\.obj/moved.obj/' "$scenes/moved/moved.json"
sed -i 's/cornell\.mtl/moved.mtl/' "$scenes/moved/moved.obj"
cd "$work"
venv/bin/python -c 'import pathlight; pathlight.Scene("moved"); pathlight.run("info", "moved")'
rm -r "$scenes/moved"

mkdir -p tests docs
cp -r "$root/tests/python" tests/python
cp -r "$root/docs/notebooks" docs/notebooks
PATHLIGHT_PROGRAM="$build/pathlight" OMP_WAIT_POLICY=passive venv/bin/python -m pytest -q tests/python
