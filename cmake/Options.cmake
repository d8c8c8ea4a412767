# Compiler flags as two interface targets: pl_options (semantics of the code) and pl_warnings.

set(CMAKE_CXX_FLAGS_RELEASE "-O3 -DNDEBUG -g0")

find_program(PL_CCACHE ccache)
mark_as_advanced(PL_CCACHE)
if(PL_CCACHE AND NOT DEFINED CMAKE_CXX_COMPILER_LAUNCHER)
    # Sloppiness: else ccache takes no file with a precompiled header.
    set(CMAKE_CXX_COMPILER_LAUNCHER
        "${CMAKE_COMMAND}" -E env CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime "${PL_CCACHE}")
endif()
if(PL_CCACHE AND NOT DEFINED CMAKE_CUDA_COMPILER_LAUNCHER)
    set(CMAKE_CUDA_COMPILER_LAUNCHER "${PL_CCACHE}")
endif()
# Unity builds: most of a file's time is the parsing of headers and the instantiation of the standard library, which
# files share in one. Presets for development compile file by file: an edit rebuilds one file, and a missing
# #include line is found. Libraries with kernels always do.
set(CMAKE_UNITY_BUILD_BATCH_SIZE 32)

add_library(pl_options INTERFACE)
target_compile_features(pl_options INTERFACE cxx_std_20)
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
target_include_directories(pl_options INTERFACE "${PROJECT_SOURCE_DIR}")

# Reproducible arithmetic: no contraction and no value-changing optimization, even if CXXFLAGS has them. The program
# never reads errno or the trap flags; -fno-math-errno and -fno-trapping-math let loops vectorize and change no value. No
# -march=native: the CPU back end clones hot loops per instruction set.
set(pl_exact_flags -fno-fast-math -ffp-contract=off -fno-math-errno -fno-trapping-math)
target_compile_options(pl_options INTERFACE "$<$<COMPILE_LANGUAGE:CXX>:${pl_exact_flags}>")
include("${CMAKE_CURRENT_LIST_DIR}/Arithmetic.cmake")

# The same libraries in the program and in the Python module: hidden symbols are called and inlined as without position independence.
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)

if(PL_FUZZ)
    if(NOT CMAKE_CXX_COMPILER_ID MATCHES "Clang" OR PL_TESTS STREQUAL "ON")
        message(FATAL_ERROR "PL_FUZZ needs clang and PL_TESTS=OFF; tests/fuzz/run_fuzzers.sh configures it so")
    endif()
    set(PL_TESTS OFF)
    set(PL_SANITIZE "address,undefined")
    target_compile_options(pl_options INTERFACE -fsanitize=fuzzer-no-link)
endif()

if(PL_SANITIZE)
    if(PL_SANITIZE MATCHES "thread" AND NOT PL_SANITIZE STREQUAL "thread")
        message(FATAL_ERROR "PL_SANITIZE=${PL_SANITIZE}: thread cannot be combined with others")
    endif()
    set(pl_sanitize_flags -fsanitize=${PL_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
    if(PL_SANITIZE MATCHES "undefined")
        list(APPEND pl_sanitize_flags -fsanitize=float-cast-overflow)
    endif()
    target_compile_options(pl_options INTERFACE ${pl_sanitize_flags})
    target_link_options(pl_options INTERFACE ${pl_sanitize_flags})
    # No function clones: they are resolved before the run-time library of the sanitizer is initialized.
    target_compile_definitions(pl_options INTERFACE PL_NO_CLONES _GLIBCXX_ASSERTIONS)
    if(PL_SANITIZE STREQUAL "thread")
        # The OpenMP run-time library is not instrumented: std::thread replaces it.
        target_compile_definitions(pl_options INTERFACE PL_TSAN)
    endif()
endif()

# A switch over an enumeration that misses a value is no warning but an error: of a kind of surface it would be a wrong picture.
add_library(pl_warnings INTERFACE)
target_compile_options(pl_warnings INTERFACE
    $<$<COMPILE_LANGUAGE:CXX>:-Wall;-Wextra;-Wpedantic;-Wshadow;-Wconversion;-Werror=switch>
    $<$<AND:$<COMPILE_LANGUAGE:CXX>,$<BOOL:${PL_WERROR}>>:-Werror>)

# pl_add_library(NAME [LEVEL]): a static library of this project; add sources by target_sources(). Its first source is the
# CMakeLists.txt of the folder, so that a library of headers only is valid. LEVEL: -O1 or -O2 for releases of code that no
# pass of a picture runs, since optimization is half of the time of a build.
function(pl_add_library name)
    add_library(${name} STATIC CMakeLists.txt)
    set_target_properties(${name} PROPERTIES LINKER_LANGUAGE CXX)
    target_link_libraries(${name} PUBLIC pl_options PRIVATE pl_warnings)
    target_compile_options(${name} PRIVATE "$<$<CONFIG:Release>:${ARGN}>")
endfunction()
