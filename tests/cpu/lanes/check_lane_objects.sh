#!/usr/bin/env bash
# check_lane_objects.sh NM OBJECT;OBJECT...: files compiled for one instruction set must not define symbols that the
# linker may take for the whole program (weak or unique ones): the copy it keeps could be one that this machine cannot
# run. Prints each and exits 1 if there is any.
set -u
nm=$1
IFS=';' read -ra objects <<<"$2"

if [[ ${#objects[@]} -eq 0 ]]; then
    echo "no objects given"
    exit 1
fi
status=0
for object in "${objects[@]}"; do
    symbols=$("$nm" -C --defined-only "$object") || exit 1
    if [[ $symbols != *kLaneKernels* ]]; then
        echo "$object: expected it to define its kernels, found none"
        status=1
    fi
    shared=$(grep -E '^[0-9a-f]* +[VvWwu] ' <<<"$symbols") && {
        printf '%s shares:\n%s\n' "$object" "$shared"
        status=1
    }
done
exit $status
