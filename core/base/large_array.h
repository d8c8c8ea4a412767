// LargeArray: a HostArray for what is read in no order and does not fit the caches. Rows of 64 bytes lie in one line of
// the cache each, and the system is asked for large pages, so that a read seldom waits for the page tables.
#pragma once

#include <cstddef>
#include <vector>

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
using LargeArray = std::vector<T, LargeAllocator<T>>;

}  // namespace pl
