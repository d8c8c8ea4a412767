// Loads and stores of lanes: rows of a group, and members of arrays of structures. Included by one file per instruction set; see lanes.h.
#pragma once

#include "cpu/lane_kernels.h"
#include "cpu/lanes.h"

namespace pl {
namespace {

/// The members of arrays of structures that consist of 32-bit words.
template <class T>
class Words {
public:
    static_assert(sizeof(T) % 4 == 0);
    PL_INLINE Words(const T* array, const LaneInt& index)
        : words_(array), first_(index * static_cast<std::int32_t>(sizeof(T) / 4)) {}

    PL_INLINE LaneInt integer(std::size_t offset) const {
        return Lanes::load_word(words_, first_ + static_cast<std::int32_t>(offset / 4));
    }
    PL_INLINE LaneFloat real(std::size_t offset) const { return Lanes::from_bits(integer(offset)); }
    PL_INLINE Real3<Lanes> vector(std::size_t offset) const {
        return {real(offset), real(offset + 4), real(offset + 8)};
    }

private:
    const T* words_;
    LaneInt first_;
};

/// Lanes [first, first + kLaneWidth) of groups of kGroupSize.
class GroupRows {
public:
    explicit PL_INLINE GroupRows(std::uint32_t first) : first_(first) {}

protected:
    PL_INLINE std::uint32_t first() const { return first_; }
    /// The lanes whose bit is set: bit i stands for lane i of the group.
    PL_INLINE LaneInt lanes_of(std::uint32_t bits) const {
        LaneUint bit;
        for (std::uint32_t lane = 0; lane < kLaneWidth; ++lane) bit[lane] = 1u << lane;
        return (broadcast(bits >> first_) & bit) != 0u;
    }
    PL_INLINE LaneFloat row(const float* values) const { return load_lanes<LaneFloat>(values + first_); }
    template <class T>
    PL_INLINE LaneInt integers(const T* values) const {
        return load_lanes<LaneInt>(values + first_);
    }
    PL_INLINE Real3<Lanes> vector(const VectorGroup& group) const {
        return {row(group.x), row(group.y), row(group.z)};
    }
    PL_INLINE void store(const LaneFloat& lanes, float* values) const { store_lanes(lanes, values + first_); }
    template <class T>
    PL_INLINE void store(const LaneInt& lanes, T* values) const {
        store_lanes(lanes, values + first_);
    }
    PL_INLINE void store(const Real3<Lanes>& lanes, VectorGroup& group) const {
        store(lanes.x, group.x);
        store(lanes.y, group.y);
        store(lanes.z, group.z);
    }

private:
    std::uint32_t first_;
};

}  // namespace
}  // namespace pl
