// Huge pages for large arrays of any allocator. Fresh memory costs more per page than most loops per element, so this is
// for arrays that are filled once.
#pragma once

#include <cstddef>

namespace pl {

/// Asks the system to back memory that is not yet touched by huge pages. A hint: without it memory is only slower.
void prefer_huge_pages(void* memory, std::size_t bytes);

/// Reserves memory of a vector or string that is empty.
template <class Array>
void reserve_huge(Array& array, std::size_t count) {
    array.reserve(count);
    prefer_huge_pages(array.data(), count * sizeof(array[0]));
}

/// Sets the size of a vector or string that is empty.
template <class Array>
void resize_huge(Array& array, std::size_t count) {
    reserve_huge(array, count);
    array.resize(count);
}

}  // namespace pl
