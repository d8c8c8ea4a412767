// A recorded path as text and as JSON.
#pragma once

#include <string>

#include "core/diagnose/record_path.h"
#include "core/io/json_file.h"
#include "core/scene/description.h"
#include "core/session/settings.h"

namespace pl {

/// A path, and the picture that it belongs to.
struct TracedPath {
    const diagnose::PathRecord& path;
    const SceneDescription& scene;
    const RenderSettings& settings;
    std::uint32_t sample = 0;  ///< its number in the picture
};

/// "sample 3: light 0.25, radiance 0.2,0.3,0.1; vertices 4, guided; end: roulette": one of several paths.
std::string path_line(const TracedPath& traced);

/// A few lines for each vertex, then the sum.
std::string path_text(const TracedPath& traced);

/// The members of docs/manual.md, "A single path". Vectors are [x, y, z], vertices are numbered from 0 in the order of "vertices".
Json path_json(const TracedPath& traced);

}  // namespace pl
