#include "core/session/backend.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/kernel_row.h"
#include "core/scene/needed_effects.h"

namespace pl {

std::size_t film_pixels(int width, int height) {
    constexpr std::int64_t kMostPixels = 0xffffffff;
    if (width <= 0 || height <= 0 || std::int64_t{width} * height > kMostPixels)
        throw Error(ErrorKind::Usage, fmt::format("picture size {}x{}: expected 1x1 to 2^32 pixels", width, height));
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
}

std::string kernel_name_of(std::string_view backend, MethodId method, View view, FeatureSet needed) {
    const std::vector<std::string> effects = effect_names(kCompiledSets[covering_set(needed)]);
    return fmt::format("{}/{}/{}", backend, view == View::Beauty ? info_of(method).name : info_of(view).name,
                       effects.empty() ? "base" : fmt::format("{}", fmt::join(effects, "+")));
}

}  // namespace pl
