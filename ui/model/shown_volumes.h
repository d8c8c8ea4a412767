// The volumes whose distributions are on screen, at the time that is shown, and the scale that all their displays share.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "ui/model/viewer_model.h"

namespace pl::ui {

struct ShownVolume {
    std::shared_ptr<const VolumeInspection> volume{};  ///< with cells; never null
    std::uint32_t color = 0xffffffffu;                 ///< of its pin, 0xAABBGGRR; white if it is only selected
    bool is_selected = false;
};
/// The selected volume, then the pinned ones, each once; without those that no frame has brought yet.
std::vector<ShownVolume> shown_volumes(ViewerModel& model);

/// One disc of the selected volume: the learned radiance, at the shown time and now, and the true light if it is to be shown.
struct ShownDisc {
    std::string caption;
    std::vector<float> values;  ///< [cell]; empty as long as the true light is not known
};
/// `selected`: of shown_volumes().
std::vector<ShownDisc> shown_discs(const ViewerModel& model, const VolumeInspection& selected);

/// The range of colors of discs, lobes and pins together.
ValueRange shown_range(const ViewerModel& model, const std::vector<ShownVolume>& volumes);

/// How far probabilities of the same cells are apart.
struct ShareDifference {
    double divergence = 0.0;  ///< Kullback-Leibler, of `now` from `then`, nats; infinite where `then` has no share
    double total_variation = 0.0;  ///< in [0, 1]
};
ShareDifference difference(const std::vector<float>& now, const std::vector<float>& then);

}  // namespace pl::ui
