// Paths that go on from one vertex in several directions: branches, one after the other, in the state of one path. So a pixel
// still has one writer, and a pass still counts paths.
#pragma once

#include <cstdint>

#include "core/kernel/geometry/ray.h"
#include "core/kernel/methods/method.h"

namespace pl {

/// Branches of a path at most, itself among them: splitting is bounded however wrong an opinion is.
inline constexpr std::uint32_t kMostBranches = 32;
/// Vertices at most from which branches wait at the same time.
inline constexpr std::uint32_t kMostForks = 4;
/// Branch b draws the random numbers of its vertex v at b 2^kBranchShift + v: no path has so many vertices.
inline constexpr std::uint32_t kBranchShift = 17;
static_assert((kMostBranches << kBranchShift) < (1u << 24));

/// A vertex from which branches wait to leave.
template <class Vertex>
struct Fork {
    Vec3f wo;
    Hit hit;
    Vec3f throughput;
    float survival;
    std::uint32_t vertices;
    std::uint32_t waiting;
    Vertex vertex;  ///< what the method knows about it
};

template <class Vertex>
struct Branches {
    std::uint32_t number = 0;   ///< of the one under way
    std::uint32_t waiting = 0;  ///< at all forks
    std::uint32_t forks = 0;
    Fork<Vertex> stack[kMostForks];

    /// How many may go on from a vertex, now.
    PL_HD std::uint32_t room() const { return forks < kMostForks ? kMostBranches - number - waiting : 1u; }

    PL_HD void wait(const Fork<Vertex>& fork) {
        stack[forks++] = fork;
        waiting += fork.waiting;
    }
    /// The newest fork, for the next branch. Only while some wait.
    PL_HD Fork<Vertex> begin() {
        Fork<Vertex>& fork = stack[forks - 1];
        if (--fork.waiting == 0) --forks;
        --waiting;
        ++number;
        return fork;
    }
};

/// What the state of a path keeps of them.
template <class M>
struct BranchesOf {};
template <SplittingMethod M>
struct BranchesOf<M> : Branches<typename M::Vertex> {};

}  // namespace pl
