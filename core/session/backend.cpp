#include "core/session/backend.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/kernel_row.h"
#include "core/scene/needed_effects.h"

namespace pl {

std::string kernel_name_of(std::string_view backend, MethodId method, View view, FeatureSet needed) {
    const std::vector<std::string> effects = effect_names(kCompiledSets[covering_set(needed)]);
    return fmt::format("{}/{}/{}", backend, view == View::Beauty ? info_of(method).name : info_of(view).name,
                       effects.empty() ? "base" : fmt::format("{}", fmt::join(effects, "+")));
}

}  // namespace pl
