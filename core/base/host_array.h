// HostArray: what Storage<Array> templates are instantiated with on the host. Device back ends bring their own. It is read in
// no order and often larger than the caches: rows of 64 bytes lie in one line of the cache each, and the system is asked for
// large pages, so that a read seldom waits for the page tables.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/kernel/base/span.h"

namespace pl {

/// Bytes that begin at a cache line. Throws std::bad_alloc.
void* allocate_large(std::size_t bytes);
/// Gives them back; `bytes` as asked for.
void free_large(void* memory, std::size_t bytes) noexcept;

template <class T>
struct LargeAllocator {
    using value_type = T;

    LargeAllocator() = default;
    template <class U>
    LargeAllocator(const LargeAllocator<U>&) {}

    T* allocate(std::size_t count) { return static_cast<T*>(allocate_large(count * sizeof(T))); }
    void deallocate(T* memory, std::size_t count) noexcept { free_large(memory, count * sizeof(T)); }

    friend bool operator==(const LargeAllocator&, const LargeAllocator&) { return true; }
};

template <class T>
using HostArray = std::vector<T, LargeAllocator<T>>;

template <class T, class Allocator>
Span<const T> view_of(const std::vector<T, Allocator>& array) {
    return {array.data(), static_cast<std::uint32_t>(array.size())};
}
template <class T, class Allocator>
Span<T> view_of(std::vector<T, Allocator>& array) {
    return {array.data(), static_cast<std::uint32_t>(array.size())};
}

}  // namespace pl
