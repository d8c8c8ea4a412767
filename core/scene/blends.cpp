#include "core/scene/blends.h"

#include <fmt/format.h>

#include "core/kernel/shading/blends.h"
#include "core/scene/surface_info.h"

namespace pl {

std::string error_of_blend(std::span<const MaterialDescription> materials, const MaterialDescription& material) {
    const MaterialDescription* shown = &material;
    for (std::uint32_t choice = 0;; ++choice) {
        if (has_inside(shown->kind)) return fmt::format("expected no solid glass in a blend, got '{}'", shown->name);
        if (!shown->blend.is_any()) return "";
        if (choice == kMostBlends)
            return fmt::format("expected at most {} blends in a row, got more, or a circle", kMostBlends);
        if (shown->blend.other >= materials.size())
            return fmt::format("expected one of {} materials to blend with, got number {}", materials.size(),
                               shown->blend.other);
        shown = &materials[shown->blend.other];
    }
}

}  // namespace pl
