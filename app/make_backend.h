// From a back end's name to a back end.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/session/backend.h"
#include "mpi/communicator.h"
#include "mpi/mpi_backend.h"

namespace pl {

/// The back end, "cpu" or "cuda", that make_backend() is going to make, as far as can be told in no time: by whether there is a
/// device, not by whether it works. Throws as make_backend().
std::string backend_name(const std::string& name);

/// A back end of this process alone, see make_backend(). `threads` 0: all of usable_share().
std::unique_ptr<RenderBackend> make_own_backend(const std::string& name, int threads);
/// "auto" takes CUDA if it is available, else the CPU; "cpu" and "cuda" insist. `threads` 0: all. In a job of mpirun all ranks share
/// its work, and it belongs to one thread; `make_own` makes the part of this rank. Throws Error(Unavailable) with the reason.
std::unique_ptr<RenderBackend> make_backend(const std::string& name, int threads,
                                            const RankBackendFactory& make_own = make_own_backend);

/// Hardware threads of this process: ranks of one machine share them. At least 1.
int usable_share();

/// The ranks that make_backend() shares the work of later back ends over; null: none. They outlive the back ends.
void share_over(Communicator* ranks);
/// Null without a job of mpirun.
Communicator* shared_ranks();

/// Reason why CUDA does not work, empty if it does. Creates a context.
std::string why_no_cuda();

/// Names of the back ends that make_backend() can make on this machine.
std::vector<std::string> available_backends();

}  // namespace pl
