// Splitting: a path continues from one vertex in several directions. Its branches are traced one after the other in the state
// of one path, so that a pixel keeps one writer and a pass one count of paths.
#pragma once

#include <cstdint>
#include <utility>

#include "core/kernel/geometry/ray.h"
#include "core/kernel/methods/method.h"

namespace pl {

/// Most branches of a path, itself included: bounds the time spent on a wrong contribution estimate.
inline constexpr std::uint32_t kMostBranches = 32;
/// Most vertices with branches waiting at the same time.
inline constexpr std::uint32_t kMostForks = 4;
/// Vertex v of branch b draws random numbers by the index b 2^kBranchShift + v; no path has so many vertices.
inline constexpr std::uint32_t kBranchShift = 17;
static_assert((kMostBranches << kBranchShift) < (1u << 24));

/// The data that a fork keeps of a vertex. Of a field with keep() and restore() part of them lies elsewhere, until the next vertex only.
template <class M>
PL_HD auto keep_vertex([[maybe_unused]] const M& method, const typename M::Vertex& vertex) {
    if constexpr (requires { method.field.keep(vertex); })
        return method.field.keep(vertex);
    else
        return vertex;
}
template <class M>
using KeptVertex = decltype(keep_vertex(std::declval<const M&>(), std::declval<const typename M::Vertex&>()));
template <class M>
PL_HD typename M::Vertex restore_vertex([[maybe_unused]] const M& method, const KeptVertex<M>& kept) {
    if constexpr (requires { method.field.restore(kept); })
        return method.field.restore(kept);
    else
        return kept;
}

/// A vertex with branches waiting to be scattered. Vertex: a KeptVertex.
template <class Vertex>
struct Fork {
    Vec3f wo;
    Hit hit;
    Vec3f throughput;
    float survival;
    std::uint32_t vertices;
    std::uint32_t waiting;
    Vertex vertex;
};

/// The forks are kept outside of the path's state, which so stays small: few paths are split, and on a device each thread has only
/// little memory of its own.
template <class Vertex>
struct Branches {
    std::uint32_t number = 0;   ///< of the current branch
    std::uint32_t waiting = 0;  ///< branches at all forks
    std::uint32_t forks = 0;
    Fork<Vertex>* stack = nullptr;  ///< kMostForks, given by keep_store(); not used unless paths are split

    /// Most branches that may continue from the current vertex.
    PL_HD std::uint32_t room() const { return forks < kMostForks ? kMostBranches - number - waiting : 1u; }

    PL_HD void wait(const Fork<Vertex>& fork) {
        stack[forks++] = fork;
        waiting += fork.waiting;
    }
    /// Takes the next branch from the newest fork. Only while some wait.
    PL_HD Fork<Vertex> begin() {
        Fork<Vertex>& fork = stack[forks - 1];
        if (--fork.waiting == 0) --forks;
        --waiting;
        ++number;
        return fork;
    }
};

/// The branches in the state of a path: none unless its method splits.
template <class M>
struct BranchesOf {};
template <SplittingMethod M>
struct BranchesOf<M> : Branches<KeptVertex<M>> {};

/// Memory of a path outside of its state, which its driver provides: for the method's Store, and for forks.
template <class M>
struct PathStore {
    [[no_unique_address]] typename M::Store method;
};
template <SplittingMethod M>
struct PathStore<M> {
    [[no_unique_address]] typename M::Store method;
    Fork<KeptVertex<M>> forks[kMostForks];
};

}  // namespace pl
