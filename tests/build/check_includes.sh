#!/usr/bin/env bash
# check_includes.sh ROOT: does every file keep to the arrows of the architecture? Prints each breach, exits 1 if any.
#   app -> ui -> core/session -> core/scene, core/fields -> core/kernel;  core/io -> core/scene, and learned_field.h
# and the words that core/kernel may not contain, since it is compiled for devices too.
set -u
cd "$1" || exit 2

breaches=0
breach() {
    printf '%s\n' "$*"
    breaches=$((breaches + 1))
}

# folder: the folders it may include with quotes. The longest matching folder rules; a name ending in .h is one file.
arrows='
core/kernel:  core/kernel
core/base:    core/base core/kernel/base
core/scene:   core/scene core/base core/kernel
core/fields:  core/fields core/scene core/base core/kernel
core/session: core/session core/scene core/fields core/base core/kernel
core/measure: core/measure core/session core/scene core/fields core/base core/kernel
core/io:      core/io core/session/learned_field.h core/scene core/base core/kernel
cpu:          cpu core/session/backend.h core/session/film_slots.h core/scene core/fields core/base core/kernel
cuda:         cuda core/session/backend.h core/session/film_slots.h core/scene core/fields core/base core/kernel
ui:           ui core/session core/measure core/scene core/fields core/base core/kernel
app:          app ui cpu cuda core
'

# <header pattern>: the only folders that may include it.
libraries='
SDL*:              ui
imgui*:            ui
CLI/*:             app
embree[34]/*:      cpu
omp.h:             cpu
cuda*:             cuda
tiny_obj_loader.h: core/io
tinyexr.h:         core/io
stb_*:             core/io
'

kernel_headers=' cstdint cmath concepts type_traits atomic limits bit '

# Where kernels may use double: sums over samples, and the edge functions that come out as zero in float, which the
# watertight triangle test has to decide exactly.
double_allowed='core/kernel/film core/kernel/geometry/triangle.h'

# within PATH FOLDER...: is PATH one of the folders or files, or below one?
within() {
    local path=$1 folder
    shift
    for folder in "$@"; do
        [[ $path == "$folder" || $path == "$folder"/* ]] && return 0
    done
    return 1
}

# check_quoted FILE:LINE FOLDER ALLOWED PATH
check_quoted() {
    [[ -f $4 ]] || breach "$1: \"$4\" is not a path from the root of the repository"
    # shellcheck disable=SC2086
    within "$4" $3 || breach "$1: $2 may not include \"$4\" (only: ${3# })"
}

# check_library FILE:LINE FILE HEADER
check_library() {
    local pattern owners
    if within "$2" core/kernel; then
        [[ $3 == glm/* || $kernel_headers == *" $3 "* ]] ||
            breach "$1: core/kernel may not include <$3> (only: <glm/...>$kernel_headers)"
        return
    fi
    while IFS=': ' read -r pattern owners; do
        # shellcheck disable=SC2053,SC2086
        if [[ -n $pattern && $3 == $pattern ]] && ! within "$2" $owners; then
            breach "$1: <$3> belongs in $owners"
        fi
    done <<<"$libraries"
}

check_includes() {
    local folder=$1 allowed=$2 file line text
    local pattern='^([^:]+):([0-9]+):[[:space:]]*#[[:space:]]*include[[:space:]]*([<"])([^>"]+)'
    while read -r text; do
        [[ $text =~ $pattern ]] || continue
        file=${BASH_REMATCH[1]} line=${BASH_REMATCH[2]}
        if [[ ${BASH_REMATCH[3]} == '"' ]]; then
            check_quoted "$file:$line" "$folder" "$allowed" "${BASH_REMATCH[4]}"
        else
            check_library "$file:$line" "$file" "${BASH_REMATCH[4]}"
        fi
    done <<<"$(grep -rnE '^[[:space:]]*#[[:space:]]*include' --include='*.h' --include='*.cpp' --include='*.cu' \
        --include='*.cuh' "$folder")"
}

# Words that have no place in device code; comments and strings are cut off first.
check_kernel_words() {
    local banned='\b(throw|try|catch|virtual|new|malloc|dynamic_cast|typeid)\b|\bdelete\b[^;]*[^; ]' file
    find core/kernel -name '*.h' | while read -r file; do
        local words=$banned
        # shellcheck disable=SC2086
        within "$file" $double_allowed || words+='|\bdouble\b'
        sed -E 's://.*$::; s:/\*.*\*/::g; s:"[^"]*":"":g' "$file" | grep -nE "$words" |
            while IFS= read -r text; do printf '%s:%s\n' "$file" "$text"; done
    done
}

while IFS=: read -r folder allowed; do
    [[ -n $folder && -d $folder ]] && check_includes "$folder" "$allowed"
done <<<"$arrows"

if [[ -d core/kernel ]]; then
    while IFS= read -r text; do
        [[ -n $text ]] && breach "$text  <- not in core/kernel (no allocation, exceptions, virtual calls; double only in: $double_allowed)"
    done <<<"$(check_kernel_words)"
fi

while IFS= read -r file; do
    [[ -n $file ]] && breach "$file: no #pragma once"
done <<<"$(find core cpu cuda ui app -name '*.h' -exec grep -L '^#pragma once' {} + 2>/dev/null)"

for folder in core/*/; do
    folder=${folder%/}
    [[ $arrows == *$'\n'"$folder:"* ]] || breach "$folder: no rule in check_includes.sh says what it may include"
done

((breaches == 0)) || {
    printf '%d breaches\n' "$breaches"
    exit 1
}
