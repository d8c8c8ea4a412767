// Numbers of distinct positions: files list the corners of neighboring triangles more than once.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "core/kernel/base/hash.h"
#include "core/kernel/base/math.h"

namespace pl {

/// A table with open addressing. +0 and -0 are equal.
class PositionNumbers {
public:
    /// For up to `most` calls of number_of().
    explicit PositionNumbers(std::size_t most) : slots_(std::bit_ceil(2 * most + 1), kFree) {}

    /// The number of a position: positions are numbered from 0 in the order of their first calls.
    std::uint32_t number_of(const Vec3f& position) {
        const std::size_t slot = slot_of(position);
        if (slots_[slot] == kFree) {
            slots_[slot] = count();
            positions_.push_back(position);
        }
        return slots_[slot];
    }
    /// The number of a position that has one; else kFree.
    std::uint32_t find(const Vec3f& position) const { return slots_[slot_of(position)]; }
    std::uint32_t count() const { return static_cast<std::uint32_t>(positions_.size()); }
    const Vec3f& position(std::uint32_t number) const { return positions_[number]; }

    static constexpr std::uint32_t kFree = 0xffffffffu;

private:
    static std::size_t hash(const Vec3f& position) {
        std::uint32_t hash = 0;
        for (int i = 0; i < 3; ++i) hash = hash_word(hash, std::bit_cast<std::uint32_t>(position[i] + 0.0f));
        return hash;
    }

    /// Where a position is, or would be.
    std::size_t slot_of(const Vec3f& position) const {
        const std::size_t mask = slots_.size() - 1;
        std::size_t slot = hash(position) & mask;
        while (slots_[slot] != kFree && positions_[slots_[slot]] != position) slot = (slot + 1) & mask;
        return slot;
    }

    std::vector<std::uint32_t> slots_;  ///< number of the position, or kFree
    std::vector<Vec3f> positions_;      ///< [number]
};

}  // namespace pl
