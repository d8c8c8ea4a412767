// The passes of a picture as data: enough to trace any of their paths again in another thread and at a later time.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/session/backend.h"

namespace pl {

/// Taken from a session at one moment; see Session::pass_replay(). May move to another thread.
struct PassReplay {
    int width = 0;
    int height = 0;
    std::uint32_t first_sample = 0;  ///< number of the first pass
    std::uint32_t samples = 0;       ///< complete passes
    std::uint32_t next_pixel = 0;    ///< of the pass under way: pixels before it have one more sample
    /// Invalid samples of each pixel, as the film counts them; empty if there are none. [row][column]
    std::vector<std::uint32_t> invalid{};

    std::shared_ptr<const HostScene> scene{};
    PathSettings path{};
    Camera camera{};
    bool is_closed = false;  ///< closed surfaces surround the camera

    std::shared_ptr<const HostVolumes> volumes{};  ///< null for methods without a field, for which the rest is unset
    FieldShape shape{};
    HostField field{};
    MixtureSettings mixture{};
    LearningSettings learning{};
    PathSettings unguided_path{};           ///< of passes that are not guided
    std::vector<std::uint32_t> switches{};  ///< passes by which guiding begins or ends; the first pass is guided
    bool has_moving_tables = false;         ///< updates have changed the tables since they were sampled by the passes
    bool repeats_training = false;          ///< a path traced again makes the same training samples as in its pass

    /// Whether the pass of this number within the picture is guided; of methods without a field, too.
    bool is_guided(std::uint32_t pass) const {
        return (std::ranges::upper_bound(switches, pass) - switches.begin()) % 2 == 0;
    }
};

}  // namespace pl
