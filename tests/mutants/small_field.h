// A learned field without a session: placement and tables of a scene, filled by scalar passes.
#pragma once

#include "core/fields/place_volumes.h"
#include "core/fields/table_model.h"
#include "core/kernel/guiding/update_volume.h"

namespace pl::test {

class SmallField {
public:
    /// `side` x `side` cells for each of `count` volumes.
    SmallField(const HostScene& scene, int count, int side) {
        const FieldSettings settings{.volumes = count, .bins = side * side};
        shape_ = make_field_shape(scene, settings);
        volumes_ = place_volumes(scene, settings);
        tables_ = make_arrays<HostTables>(shape_, volumes_.sites.size());
    }

    TableField view() { return field_view(shape_, volumes_, tables_); }
    void update() {
        const TableUpdateView view = update_view(shape_, tables_);
        for (std::uint32_t volume = 0; volume < volumes_.sites.size(); ++volume) update_volume(view, volume);
    }

    std::int32_t volume_at(Vec3f position, Vec3f normal) { return find_volume(view().tree, position, normal); }
    const SurfacePoint& site(std::int32_t volume) const { return volumes_.sites[static_cast<std::size_t>(volume)]; }
    const FieldShape& shape() const { return shape_; }
    HostTables& tables() { return tables_; }

private:
    FieldShape shape_;
    HostVolumes volumes_;
    HostTables tables_;
};

}  // namespace pl::test
