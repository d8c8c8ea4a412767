// The image of the volumes' cells that lies over the picture: rendered when the volumes or the camera have changed.
#pragma once

#include <cstdint>
#include <memory>

#include "core/session/session.h"
#include "ui/worker/published_frame.h"

namespace pl::ui {

// The colors of the radiance volumes' cells in the picture of View::Voronoi.

/// `colors` is a frame of View::Voronoi.
CellImage make_cell_image(const DisplayFrame& colors);

/// The color of a volume's cell in such a frame. `codes` are those of ToneCurve::Clamp.
std::uint32_t cell_color(std::int32_t volume, const ToneCodes& codes);

class CellRenderer {
public:
    /// The film of the cells; the volumes are those of all methods.
    static constexpr FilmSlot kSlot{MethodId::Default, View::Voronoi};

    /// The camera, the size or the volumes have changed: the image is outdated.
    void invalidate() { ++pose_; }
    /// Whether the image shows the present volumes from the present camera.
    bool is_current(const Session& session) const;
    /// Renders the image anew; false if the pass was stopped.
    bool render(Session& session, const StopFlag* stop);
    /// Null if it is not current.
    std::shared_ptr<const CellImage> image(const Session& session) const;

private:
    std::shared_ptr<const CellImage> image_;
    std::uint64_t pose_ = 1;        ///< grows with every change of camera, size, scene and field
    std::uint64_t image_pose_ = 0;  ///< pose_ of the image
    Refinement refinement_;         ///< of the image's volumes
};

}  // namespace pl::ui
