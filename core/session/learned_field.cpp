#include "core/session/learned_field.h"

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/scene/scene_hash.h"

namespace pl {

void require_learned_in(const SceneDescription& scene, const LearnedField& field) {
    const std::string hash = scene_hash(scene);
    if (field.scene_hash != hash)
        throw Error(ErrorKind::Input,
                    fmt::format("the field was learned in another scene: expected scene hash {}, got {}", hash,
                                field.scene_hash));
}

std::string summary_of(const LearnedField& field) {
    const auto text = [&](const std::string& directions) {
        return fmt::format("{}, {} volumes, {}, {} passes, {} records", info_of(field.method).name,
                           field.volumes->normals.size(), directions, field.progress.passes, field.progress.records);
    };
    if (const auto* tree = std::get_if<HostSdTree>(&field.field))
        return text(
            fmt::format("SD-tree of {} leaves and {} nodes", tree->first_node.size(), tree->energy.size() / 4));
    if (std::holds_alternative<HostLobes>(field.field)) return text(fmt::format("up to {} lobes", kMostLobes));
    if (const auto* neural = std::get_if<HostNeural>(&field.field))
        return text(
            fmt::format("{} lobes at each vertex by a network of {} steps", kVertexLobes, status_of(*neural).steps));
    return text(fmt::format("{} directions", field.shape.cells.count()));
}

}  // namespace pl
