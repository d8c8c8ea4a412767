// What the paths of one thread learn, on its way into the tables. Threads share the sums of volumes, and a record is up to six
// additions: atomic ones made segments of two threads a sixth slower than plain ones. So records wait, sorted by ranges of
// volumes, until a range has enough of them to be worth its lock. Sums are integers: the order changes no bit.
#pragma once

#include <algorithm>
#include <bit>
#include <concepts>
#include <mutex>
#include <type_traits>
#include <vector>

#include "core/kernel/methods/guided.h"

namespace pl {

template <class M>
concept GuidedMethod = std::derived_from<M, GuidedSampling>;

/// Methods whose records are complete where learn() makes them.
template <class M>
inline constexpr bool kMakesRecords = !std::is_empty_v<typename M::Record>;

/// One lock for each of some ranges of volumes. Whoever adds to the sums of a volume without atomic operations holds its lock.
class VolumeLocks {
public:
    static constexpr std::uint32_t kRanges = 64;

    explicit VolumeLocks(std::uint32_t volumes)
        : shift_(static_cast<std::uint32_t>(std::bit_width((std::max(volumes, 1u) - 1u) / kRanges))) {}

    std::uint32_t range_of(std::int32_t volume) const { return static_cast<std::uint32_t>(volume) >> shift_; }
    std::mutex& of_range(std::uint32_t range) { return locks_[range].mutex; }

private:
    struct alignas(64) Lock {
        std::mutex mutex;
    };

    std::uint32_t shift_;
    Lock locks_[kRanges];
};

/// The records of one thread; most methods make none.
template <GuidedMethod M>
class GuidedRecords {
public:
    GuidedRecords(const M&, VolumeLocks&) {}
    void push(const typename M::Record&) {}
    void commit() {}
};

template <GuidedMethod M>
requires kMakesRecords<M>
class GuidedRecords<M> {
public:
    GuidedRecords(const M& method, VolumeLocks& locks)
        : method_(method), locks_(locks), ranges_(VolumeLocks::kRanges) {
        method_.field.writers = Writers::One;
    }

    /// Asks for the cell, which is not in the caches, and keeps the record until it has come.
    void push(const typename M::Record& record) {
        if (record.volume == kNoVolume) return;
        const std::uint32_t cell = method_.field.cell_index(record.volume, record.cell);
        __builtin_prefetch(method_.field.pending_sum.data + cell, 1);
        __builtin_prefetch(method_.field.pending_count.data + cell, 1);
        const std::uint32_t number = locks_.range_of(record.volume);
        Range& range = ranges_[number];
        range.records[range.count++] = record;
        if (range.count == kCapacity) commit(number);
    }

    /// Adds all to the sums. Nothing may be left when the last path has ended.
    void commit() {
        for (std::uint32_t range = 0; range < VolumeLocks::kRanges; ++range) commit(range);
    }

private:
    static constexpr std::uint32_t kCapacity = 16;

    struct Range {
        std::uint32_t count = 0;
        typename M::Record records[kCapacity];
    };

    [[gnu::flatten, gnu::noinline]] void commit(std::uint32_t number) {
        Range& range = ranges_[number];
        const std::lock_guard lock(locks_.of_range(number));
        for (std::uint32_t i = 0; i < range.count; ++i) method_.commit(range.records[i]);
        range.count = 0;
    }

    M method_;
    VolumeLocks& locks_;
    std::vector<Range> ranges_;
};

}  // namespace pl
