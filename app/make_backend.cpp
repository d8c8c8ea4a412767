#include "app/make_backend.h"

#include "core/base/error.h"
#include "cpu/cpu_backend.h"
#include "cuda/availability.h"

namespace pl {

std::unique_ptr<RenderBackend> make_backend(const std::string& name, int threads) {
    if (name == "cuda")
        throw Error(ErrorKind::Unavailable,
                    "--backend cuda: " + cuda_unavailable_reason() + "; 'pathlight devices' lists what there is");
    return make_cpu_backend({.threads = threads});
}

}  // namespace pl
