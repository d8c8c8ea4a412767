// The picture kernels of one entry of MethodList, PL_METHOD_ENTRY; see cuda/CMakeLists.txt.
#include "cuda/kernels/trace.cuh"

namespace pl::cuda {

template <>
const PictureKernels<PL_METHOD_ENTRY>& picture_kernels<PL_METHOD_ENTRY>() {
    static constexpr PictureKernels<PL_METHOD_ENTRY> kKernels = make_picture_kernels<PL_METHOD_ENTRY>();
    return kKernels;
}

}  // namespace pl::cuda
