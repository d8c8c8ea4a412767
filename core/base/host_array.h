// HostArray: the array type of Storage<Array> templates on the host. Device back ends have their own.
#pragma once

#include <cstdint>
#include <vector>

#include "core/kernel/base/span.h"

namespace pl {

template <class T>
using HostArray = std::vector<T>;

template <class T, class Allocator>
Span<const T> view_of(const std::vector<T, Allocator>& array) {
    return {array.data(), static_cast<std::uint32_t>(array.size())};
}
template <class T, class Allocator>
Span<T> view_of(std::vector<T, Allocator>& array) {
    return {array.data(), static_cast<std::uint32_t>(array.size())};
}

}  // namespace pl
