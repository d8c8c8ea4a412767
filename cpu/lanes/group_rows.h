// Loads and stores of lanes: rows of a group, and members of arrays of structures. Included by one file per instruction set; see lanes.h.
#pragma once

#include "cpu/base/lane_kernels.h"
#include "cpu/lanes/lanes.h"

namespace pl {
namespace {

/// Four words of a structure of each lane, as rows.
struct WordBlock {
    LaneInt rows[4];
};

/// Loads words [first, first + 4) of the structures at index[lane], whose size is `size` words: whole loads that are transposed take
/// a quarter of the time of as many gathers.
template <std::int32_t size>
PL_INLINE WordBlock load_block(const void* structures, const std::int32_t (&index)[kLaneWidth], std::size_t first) {
    const auto at = [&](std::uint32_t lane) {
        FourWords words;
        std::memcpy(&words,
                    static_cast<const char*>(structures) +
                        4 * (std::ptrdiff_t{size} * index[lane] + static_cast<std::ptrdiff_t>(first)),
                    sizeof words);
        return words;
    };
    LaneInt r[4];
    for (std::uint32_t i = 0; i < 4; ++i) r[i] = join_quarters(at, i);
    const LaneInt xy01 = interleave_words<0>(r[0], r[1]);
    const LaneInt zw01 = interleave_words<2>(r[0], r[1]);
    const LaneInt xy23 = interleave_words<0>(r[2], r[3]);
    const LaneInt zw23 = interleave_words<2>(r[2], r[3]);
    return {
        {join_pairs<0>(xy01, xy23), join_pairs<2>(xy01, xy23), join_pairs<0>(zw01, zw23), join_pairs<2>(zw01, zw23)}};
}

/// The vectors at index[lane] of an array of at least two: four words each, from the one before the vector on, in whole loads.
PL_INLINE Real3<Lanes> load_vectors(const Vec3f* array, const LaneInt& index) {
    const LaneInt is_first = index == 0;  // nothing is before it: true is -1
    std::int32_t words[kLaneWidth];
    store_lanes(index * 3 - 1 - is_first, words);
    const WordBlock block = load_block<1>(array, words, 0);
    return {Lanes::from_bits(select(is_first, block.rows[0], block.rows[1])),
            Lanes::from_bits(select(is_first, block.rows[1], block.rows[2])),
            Lanes::from_bits(select(is_first, block.rows[2], block.rows[3]))};
}

/// The members of arrays of structures that consist of 32-bit words.
template <class T>
class Words {
public:
    static_assert(sizeof(T) % 4 == 0);
    PL_INLINE Words(const T* array, const LaneInt& index) : words_(array), first_(index * kSize) {
        if constexpr (kSize >= 4) {
            std::int32_t indices[kLaneWidth];
            store_lanes(index, indices);
            for (std::size_t i = 0; i < kBlocks; ++i) blocks_[i] = load_block<kSize>(array, indices, first_of(i));
        }
    }

    PL_INLINE LaneInt integer(std::size_t offset) const {
        const std::size_t word = offset / 4;
        if (kBlocks == 0) return Lanes::load_word(words_, first_ + static_cast<std::int32_t>(word));
        const std::size_t block = word / 4;
        return blocks_[block].rows[word - first_of(block)];
    }
    PL_INLINE LaneFloat real(std::size_t offset) const { return Lanes::from_bits(integer(offset)); }
    PL_INLINE Real3<Lanes> vector(std::size_t offset) const {
        return {real(offset), real(offset + 4), real(offset + 8)};
    }

private:
    static constexpr std::int32_t kSize = sizeof(T) / 4;
    /// Structures of fewer words than a block are gathered.
    static constexpr std::size_t kBlocks = kSize < 4 ? 0 : (kSize + 3) / 4;
    /// The last block ends with the structure.
    static constexpr std::size_t first_of(std::size_t block) {
        return 4 * block + 4 <= kSize ? 4 * block : static_cast<std::size_t>(kSize) - 4;
    }

    const T* words_;
    LaneInt first_;
    WordBlock blocks_[kBlocks > 0 ? kBlocks : 1];
};

/// The functions of a Vec3f, in lanes.
PL_INLINE LaneFloat max_component(const Real3<Lanes>& v) { return larger(larger(v.z, v.y), v.x); }
PL_INLINE LaneInt is_black(const Real3<Lanes>& v) { return (v.x == 0.0f) & (v.y == 0.0f) & (v.z == 0.0f); }

/// Lanes [first, first + kLaneWidth) of groups of kGroupSize.
class GroupRows {
public:
    explicit PL_INLINE GroupRows(std::uint32_t first) : first_(first) {}

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
