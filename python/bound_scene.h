// A scene as Python holds it.
#pragma once

#include <memory>
#include <string>

#include "core/scene/description.h"

namespace pl {

struct BoundScene {
    std::string name;  ///< by which it was opened, for statistics
    std::shared_ptr<const SceneDescription> description;
    double load_seconds = 0.0;
};

}  // namespace pl
