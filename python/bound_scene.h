// A scene as Python holds it.
#pragma once

#include <memory>
#include <string>

#include "core/io/load_settings.h"
#include "core/scene/description.h"

namespace pl {

struct BoundScene {
    std::string name;  ///< by which it was opened, for statistics
    std::shared_ptr<const SceneDescription> description;
    LoadSettings load{};
    double load_seconds = 0.0;
    bool is_from_arrays = false;  ///< no file has it
};

}  // namespace pl
