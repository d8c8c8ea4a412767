#include "core/session/learned_field.h"

#include <fmt/format.h>

#include "core/base/error.h"

namespace pl {

void require_learned_in(const std::string& scene_hash, const LearnedField& field) {
    if (field.scene_hash != scene_hash)
        throw Error(ErrorKind::Input,
                    fmt::format("the field was learned in another scene: expected scene hash {}, got {}", scene_hash,
                                field.scene_hash));
}

std::string summary_of(const LearnedField& field) {
    return fmt::format("{}, {} volumes, {}, {} passes, {} records", info_of(field.method).name,
                       field.volumes->normals.size(), text_of(field.shape, field.field), field.progress.passes,
                       field.progress.records);
}

}  // namespace pl
