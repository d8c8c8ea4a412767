#include "core/session/exact_backend.h"

#include "core/base/error.h"

namespace pl {

ExactBackend& exact(RenderBackend& backend) {
    if (auto* const found = dynamic_cast<ExactBackend*>(&backend)) return *found;
    throw Error(ErrorKind::Unavailable,
                "back end '" + backend.info().name +
                    "': its films cannot be taken out, which a checkpoint needs: expected cpu or cuda");
}

}  // namespace pl
