// The values of a script that are about overlays: volumes in the scene, the past, paths, noise and gains.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "ui/model/viewer_model.h"

namespace pl::ui {

/// A value by name, as a word or number.
struct ScriptValue {
    std::string_view name;
    std::string (*read)(const ViewerModel& model);
};

std::span<const ScriptValue> overlay_values();

}  // namespace pl::ui
