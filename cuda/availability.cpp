#include "cuda/availability.h"

namespace pl {

std::string cuda_unavailable_reason() {
    if constexpr (PL_CUDA_SWITCHED_OFF) {
        return "not built: configured with PL_CUDA=OFF";
    } else {
        return "not built: this version has no CUDA back end";
    }
}

}  // namespace pl
