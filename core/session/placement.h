// The radiance volumes that all methods of a session share: their placement, the shape of their fields, and how far the
// placement was refined.
#pragma once

#include <memory>

#include "core/fields/refine_placement.h"
#include "core/session/backend.h"

namespace pl {

class Placement {
public:
    bool is_placed() const { return volumes_ != nullptr; }
    /// Null before the volumes are placed.
    const std::shared_ptr<const HostVolumes>& volumes() const { return volumes_; }
    std::size_t count() const { return volumes_->normals.size(); }
    const FieldShape& shape() const { return shape_; }
    /// Directions per volume; 0 before the volumes are placed.
    int bins() const { return volumes_ ? shape_.cells.count() : 0; }
    const Refinement& refinement() const { return refinement_; }
    /// Of placing and uploading the present volumes; 0 before they are placed.
    double seconds() const { return volumes_ ? seconds_ : 0.0; }

    /// Places the volumes and uploads them, unless that is done.
    void ensure(RenderBackend& backend, const HostScene& scene, const FieldSettings& settings);
    /// Takes volumes that were placed elsewhere, and uploads them.
    void adopt(RenderBackend& backend, const HostScene& scene, HostVolumes volumes, const FieldShape& shape,
               const Refinement& refinement);
    /// Takes refined volumes, without uploading them.
    void refine(const RenderBackend& backend, const HostScene& scene, RefinedPlacement refined);
    void count_round() { ++refinement_.rounds; }

    /// The scene has other materials: its lights may be brighter. `is_same` if the volumes stay, see same_placement().
    void change_materials(const HostScene& scene, const FieldSettings& settings, bool is_same);
    /// Volumes are placed anew when they are needed next.
    void clear() { volumes_.reset(); }
    /// Learned tables decided about the places of added volumes, so that these go with the tables.
    void undo_refinement();

private:
    std::shared_ptr<const HostVolumes> volumes_;
    FieldShape shape_;
    Refinement refinement_;
    double seconds_ = 0.0;
};

}  // namespace pl
