// Random settings for the comparison of both back ends.
#pragma once

#include "tests/parity/backend_case.h"

namespace pl::parity {

/// Opens shipped scenes by name, each once.
class SceneShelf {
public:
    /// Throws Error(Input) as load_scene() does.
    explicit SceneShelf(std::vector<std::string> names);

    const std::vector<std::string>& names() const { return names_; }
    const std::shared_ptr<const SceneDescription>& operator[](std::size_t index);

private:
    std::vector<std::string> names_;
    std::vector<std::shared_ptr<const SceneDescription>> scenes_;
};

/// Case `number` of the series of a seed: the same whatever cases were drawn before. All settings that decide a picture vary
/// within the ranges of the command line, sizes within what a second renders.
BackendCase random_case(SceneShelf& scenes, std::uint64_t seed, std::uint32_t number);

}  // namespace pl::parity
