# Run-time test of IEEE arithmetic with the flags of this build. pl_options comes after the user's flags (CXXFLAGS) and undoes
# -ffast-math for the compiler, but not for the linker, which would still flush denormal numbers to zero.
if(CMAKE_CROSSCOMPILING)
    return()
endif()

set(probe "${CMAKE_CURRENT_BINARY_DIR}/CMakeFiles/arithmetic.cpp")
file(CONFIGURE OUTPUT "${probe}" @ONLY CONTENT [[
#include <limits>
#ifdef __FAST_MATH__
#error "fast-math"
#endif
#if defined(__x86_64__)
#define WITH_FMA __attribute__((noinline, target("fma")))
#else
#define WITH_FMA __attribute__((noinline))
#endif
WITH_FMA float contracted(float a, float c) { return a * a - c; }
bool has_fma() {
#if defined(__x86_64__)
    return __builtin_cpu_supports("fma");
#else
    return true;
#endif
}
int main() {
    volatile float nan = std::numeric_limits<float>::quiet_NaN();
    const float x = nan;
    if (x == x || !(x != x)) return 1;
    volatile float smallest = std::numeric_limits<float>::min();
    if (0.5f * smallest == 0.0f) return 2;
    volatile float a = 1.0f + 0x1p-12f;  // its square is 1 + 2^-11, rounded
    if (has_fma() && contracted(a, 1.0f + 0x1p-11f) != 0.0f) return 3;
    return 0;
}
]])

# The name of the cached result contains the flags, so that the test runs again when they change.
string(TOUPPER "${CMAKE_BUILD_TYPE}" build_type)
string(MD5 flags "${CMAKE_CXX_COMPILER} ${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${build_type}} ${pl_exact_flags}")
set(CMAKE_TRY_COMPILE_CONFIGURATION "${CMAKE_BUILD_TYPE}")
try_run(PL_ARITHMETIC_${flags} PL_ARITHMETIC_BUILT_${flags} "${CMAKE_CURRENT_BINARY_DIR}/CMakeFiles/arithmetic" "${probe}"
    COMPILE_DEFINITIONS ${pl_exact_flags}
    COMPILE_OUTPUT_VARIABLE output)
mark_as_advanced(PL_ARITHMETIC_${flags} PL_ARITHMETIC_BUILT_${flags})
if(NOT PL_ARITHMETIC_BUILT_${flags})
    message(FATAL_ERROR "The test of floating-point arithmetic does not compile:\n${output}")
endif()
set(faults "" "NaN is not found" "denormal numbers are flushed to zero" "products and sums are fused")
set(answer "${PL_ARITHMETIC_${flags}}")
if(answer MATCHES "^[123]$")
    list(GET faults ${answer} fault)
    message(FATAL_ERROR "Compiler flags change floating-point arithmetic: ${fault}. "
        "Pictures would differ between builds, and errors hide. Leave out -ffast-math, -Ofast, -funsafe-math-optimizations and the like: "
        "'${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${build_type}}'")
elseif(NOT answer STREQUAL "0")
    message(FATAL_ERROR "The test of floating-point arithmetic does not run: ${answer}")
endif()
