#!/usr/bin/env bash
# check_includes.sh ROOT: does every file keep to the arrows of the architecture? Prints each breach, exits 1 if any.
#   python -> app -> ui -> core/bench, core/selftest, core/diagnose, core/inspect -> core/session -> core/scene, core/fields -> core/kernel;
#   core/io -> core/scene, and the records of a session that it writes;
# and the order of the folders inside app, ui, cpu, core and core/kernel. Also checks what core/kernel may not contain, since
# it is compiled for devices too.
set -u
cd "$1" || exit 2

breaches=0
breach() {
    printf '%s\n' "$*"
    breaches=$((breaches + 1))
}

# NAME: the files that NAME may include with quotes, besides its own. NAME is a folder or a file; the longest NAME that
# matches a path governs it. An item is the NAME of another rule: the files that it governs; a file; or a folder with a
# slash at its end: everything below it. Every list names only rules further up, so that there is no circle.
shading_data='core/kernel/shading/delta_lights.h core/kernel/shading/environment_map.h core/kernel/shading/far_lights.h core/kernel/shading/light_tree.h
    core/kernel/shading/material.h core/kernel/shading/surface_lobes.h'
kernel_data="core/kernel/base core/kernel/geometry $shading_data"
kernel_scene="$kernel_data core/kernel/scene core/kernel/geometry/intersector.h core/kernel/shading"
below_session='core/scene core/fields core/base core/kernel/'
backend="core/session/backend.h core/session/film_slots.h $below_session"
tools="core/bench core/selftest core/diagnose core/inspect core/plot core/io core/measure core/session $below_session"
below_ui="ui/viewer.h $tools"
worker="ui/worker"
below_app='core/ cpu/ cuda/ mpi/ ui/'
arrows="
core/kernel/base:
core/kernel/geometry:   core/kernel/base
core/kernel/shading/delta_lights.h:    core/kernel/base
core/kernel/shading/environment_map.h: core/kernel/base
core/kernel/shading/far_lights.h:      core/kernel/base core/kernel/shading/environment_map.h
core/kernel/shading/light_tree.h:      core/kernel/base
core/kernel/shading/material.h:        core/kernel/base
core/kernel/shading/surface_lobes.h:   core/kernel/base
core/kernel/scene:      $kernel_data
core/kernel/geometry/intersector.h: $kernel_data core/kernel/scene core/kernel/geometry/instance_traversal.h
core/kernel/geometry/instance_traversal.h: $kernel_data core/kernel/scene
core/kernel/shading:    $kernel_data core/kernel/scene
core/kernel/film:       core/kernel/base
core/kernel/guiding:    $kernel_scene
core/kernel/methods:    $kernel_scene core/kernel/guiding
core/kernel/integrator: $kernel_scene core/kernel/guiding core/kernel/methods core/kernel/film
core/kernel/inspect:    $kernel_scene core/kernel/guiding core/kernel/methods core/kernel/film core/kernel/integrator

core/base:    core/kernel/base
core/scene:   core/base core/kernel/
core/fields:  core/scene core/base core/kernel/
core/session: $below_session
core/measure: core/session $below_session
core/plot:    core/base
core/io:      core/session/learned_field.h core/session/session_state.h core/session/settings.h core/session/snapshot.h core/session/shown_range.h core/scene core/fields core/base core/kernel/
core/diagnose: core/measure core/session $below_session
core/inspect: core/measure core/session $below_session
core/selftest: core/session $below_session
core/bench:   core/measure core/io core/session $below_session

cpu/base:     core/base core/kernel/
cpu/lanes:    cpu/base core/kernel/
cpu/rays:     cpu/base core/base core/kernel/
cpu/learning: cpu/base core/fields core/base core/kernel/
cpu/paths:    cpu/base cpu/rays cpu/learning core/session/backend.h core/base core/kernel/
cpu/passes:   cpu/base cpu/rays cpu/learning cpu/paths $backend
cpu:          cpu/base cpu/rays cpu/learning cpu/paths cpu/passes core/session/exact_backend.h $backend
cuda:         cuda/ cpu/learning/neural_update.h core/session/exact_backend.h $backend
mpi:          core/session/exact_backend.h $backend

ui/viewer.h:  $tools
ui/worker:    $below_ui
ui/draw:      $below_ui $worker
ui/plot:      $below_ui ui/draw
ui/compare:   $below_ui $worker ui/draw ui/plot
ui/model:     $below_ui $worker ui/draw ui/plot ui/compare
ui/input:     $below_ui ui/draw ui/model
ui/script:    $below_ui ui/draw ui/model ui/input
ui/panels:    $below_ui ui/draw ui/plot ui/compare ui/model ui/input
ui/overlays:  $below_ui ui/draw ui/plot ui/compare ui/model ui/input
ui/window:    $below_ui $worker ui/draw ui/plot ui/compare ui/model ui/input ui/panels ui/overlays
ui:           $below_ui ui/

app:          $below_app
app/options:  $below_app app
app/option_table.cpp: $below_app app app/options
app/measure:  $below_app app
app/report:   $below_app app app/measure

python:       $below_app app app/options
"

