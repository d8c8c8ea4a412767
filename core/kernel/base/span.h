// Span<T>: a pointer and a 32-bit count. std::span is not usable in device code without relaxed constexpr.
#pragma once

#include <cstdint>
#include <type_traits>

#include "core/kernel/base/platform.h"

namespace pl {

template <class T>
struct Span {
    T* data = nullptr;
    std::uint32_t count = 0;

    Span() = default;
    PL_HD Span(T* pointer, std::uint32_t size) : data(pointer), count(size) {}

    /// Span<T> converts to Span<const T>.
    template <class U>
    requires std::is_same_v<const U, T> PL_HD Span(Span<U> other) : data(other.data), count(other.count) {}

    PL_HD T& operator[](std::uint32_t index) const {
        PL_ASSERT(index < count);
        return data[index];
    }
    PL_HD bool empty() const { return count == 0; }
    PL_HD T* begin() const { return data; }
    PL_HD T* end() const { return data + count; }
};

}  // namespace pl
