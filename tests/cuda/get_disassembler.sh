#!/usr/bin/env bash
# get_disassembler.sh ROOT: fetches nvdisasm, the disassembler for check_device_code.sh, from PyPI into ROOT/build/tools, unless it is
# there. Exit code 4 if it cannot be had.
set -euo pipefail
tools=$(realpath "$1")/build/tools
if [[ -x $tools/nvdisasm ]]; then exit 0; fi
mkdir -p "$tools"
work=$(mktemp -d -p "$tools")
trap 'rm -rf "$work"' EXIT
python3 -m pip download --quiet --no-deps --retries 1 --timeout 30 --dest "$work" nvidia-cuda-nvdisasm >"$work/log" 2>&1 ||
    { tail -1 "$work/log" >&2; exit 4; }
python3 -m zipfile -e "$work"/nvidia_cuda_nvdisasm-*.whl "$work/wheel"
mv "$(find "$work/wheel" -type f -name nvdisasm)" "$tools/nvdisasm"
chmod +x "$tools/nvdisasm"
