// Differences between the C++ compiler and nvcc: PL_HD, PL_INLINE, PL_HD_INLINED, PL_HD_APART, PL_HOST_APART, PL_ASSERT, arithmetic for
// bounds, votes of a warp. Besides atomics.h the only file of core/kernel that tests compiler macros.
#pragma once

#include <bit>
#include <cstdint>

#ifdef __FAST_MATH__
#error "pathlight counts NaNs and promises equal bits: do not compile it with -ffast-math"
#endif

// PL_INLINE: inlined by both. PL_HD_INLINED: by nvcc alone, for functions that are called once: apart, they would take parameters by
// addresses of unknown kind of memory, and the path's state would go to the stack. PL_HD_APART: by neither, for rare and long work,
// which would take registers from all other. PL_HOST_APART: not by the C++ compiler, for long functions that several kernels share or
// that one calls in several places: a call is cheap beside them, and they are compiled once, with all that they call inlined.
#if defined(__CUDACC__)
#define PL_HD __host__ __device__
#define PL_INLINE __forceinline__ __host__ __device__
#define PL_HD_INLINED __forceinline__ __host__ __device__
#define PL_HOST_APART
#define PL_HD_APART inline __noinline__ __host__ __device__
#else
#define PL_HD
#define PL_INLINE inline __attribute__((always_inline))
#define PL_HD_INLINED inline
#define PL_HOST_APART __attribute__((noinline, flatten))
#define PL_HD_APART inline __attribute__((noinline))
#endif

/// Assertion on host and device; nothing in release builds.
#if defined(NDEBUG)
#define PL_ASSERT(condition) ((void)0)
#elif defined(__CUDA_ARCH__)
#define PL_ASSERT(condition) ((condition) ? (void)0 : __trap())
#else
#define PL_ASSERT(condition) ((condition) ? (void)0 : __builtin_trap())
#endif

namespace pl {

/// Whether this is compiled for a device.
PL_HD constexpr bool is_device_code() {
#if defined(__CUDA_ARCH__)
    return true;
#else
    return false;
#endif
}

/// Arithmetic for conservative bounds, whose slack covers either rounding: the bits differ between back ends, so nothing that
/// decides a bit of a picture may use it. No operand is NaN.
///
/// a b + c with one or two roundings, whose errors are at most an ulp. On a device it is rounded down: a mode that no
/// contraction has, by which the check of the device code recognizes it.
PL_HD inline float bound_multiply_add(float a, float b, float c) {
#if defined(__CUDA_ARCH__)
    return __fmaf_rd(a, b, c);
#else
    return a * b + c;
#endif
}
/// Two numbers, the smaller first. One instruction each: a comparison that chooses would be two on a device, the function a call on
/// some hosts.
struct FloatPair {
    float low, high;
};
PL_HD inline FloatPair in_order(float a, float b) {
#if defined(__CUDA_ARCH__)
    return {fminf(a, b), fmaxf(a, b)};
#else
    return {b < a ? b : a, a < b ? b : a};
#endif
}

/// Threads of a warp that do something together; on the host, this one. Only for the order of work, which changes no result.
class LaneGroup {
public:
    /// The threads that call this at the same time.
    static PL_HD LaneGroup active() {
#if defined(__CUDA_ARCH__)
        return LaneGroup(__activemask());
#else
        return LaneGroup(1u);
#endif
    }

    /// Whether a condition holds in any thread of the group. All of them must call it, and go on together.
    PL_HD bool any(bool condition) const {
#if defined(__CUDA_ARCH__)
        return __any_sync(lanes_, condition) != 0;
#else
        return condition;
#endif
    }

private:
    explicit PL_HD LaneGroup(std::uint32_t lanes) : lanes_(lanes) {}

    std::uint32_t lanes_;
};

/// Number of the lowest bit that is set; there must be one.
PL_HD inline std::uint32_t lowest_bit(std::uint32_t bits) {
#if defined(__CUDA_ARCH__)
    return static_cast<std::uint32_t>(__ffs(static_cast<int>(bits))) - 1u;
#else
    return static_cast<std::uint32_t>(std::countr_zero(bits));
#endif
}

}  // namespace pl
