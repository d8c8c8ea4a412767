// The radiance volumes shared by all methods of a session: their placement, the shape of their fields, and the
// progress of their refinement.
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
    /// Of placing and uploading the present volumes; 0 before placement.
    double seconds() const { return volumes_ ? seconds_ : 0.0; }

    /// Places the volumes for the view of `camera`, and uploads them, unless they are placed.
    void ensure(RenderBackend& backend, const HostScene& scene, const FieldSettings& settings, const Camera& camera);
    /// Takes volumes placed in another session, and uploads them.
    void adopt(RenderBackend& backend, const HostScene& scene, HostVolumes volumes, const FieldShape& shape,
               const Refinement& refinement);
    /// The placement with those volumes split, at most `most`, whose values in a `learned` field differ most from their neighbors'.
    RefinedPlacement split(const RenderBackend& backend, const HostScene& scene, const FieldSettings& settings,
                           const Camera& camera, HostField& learned, std::size_t most);
    /// Takes refined volumes, without uploading them.
    void refine(const RenderBackend& backend, const HostScene& scene, RefinedPlacement refined);
    /// Sets the clock: of volumes that this session placed before it was taken out and put back.
    void set_seconds(double seconds) { seconds_ = seconds; }
    void count_round() { ++refinement_.rounds; }

    /// The materials of the scene changed: its brightest emission may be another. `is_same`: the volumes stay, see
    /// same_placement().
    void change_materials(const HostScene& scene, const FieldSettings& settings, bool is_same);
    /// Drops the volumes, which are placed anew when needed, and what is known of the scene, which may be another.
    void clear() {
        volumes_.reset();
        surfaces_.reset();
    }
    /// Drops the added volumes: learned tables decided their positions, so they are cleared with the tables.
    void undo_refinement();

private:
    const LitSurfaces& surfaces(const HostScene& scene, int threads);
    /// Builds the volumes' grid.
    std::shared_ptr<const HostVolumes> with_grid(const RenderBackend& backend, const HostScene& scene,
                                                 HostVolumes volumes);

    std::shared_ptr<const HostVolumes> volumes_;
    std::shared_ptr<const LitSurfaces> surfaces_;  ///< null: not found yet
    FieldShape shape_;
    Refinement refinement_;
    double seconds_ = 0.0;
};

}  // namespace pl
