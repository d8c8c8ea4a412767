# Declaration of tests. Tiers are labels of ctest: "push" for untagged tests, "merge" and "nightly" for the tags [merge] and
# [nightly] (or [.merge] and [.nightly]). Tests with [.] alone run only by hand.
include(Catch)

# pl_add_test(NAME SOURCES a.cpp... [LIBS target...] [LABELS label...] [PROCESSORS n] [COMPILE_FAST])
# One Catch2 program build/<preset>/bin/NAME; its cases become tests called "NAME.case".
# The time limit of a case is a guard against hangs, far beyond its time on a busy machine: no verdict depends on speed.
# PROCESSORS: how many cores a case needs for itself (default 1). Threads that wait do so asleep: tests run side by side,
# some with more threads than there are cores, and each spinning thread would keep a working one from its core.
# COMPILE_FAST: with -O1, for tests that take seconds to run, or spend their time in the libraries and programs that they call.
function(pl_add_test name)
    cmake_parse_arguments(PARSE_ARGV 1 arg "COMPILE_FAST" "PROCESSORS" "SOURCES;LIBS;LABELS")
    pl_check_arguments(pl_add_test "${name}" "${arg_SOURCES}" "${arg_UNPARSED_ARGUMENTS}")
    if(NOT arg_PROCESSORS)
        set(arg_PROCESSORS 1)
    endif()
    add_executable(${name} ${arg_SOURCES})
    target_link_libraries(${name} PRIVATE ${arg_LIBS} pl_margins pl_options pl_warnings dep::catch2)
    target_compile_definitions(${name} PRIVATE PL_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
    set_target_properties(${name} PROPERTIES
        UNITY_BUILD "${PL_TEST_UNITY}"
        RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/bin")
    if(arg_COMPILE_FAST)
        # With less analysis gcc 12 warns of sound strings of the standard library (PR 105651).
        target_compile_options(${name} PRIVATE -O1
            $<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds;-Wno-stringop-overflow;-Wno-stringop-overread;-Wno-restrict>)
    endif()
    if(PL_TEST_UNITY)
        pl_compile_alone(${name})
    else()
        pl_precompile_headers(${name} ${arg_SOURCES})
    endif()

    pl_discover(${name} push "~[merge]~[nightly]~[.]" 1200)
    pl_has_tag(in_merge merge ${arg_SOURCES})
    if(in_merge)
        pl_discover(${name} merge "[merge]~[nightly]" 3600)
    endif()
    pl_has_tag(in_nightly nightly ${arg_SOURCES})
    if(in_nightly)
        pl_discover(${name} nightly "[nightly]" 7200)
    endif()
endfunction()

# The same sources one by one, for tests_alone: a batch of a unity build hides that a source lacks an #include line.
function(pl_compile_alone name)
    add_library(${name}_alone OBJECT EXCLUDE_FROM_ALL
        "$<FILTER:$<TARGET_PROPERTY:${name},SOURCES>,EXCLUDE,/Unity/>")
    target_link_libraries(${name}_alone PRIVATE "$<TARGET_PROPERTY:${name},LINK_LIBRARIES>")
    target_compile_definitions(${name}_alone PRIVATE "$<TARGET_PROPERTY:${name},COMPILE_DEFINITIONS>")
    target_compile_options(${name}_alone PRIVATE -O0)
    set_target_properties(${name}_alone PROPERTIES EXPORT_COMPILE_COMMANDS OFF)
    add_dependencies(tests_alone ${name}_alone)
endfunction()

# Parsing Catch2, GLM and the standard library is a fifth of the time of a test's source: programs of many sources share it where
# each is compiled alone. To batches of a unity build it brings nothing.
# Headers of the project are not among them, so that an edit compiles only what includes it.
function(pl_precompile_headers name)
    list(LENGTH ARGN sources)
    if(sources LESS 6)
        return()
    endif()
    target_precompile_headers(${name} PRIVATE
        <catch2/catch.hpp> <fmt/format.h> <glm/glm.hpp> <algorithm> <array> <chrono> <cmath> <filesystem> <fstream> <functional>
        <map> <memory> <mutex> <optional> <set> <sstream> <string> <thread> <variant> <vector>)
    target_link_libraries(${name} PRIVATE dep::fmt)
    # ccache asks for it where a header is precompiled.
    target_compile_options(${name} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
endfunction()

# pl_add_bench(NAME SOURCES a.cpp... [LIBS target...]): a program build/<preset>/bench/NAME, not a test.
function(pl_add_bench name)
    cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;LIBS")
    pl_check_arguments(pl_add_bench "${name}" "${arg_SOURCES}" "${arg_UNPARSED_ARGUMENTS}")
    add_executable(${name} ${arg_SOURCES})
    target_link_libraries(${name} PRIVATE ${arg_LIBS} pl_options pl_warnings)
    target_compile_definitions(${name} PRIVATE PL_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
    set_target_properties(${name} PROPERTIES
        UNITY_BUILD "${PL_TEST_UNITY}"
        RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/bench")
endfunction()

function(pl_check_arguments function name sources unparsed)
    if(NOT sources OR unparsed)
        message(FATAL_ERROR "${function}(${name}): SOURCES are required; unknown arguments: '${unparsed}'")
    endif()
endfunction()

# Uses LABELS and PROCESSORS of the calling pl_add_test.
function(pl_discover name tier spec timeout)
    set(list "${name}_${tier}_TESTS")
    catch_discover_tests(${name}
        TEST_SPEC "${spec}"
        TEST_PREFIX "${name}."
        TEST_LIST ${list}
        PROPERTIES TIMEOUT ${timeout} PROCESSORS ${arg_PROCESSORS} ENVIRONMENT OMP_WAIT_POLICY=passive)
    # catch_discover_tests() does not support lists of labels: a script sets them when ctest has read the tests.
    set(script "${CMAKE_CURRENT_BINARY_DIR}/${name}_${tier}_labels.cmake")
    file(CONFIGURE OUTPUT "${script}" @ONLY CONTENT [[
foreach(test IN LISTS @list@)
    set_tests_properties("${test}" PROPERTIES LABELS "@tier@;@arg_LABELS@")
endforeach()
]])
    set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES "${script}")
endfunction()

# Whether a source contains the tag. Catch2 2 warns about a tier without tests, so such tiers are not listed.
function(pl_has_tag result tag)
    set(found OFF)
    foreach(source IN LISTS ARGN)
        file(REAL_PATH "${source}" path BASE_DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}")
        set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${path}")
        file(STRINGS "${path}" lines REGEX "\\[\\.?${tag}\\]")
        if(lines)
            set(found ON)
        endif()
    endforeach()
    set(${result} ${found} PARENT_SCOPE)
endfunction()
