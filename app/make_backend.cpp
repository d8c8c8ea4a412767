#include "app/make_backend.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "cpu/cpu_backend.h"
#include "cuda/availability.h"
#include "cuda/cuda_backend.h"
#include "mpi/job.h"
#include "mpi/mpi_backend.h"

namespace pl {
namespace {

// The job is a fact of the whole process.
Communicator* job = nullptr;

/// Null if CUDA is absent, or present but not working.
std::unique_ptr<RenderBackend> cuda_if_possible() {
    if (!cuda_unavailable_reason().empty()) return nullptr;
    try {
        return make_cuda_backend();
    } catch (const Error& error) {
        if (error.kind() != ErrorKind::Unavailable) throw;
        return nullptr;
    }
}

}  // namespace

std::string backend_name(const std::string& name) {
    if (name == "cpu") return name;
    const std::string reason = cuda_unavailable_reason();
    if (name == "auto") return reason.empty() ? "cuda" : "cpu";
    if (!reason.empty())
        throw Error(ErrorKind::Unavailable,
                    "--backend cuda: " + reason + "; 'pathlight devices' lists what there is");
    return name;
}

void share_over(Communicator* ranks) { job = ranks; }
Communicator* shared_ranks() { return job; }

std::unique_ptr<RenderBackend> make_backend(const std::string& name, int threads,
                                            const RankBackendFactory& make_own) {
    if (job != nullptr) return make_mpi_backend(*job, make_own, name, threads);
    return make_own(name, threads);
}

int usable_share() { return std::max(1, usable_threads() / std::max(1, ranks_on_this_machine())); }

std::unique_ptr<RenderBackend> make_own_backend(const std::string& name, int threads) {
    if (threads == 0 && ranks_on_this_machine() > 1) threads = usable_share();
    if (backend_name(name) == "cuda") {
        if (name == "cuda") return make_cuda_backend();
        if (auto cuda = cuda_if_possible()) return cuda;
    }
    return make_cpu_backend({.threads = threads});
}

std::string why_no_cuda() {
    if (const std::string reason = cuda_unavailable_reason(); !reason.empty()) return reason;
    try {
        (void)make_cuda_backend();
        return "";
    } catch (const Error& error) {
        const std::string text = error.what();
        return text.substr(text.starts_with("CUDA: ") ? 6 : 0);
    }
}

std::vector<std::string> available_backends() {
    std::vector<std::string> names{"cpu"};
    if (cuda_if_possible()) names.emplace_back("cuda");
    return names;
}

}  // namespace pl
