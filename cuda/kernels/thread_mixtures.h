// The neural field of kernels: each thread has one mixture, in shared memory: the mixture of the vertex which its
// path has reached. In the location of a vertex the mixture would lie on the stack several times, and the stacks of
// all threads do not fit the first-level cache.
#pragma once

#include "core/kernel/guiding/neural_field.h"
#include "core/kernel/methods/guided.h"
#include "cuda/runtime/launch.h"

namespace pl::cuda {

/// locate() leaves the mixture to evaluate_network(). For blocks of kThreadsPerBlock.
struct MixturesOfThreads {
    using Location = TableLocation;

    static PL_HD Location locate(const NetworkField&, const TableLocation& place, const SurfacePoint&) {
        return place;
    }
    /// The mixture of this thread.
    static PL_HD VertexMixture& of(const Location&) {
#ifdef __CUDA_ARCH__
        // Its size is an odd number of words, so that the threads of a warp read from different banks.
        __shared__ alignas(VertexMixture) std::byte mixtures[kThreadsPerBlock * sizeof(VertexMixture)];
        return reinterpret_cast<VertexMixture*>(mixtures)[threadIdx.x];
#else
        static thread_local VertexMixture mixture;
        return mixture;
#endif
    }
};
static_assert(sizeof(VertexMixture) / sizeof(float) % 2 == 1);
using ThreadNeuralField = NeuralFieldOf<MixturesOfThreads>;
static_assert(RadianceField<ThreadNeuralField>);

/// The method by which kernels trace the paths of M.
template <class M>
struct KernelMethodOf {
    using Type = M;
};
template <template <class> class Target>
struct KernelMethodOf<Guided<NeuralField, Target>> {
    using Type = Guided<ThreadNeuralField, Target>;
};
template <class M>
using KernelMethod = typename KernelMethodOf<M>::Type;

template <class M>
KernelMethod<M> to_kernel(const M& method) {
    if constexpr (std::is_same_v<KernelMethod<M>, M>) {
        return method;
    } else {
        KernelMethod<M> converted;
        static_cast<NetworkField&>(converted.field) = method.field;
        converted.mixture = method.mixture;
        if constexpr (requires { method.learning; }) converted.learning = method.learning;
        return converted;
    }
}

/// Whether kernels of M evaluate a network for the vertices of a warp, see network_step.cuh.
template <class M>
concept NetworkMethod = GuidedMethod<M> && std::same_as<typename M::Field, ThreadNeuralField>;

}  // namespace pl::cuda
