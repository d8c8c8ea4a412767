// The layout as the device compiler has it: a kernel that stores the same numbers as print_layout, in order. check_layout.sh reads
// them from its PTX, where they are constants: no device is needed.
#include "tests/cuda/layout/walk_layout.h"

namespace {

struct Storer {
    volatile unsigned* out;

    template <class T>
    __device__ void type(std::size_t size, std::size_t alignment) const {
        *out = static_cast<unsigned>(size);
        *out = static_cast<unsigned>(alignment);
    }
    template <class M>
    __device__ void member(std::uint32_t offset) const {
        *out = offset;
    }
};

}  // namespace

__global__ void store_layout(volatile unsigned* out) {
    Storer storer{out};
    pl::layout::walk_kernels(storer);
}
