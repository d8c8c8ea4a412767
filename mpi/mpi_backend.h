// The back end of rank 0: it leads the back ends of all ranks, which share the paths of every pass.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "core/session/exact_backend.h"
#include "mpi/communicator.h"
#include "mpi/shares.h"

namespace pl {

/// Makes the back end of a rank: "auto", "cpu", "cuda"; threads 0: all of the rank. Throws Error(Unavailable).
using RankBackendFactory = std::function<std::unique_ptr<RenderBackend>(const std::string& name, int threads)>;

/// Opens a back end on every rank. The back ends of the other ranks do the rendering of follow_rank_0(). Films,
/// fields and counters equal the result of one rank, to the bit. `share_pixels`: see Shares. Throws
/// Error(Unavailable) with the first rank that has none of this kind.
std::unique_ptr<RenderBackend> make_mpi_backend(Communicator& ranks, const RankBackendFactory& make,
                                                const std::string& name, int threads,
                                                std::uint32_t share_pixels = Shares::kMostPixels);

/// The whole work of a rank other than 0: takes part in commands until rank 0 ends the job. `called` is the answer to call_ranks().
void follow_rank_0(Communicator& ranks, const RankBackendFactory& make, const std::function<void()>& called = {});

/// On rank 0: lets the other ranks do work of their own, which exchanges its messages itself.
void call_ranks(Communicator& ranks);

/// On rank 0: lets the other ranks return from follow_rank_0().
void end_ranks(Communicator& ranks);

}  // namespace pl
