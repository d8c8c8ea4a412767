// The choice of the picture to drop when the pictures of live runs exceed their memory.
#pragma once

#include <memory>
#include <vector>

#include "core/measure/live_run.h"

namespace pl {

/// A picture by its place: a run, and a point of it.
struct PicturePlace {
    std::size_t run = 0;
    std::size_t point = 0;
};

/// The picture that is needed least: of the oldest run that shows another picture than `present` (a picture_key()), if there
/// is one; else the one whose neighbors in time are closest to each other. The last picture of a run goes at the end. At
/// least one picture is left.
PicturePlace least_needed_picture(const std::vector<std::shared_ptr<const LiveRun>>& runs, std::uint64_t present);

}  // namespace pl
