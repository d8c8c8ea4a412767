# Looks for a working CUDA compiler. Sets PL_CUDA_BUILT, or PL_CUDA_MISSING to the reason; with PL_CUDA=ON a missing one is an
# error. CMAKE_CUDA_ARCHITECTURES defaults to the GPUs of this machine; the preset release-all has all major ones.
set(PL_CUDA_BUILT OFF)
set(PL_CUDA_MISSING "")
set(PL_CUDA_NOTE "")

# pl_gpu_architectures(RESULT): compute capabilities of the GPUs here, such as "86;90"; empty without one.
function(pl_gpu_architectures result)
    set(capabilities "")
    find_program(PL_NVIDIA_SMI nvidia-smi)
    mark_as_advanced(PL_NVIDIA_SMI)
    if(PL_NVIDIA_SMI)
        execute_process(
            COMMAND "${PL_NVIDIA_SMI}" --query-gpu=compute_cap --format=csv,noheader
            OUTPUT_VARIABLE output
            ERROR_QUIET)
        string(REGEX MATCHALL "[0-9]+\\.[0-9]" capabilities "${output}")
        string(REPLACE "." "" capabilities "${capabilities}")
        list(REMOVE_DUPLICATES capabilities)
    endif()
    set(${result} "${capabilities}" PARENT_SCOPE)
endfunction()

if(NOT PL_CUDA MATCHES "^(AUTO|ON|OFF)$")
    message(FATAL_ERROR "PL_CUDA: expected AUTO, ON or OFF, got '${PL_CUDA}'")
endif()

if(PL_CUDA STREQUAL "OFF")
    set(PL_CUDA_MISSING "configured with PL_CUDA=OFF")
elseif(PL_SANITIZE)
    # Sanitizers do not cover device code; tests run the same sources on the host.
    set(PL_CUDA_MISSING "a build with sanitizers")
else()
    # By CUDACXX, because check_language() does not test a compiler given by CMAKE_CUDA_COMPILER.
    if(NOT CMAKE_CUDA_COMPILER AND NOT DEFINED ENV{CUDACXX})
        find_program(PL_NVCC nvcc HINTS ENV CUDA_PATH ENV CUDA_HOME PATHS /usr/local/cuda /opt/cuda /usr/lib/cuda
            PATH_SUFFIXES bin)
        mark_as_advanced(PL_NVCC)
        if(PL_NVCC)
            set(ENV{CUDACXX} "${PL_NVCC}")
        endif()
    endif()
    if(CMAKE_CUDA_COMPILER OR DEFINED ENV{CUDACXX})
        include(CheckLanguage)
        check_language(CUDA)
        if(NOT CMAKE_CUDA_COMPILER)
            set(PL_CUDA_MISSING "nvcc was found but does not work with this C++ compiler")
        endif()
    else()
        set(PL_CUDA_MISSING "no nvcc was found")
    endif()
    if(CMAKE_CUDA_COMPILER)
        # One architecture compiles in a fraction of the time of all. Its PTX is included, for newer GPUs.
        if(NOT DEFINED CMAKE_CUDA_ARCHITECTURES)
            pl_gpu_architectures(pl_architectures)
            if(NOT pl_architectures)
                set(pl_architectures 90)
                set(PL_CUDA_NOTE ", no GPU found")
            endif()
            set(CMAKE_CUDA_ARCHITECTURES "${pl_architectures}" CACHE STRING "GPU architectures")
        endif()
        enable_language(CUDA)
        if(CMAKE_CUDA_COMPILER_VERSION VERSION_LESS 12.0)
            set(PL_CUDA_MISSING "nvcc ${CMAKE_CUDA_COMPILER_VERSION} is older than 12.0")
        else()
            find_package(CUDAToolkit REQUIRED)
            set(PL_CUDA_BUILT ON)
        endif()
    endif()
endif()
if(PL_CUDA STREQUAL "ON" AND NOT PL_CUDA_BUILT)
    message(FATAL_ERROR "PL_CUDA=ON, but ${PL_CUDA_MISSING}")
endif()

if(PL_CUDA_BUILT)
    # CMake 3.25.0 and 3.25.1 lack the C++20 flag of nvcc.
    if(NOT DEFINED CMAKE_CUDA20_STANDARD_COMPILE_OPTION)
        set(CMAKE_CUDA20_STANDARD_COMPILE_OPTION "-std=c++20")
        set(CMAKE_CUDA20_EXTENSION_COMPILE_OPTION "-std=c++20")
    endif()
    set(CMAKE_CUDA_STANDARD 20)
    set(CMAKE_CUDA_STANDARD_REQUIRED ON)
    set(CMAKE_CUDA_FLAGS_RELEASE "-O3 -DNDEBUG")
    # -fmad=false: no contraction, as on the host. Suppressed diagnostics: 20012, annotations on defaulted functions in GLM;
    # 445, a template parameter that only the body of a lambda uses.
    set(PL_CUDA_FLAGS -fmad=false --expt-relaxed-constexpr -diag-suppress=20012,445 -Xcompiler=-Wall,-Wextra,-ffp-contract=off)
    # Variants of the kernels among which only a device can decide; see docs/cuda.md.
    set(PL_CUDA_GUIDED_BLOCKS 2 CACHE STRING "blocks of a processor in which the threads of guided methods go through segments together")
    set(PL_CUDA_GUIDED_STEPS 5 CACHE STRING "the steps of a segment at most, 1 to 5; 0: each thread goes by itself")
    set(PL_CUDA_LOBE_BLOCKS 1 CACHE STRING "the same blocks of kernels with lobes")
    set(PL_CUDA_LOBE_STEPS 5 CACHE STRING "the same steps of kernels with lobes")
    set(PL_CUDA_SMALL_SCENES 64 CACHE STRING "most triangles of a scene that is traced from shared memory, at most 64; 0: none is")
    set(PL_CUDA_POSTPONE_LEAVES ON CACHE BOOL "leaves of larger hierarchies are postponed, so that lanes descend together")
    add_library(pl_cuda_options INTERFACE)
    target_compile_definitions(pl_cuda_options INTERFACE
        PL_CUDA_GUIDED_BLOCKS=${PL_CUDA_GUIDED_BLOCKS}
        PL_CUDA_GUIDED_STEPS=${PL_CUDA_GUIDED_STEPS}
        PL_CUDA_LOBE_BLOCKS=${PL_CUDA_LOBE_BLOCKS}
        PL_CUDA_LOBE_STEPS=${PL_CUDA_LOBE_STEPS}
        PL_CUDA_SMALL_SCENES=${PL_CUDA_SMALL_SCENES}
        PL_CUDA_POSTPONE_LEAVES=$<BOOL:${PL_CUDA_POSTPONE_LEAVES}>)
    target_compile_options(pl_cuda_options INTERFACE
        "$<$<AND:$<COMPILE_LANGUAGE:CUDA>,$<BOOL:${PL_CUDA_LINE_INFO}>>:-lineinfo>"
        "$<$<COMPILE_LANGUAGE:CUDA>:${PL_CUDA_FLAGS}>"
        "$<$<AND:$<COMPILE_LANGUAGE:CUDA>,$<BOOL:${PL_WERROR}>>:-Werror=all-warnings>")
endif()
