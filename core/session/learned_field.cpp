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
    return fmt::format("{}, {} volumes, {}, {} passes, {} records", info_of(field.method).name,
                       field.volumes->normals.size(), text_of(field.shape, field.field), field.progress.passes,
                       field.progress.records);
}

}  // namespace pl
