// Queues of one thread's training samples and light samples, one per range of volumes. Threads share the pending sums of a table, and a
// sample is up to six additions; with two threads, atomic additions made a segment one sixth slower than plain ones.
// A queue is added under the lock of its range once it is full. The sums are integers, so their order changes no bit.
#pragma once

#include <algorithm>
#include <bit>
#include <concepts>
#include <mutex>
#include <type_traits>
#include <vector>

#include "core/kernel/guiding/table_field.h"
#include "core/kernel/methods/guided.h"

namespace pl {

/// Methods guided by tables: the CPU back end looks up volumes and samples directions for blocks of their paths.
template <class M>
concept TableGuided = GuidedMethod<M> && std::same_as<typename M::Field, TableField>;

/// One lock per range of volumes, held while adding to their pending sums without atomic operations.
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

/// A training sample in a queue.
template <class M>
struct QueuedSample {
    typename M::Sample sample;

    static std::int32_t volume_of(const typename M::Sample& sample) { return sample.entry.volume; }
    void prefetch(const TableField& field) const {
        const std::uint32_t cell = field.cell_index(sample.entry.volume, sample.entry.cell);
        __builtin_prefetch(field.pending_sum.data + cell, 1);
        __builtin_prefetch(field.pending_count.data + cell, 1);
    }
    void add_to(const M& method) const { method.record(sample); }
};

/// A light sample in a queue.
template <class M>
struct QueuedLight {
    typename M::Light light;
    bool is_visible = false;

    static std::int32_t volume_of(const typename M::Light& light, bool) { return light.location.volume; }
    void prefetch(const TableField&) const {}  // there are few volumes
    void add_to(const M& method) const { method.record_light(light, is_visible); }
};

/// `Item` is QueuedSample or QueuedLight.
template <class M, class Item>
class TrainingQueue {
public:
    TrainingQueue(const M& method, VolumeLocks& locks)
        : method_(method), locks_(locks), ranges_(VolumeLocks::kRanges) {
        method_.field.writers = Writers::One;
    }

    /// Queues an item, unless it has no volume, and prefetches the pending sums that it is added to.
    void push(const auto&... parts) {
        const std::int32_t volume = Item::volume_of(parts...);
        if (volume == kNoVolume) return;
        const std::uint32_t number = locks_.range_of(volume);
        Range& range = ranges_[number];
        // Constructed in place: the wide loads of a copy would wait for the narrow stores before them.
        ::new (static_cast<void*>(&range.items[range.count])) Item{parts...};
        range.items[range.count++].prefetch(method_.field);
        if (range.count == kCapacity) flush(number);
    }

    /// Adds all queued items to the pending sums. Call after the thread's last path.
    void flush() {
        for (std::uint32_t range = 0; range < VolumeLocks::kRanges; ++range) flush(range);
    }

private:
    static constexpr std::uint32_t kCapacity = 16;

    struct Range {
        std::uint32_t count = 0;
        Item items[kCapacity];
    };

    [[gnu::flatten, gnu::noinline]] void flush(std::uint32_t number) {
        Range& range = ranges_[number];
        const std::lock_guard lock(locks_.of_range(number));
        for (std::uint32_t i = 0; i < range.count; ++i) range.items[i].add_to(method_);
        range.count = 0;
    }

    M method_;
    VolumeLocks& locks_;
    std::vector<Range> ranges_;
};

}  // namespace pl