# <header pattern>: the only folders that may include it.
libraries='
SDL*:              ui/draw ui/input ui/script ui/window ui/viewer.cpp
imgui*:            ui/draw
backends/imgui*:   ui/draw
CLI/*:             app
embree[34]/*:      tests
omp.h:             cpu/base
cuda*:             cuda
nanobind/*:        python
mpi.h:             mpi
tiny_obj_loader.h: core/io
Imf*:              core/io/exr.cpp
Iex*:              core/io/exr.cpp
stb_*:             core/io
'

kernel_headers=' cstdint cmath concepts type_traits atomic limits bit cstring string_view utility '

# Where kernels may use double: sums over samples, the edge functions that come out as zero in float, which the watertight
# triangle test has to decide exactly, and the planes of triangles, which kernels make for triangles of instances alone.
double_allowed='core/kernel/film core/kernel/geometry/triangle.h core/kernel/scene/triangle_plane.h core/kernel/scene/instances.h'

# within PATH FOLDER...: is PATH one of the folders or files, or below one?
within() {
    local path=$1 folder
    shift
    for folder in "$@"; do
        [[ $path == "$folder" || $path == "$folder"/* ]] && return 0
    done
    return 1
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

# Prints a line for every include of $1, lines of FILE:LINE:TEXT, that no arrow allows, for rules that allow each other,
# and for folders without a rule.
check_arrows() {
    awk -v arrows="$arrows" '
        function governs(name, path) { return path == name || index(path, name "/") == 1 }
        function rule_of(path,    name, best) {
            if (path in known) return known[path]
            best = ""
            for (name in allowed) if (governs(name, path) && length(name) > length(best)) best = name
            return known[path] = best
        }
        function allows(rule, path,    items, count, i, item) {
            if (rule_of(path) == rule) return 1
            count = split(allowed[rule], items, " ")
            for (i = 1; i <= count; ++i) {
                item = items[i]
                if (item == path || (item in allowed && rule_of(path) == item)) return 1
                if (item ~ /\/$/ && index(path, item) == 1) return 1
            }
            return 0
        }
        function check_rules(    a, b, items, count, i) {
            for (a in allowed) {
                count = split(allowed[a], items, " ")
                for (i = 1; i <= count; ++i) {
                    b = items[i]
                    if (a < b && b in allowed && (" " allowed[b] " ") ~ (" " a " "))
                        print "check_includes.sh: the rules of " a " and " b " allow each other: a circle"
                }
            }
        }
        BEGIN {
            gsub(/\n +/, " ", arrows)
            count = split(arrows, lines, "\n")
            for (i = 1; i <= count; ++i) {
                if (lines[i] !~ /:/) continue
                name = lines[i]; sub(/:.*/, "", name)
                list = lines[i]; sub(/[^:]*:/, "", list); gsub(/ +/, " ", list)
                allowed[name] = list
            }
            check_rules()
        }
        {
            match($0, /^[^:]+:[0-9]+:/)
            place = substr($0, 1, RLENGTH - 1)
            file = place; sub(/:[0-9]+$/, "", file)
            path = $0; sub(/^[^"]*"/, "", path); sub(/".*/, "", path)
            rule = rule_of(file)
            if (rule == "") print file ": no rule in check_includes.sh says what it may include"
            else if (!allows(rule, path)) print place ": " rule " may not include \"" path "\" (only:" allowed[rule] ")"
        }'
}

check_includes() {
    local text place
    local pattern='^([^:]+):([0-9]+):[[:space:]]*#[[:space:]]*include[[:space:]]*([<"])([^>"]+)'
    local all
    all=$(grep -rnE '^[[:space:]]*#[[:space:]]*include' --include='*.h' --include='*.cpp' --include='*.cu' \
        --include='*.cuh' --include='*.inc' core cpu cuda mpi ui app python 2>/dev/null)
    while IFS= read -r text; do
        [[ -n $text ]] && breach "$text"
    done <<<"$(grep -E 'include[[:space:]]*"' <<<"$all" | check_arrows)"
    while read -r text; do
        [[ $text =~ $pattern ]] || continue
        place=${BASH_REMATCH[1]}:${BASH_REMATCH[2]}
        if [[ ${BASH_REMATCH[3]} == '"' ]]; then
            [[ -f ${BASH_REMATCH[4]} ]] || breach "$place: \"${BASH_REMATCH[4]}\" is not a path from the root of the repository"
        else
            check_library "$place" "${BASH_REMATCH[1]}" "${BASH_REMATCH[4]}"
        fi
    done <<<"$all"
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

check_includes

if [[ -d core/kernel ]]; then
    while IFS= read -r text; do
        [[ -n $text ]] && breach "$text  <- not in core/kernel (no allocation, exceptions, virtual calls; double only in: $double_allowed)"
    done <<<"$(check_kernel_words)"
fi

while IFS= read -r file; do
    [[ -n $file ]] && breach "$file: no #pragma once"
done <<<"$(find core cpu cuda mpi ui app python -name '*.h' -exec grep -L '^#pragma once' {} + 2>/dev/null)"

for folder in core/*/ core/kernel/*/ cpu/*/ ui/*/ app/*/; do
    folder=${folder%/}
    [[ ! -d $folder || $folder == core/kernel || $arrows == *$'\n'"$folder:"* ]] ||
        breach "$folder: no rule in check_includes.sh says what it may include"
done

((breaches == 0)) || {
    printf '%d breaches\n' "$breaches"
    exit 1
}
