#!/usr/bin/env bash
# check_includes_test.sh CHECKER: seeds one breach at a time into a small tree, and demands that each is found.
set -u
checker=$1
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
failures=0

fail() {
    printf 'FAILED: %s\n' "$*"
    failures=$((failures + 1))
}

put() {
    mkdir -p "$tree/$(dirname "$1")"
    printf '%b' "$2" >"$tree/$1"
}

# The tree that keeps every rule.
reset() {
    rm -rf "${tree:?}"/*
    put core/kernel/base/math.h '#pragma once\n#include <cmath>\n#include <glm/glm.hpp>\nvoid f() = delete;  // new\n'
    put core/kernel/film/film.h '#pragma once\n#include "core/kernel/base/math.h"\ndouble sum;\n'
    put core/base/error.h '#pragma once\n#include <string>\n'
    put core/scene/description.h '#pragma once\n#include "core/base/error.h"\n'
    put core/fields/place.h '#pragma once\n#include "core/scene/description.h"\n'
    put core/session/backend.h '#pragma once\n#include "core/kernel/film/film.h"\n'
    put core/session/session.h '#pragma once\n#include "core/session/backend.h"\n'
    put core/session/learned_field.h '#pragma once\n#include "core/fields/place.h"\n'
    put core/io/field_file.cpp '#include "core/session/learned_field.h"\n'
    put core/io/load.cpp '#include <tiny_obj_loader.h>\n\n#include "core/scene/description.h"\n'
    put cpu/backend.cpp '#include "core/session/backend.h"\n#include "cpu/passes/pass.h"\n'
    put cpu/base/groups.h '#pragma once\n#include <omp.h>\n\n#include "core/base/error.h"\n'
    put cpu/lanes/lanes.h '#pragma once\n#include "cpu/base/groups.h"\n'
    put cpu/paths/path.h '#pragma once\n#include "cpu/base/groups.h"\n'
    put cpu/passes/pass.h '#pragma once\n#include "cpu/paths/path.h"\n'
    put ui/viewer.h '#pragma once\n#include "core/session/session.h"\n'
    put ui/viewer.cpp '#include <SDL.h>\n\n#include "ui/viewer.h"\n#include "ui/window/gui.h"\n'
    put ui/window/gui.h '#pragma once\n#include "ui/draw/style.h"\n#include "ui/model/model.h"\n#include "ui/viewer.h"\n'
    put ui/model/model.h '#pragma once\n#include "ui/worker/worker.h"\n'
    put ui/worker/worker.h '#pragma once\n#include "ui/viewer.h"\n'
    put ui/draw/style.h '#pragma once\n#include <imgui.h>\n'
    put app/main.cpp '#include "cpu/backend.h"\n#include "ui/viewer.h"\n#include <CLI/CLI.hpp>\n'
    put app/measure/bench.cpp '#include "app/console.h"\n'
    put app/console.h '#pragma once\n'
    put core/kernel/scene/view.h '#pragma once\n#include "core/kernel/base/math.h"\n'
    put core/kernel/methods/guided.h '#pragma once\n#include "core/kernel/scene/view.h"\n'
    put cpu/backend.h '#pragma once\n'
}

# expect_breach FILE CONTENT MESSAGE_PART
expect_breach() {
    reset
    put "$1" "$2"
    local output
    if output=$(bash "$checker" "$tree"); then
        fail "not found in $1: $2"
    elif [[ $output != *"$3"* || $output != *"1 breaches"* ]]; then
        fail "$1: $2: expected one breach with '$3', got: $output"
    fi
}

reset
bash "$checker" "$tree" || fail "the tree without a breach was refused"

once='#pragma once\n'
expect_breach core/kernel/base/a.h "$once#include <vector>\n" 'may not include <vector>'
expect_breach core/kernel/base/a.h "$once#include \"core/base/error.h\"\n" 'core/kernel/base may not include'
expect_breach core/kernel/base/a.h "${once}inline void f() { throw 1; }\n" 'a.h:2:'
expect_breach core/kernel/base/a.h "${once}struct A { virtual void f(); };\n" 'virtual'
expect_breach core/kernel/base/a.h "${once}inline int* f() { return new int; }\n" 'new int'
expect_breach core/kernel/base/a.h "${once}inline void f(int* p) { delete p; }\n" 'delete p'
expect_breach core/kernel/base/a.h "${once}inline double f() { return 1; }\n" 'double'
expect_breach core/base/a.cpp '#include "core/scene/description.h"\n' 'core/base may not include'
expect_breach core/scene/a.cpp '#include "core/fields/place.h"\n' 'core/scene may not include'
expect_breach core/session/a.cpp '#  include "core/io/load.cpp"\n' 'core/session may not include'
expect_breach core/session/a.cpp '#include "cpu/backend.h"\n' 'core/session may not include'
expect_breach cpu/a.cpp '#include "core/session/session.h"\n' 'cpu may not include'
expect_breach ui/a.cpp '#include "cpu/backend.h"\n' 'ui may not include'
expect_breach ui/a.cpp '#include "app/main.cpp"\n' 'ui may not include'
expect_breach core/io/a.cpp '#include "core/session/session.h"\n' 'core/io may not include'
expect_breach app/a.cpp '#include <SDL.h>\n' '<SDL.h> belongs in ui'
expect_breach core/scene/a.cpp '#include <tiny_obj_loader.h>\n' 'belongs in core/io'
expect_breach core/scene/a.cpp '#include <embree4/rtcore.h>\n' 'belongs in tests'
expect_breach app/a.cpp '#include "cpu/absent.h"\n' 'not a path from the root'
expect_breach ui/draw/a.h '#include <string>\n' 'no #pragma once'
expect_breach core/other/a.h "$once" 'core/other: no rule'
expect_breach ui/other/a.h "$once" 'ui/other: no rule'
expect_breach app/other/a.h "$once" 'app/other: no rule'
expect_breach cpu/other/a.h "$once" 'cpu/other: no rule'
# Inside a folder: an arrow that runs back up.
expect_breach ui/worker/a.cpp '#include "ui/model/model.h"\n' 'ui/worker may not include "ui/model/model.h"'
expect_breach ui/draw/a.cpp '#include "ui/window/gui.h"\n' 'ui/draw may not include'
expect_breach ui/model/a.cpp '#include "ui/window/gui.h"\n' 'ui/model may not include'
expect_breach ui/model/a.cpp '#include <imgui.h>\n' '<imgui.h> belongs in ui/draw'
expect_breach app/a.cpp '#include "app/measure/bench.cpp"\n' 'app may not include'
expect_breach core/kernel/base/a.h "$once#include \"core/kernel/scene/view.h\"\n" 'core/kernel/base may not include'
expect_breach core/kernel/scene/a.h "$once#include \"core/kernel/methods/guided.h\"\n" 'core/kernel/scene may not include'

expect_breach cpu/base/a.cpp '#include "cpu/paths/path.h"\n' 'cpu/base may not include "cpu/paths/path.h"'
expect_breach cpu/lanes/a.cpp '#include "cpu/paths/path.h"\n' 'cpu/lanes may not include'
expect_breach cpu/paths/a.cpp '#include "cpu/passes/pass.h"\n' 'cpu/paths may not include'
expect_breach cpu/paths/a.cpp '#include "cpu/lanes/lanes.h"\n' 'cpu/paths may not include'
expect_breach cpu/passes/a.inc '#include "cpu/backend.h"\n' 'cpu/passes may not include'
expect_breach cpu/paths/a.cpp '#include <omp.h>\n' '<omp.h> belongs in cpu/base'

# Rules that allow each other.
reset
sed 's|^ui/draw: |ui/draw: ui/panels |' "$checker" >"$tree/circle.sh"
output=$(bash "$tree/circle.sh" "$tree") && fail 'a circle in the rules was not found'
[[ $output == *'the rules of ui/draw and ui/panels allow each other'* ]] || fail "no word of the circle in: $output"

((failures == 0))
