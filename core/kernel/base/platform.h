// Differences between the C++ compiler and nvcc: PL_HD, PL_INLINE, PL_ASSERT. Besides atomics.h the only file of
// core/kernel that tests compiler macros.
#pragma once

#ifdef __FAST_MATH__
#error "pathlight counts NaNs and promises equal bits: do not compile it with -ffast-math"
#endif

#if defined(__CUDACC__)
#define PL_HD __host__ __device__
#define PL_INLINE __forceinline__ __host__ __device__
#else
#define PL_HD
#define PL_INLINE inline __attribute__((always_inline))
#endif

/// Assertion on host and device; nothing in release builds.
#if defined(NDEBUG)
#define PL_ASSERT(condition) ((void)0)
#elif defined(__CUDA_ARCH__)
#define PL_ASSERT(condition) ((condition) ? (void)0 : __trap())
#else
#define PL_ASSERT(condition) ((condition) ? (void)0 : __builtin_trap())
#endif
