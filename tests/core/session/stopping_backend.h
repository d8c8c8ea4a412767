// A back end that a test stops within a pass, at a path of the test's choice.
#pragma once

#include <optional>

#include "tests/core/session/forwarding_backend.h"

namespace pl::test {

/// The CPU back end, whose next pass of a film stops behind a number of paths, as by a stop flag that is raised there.
class StoppingBackend final : public ForwardingBackend {
public:
    /// Paths of the next pass, fewer than it has; empty: it is complete.
    std::optional<std::uint32_t> stops_behind;

    PassCounters run_pass(const PassRequest& request) override {
        PassRequest part = request;
        if (stops_behind) {
            part.end_pixel = request.first_pixel + *stops_behind;
            part.most_passes = 1;
            stops_behind.reset();
        }
        return ForwardingBackend::run_pass(part);
    }
};

}  // namespace pl::test
