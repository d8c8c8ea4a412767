#include "core/base/host_array.h"

#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace pl {
namespace {

constexpr std::size_t kCacheLine = 64;
constexpr std::size_t kLargePage = std::size_t{1} << 21;

std::align_val_t alignment_of(std::size_t bytes) {
    return std::align_val_t{bytes < kLargePage ? kCacheLine : kLargePage};
}

}  // namespace

void* allocate_large(std::size_t bytes) {
    void* const memory = ::operator new(bytes, alignment_of(bytes));
#ifdef __linux__
    // A hint: without it memory is only slower. The rest after the last whole huge page is excluded.
    if (bytes >= kLargePage) (void)madvise(memory, bytes / kLargePage * kLargePage, MADV_HUGEPAGE);
#endif
    return memory;
}

void free_large(void* memory, std::size_t bytes) noexcept { ::operator delete(memory, alignment_of(bytes)); }

}  // namespace pl
