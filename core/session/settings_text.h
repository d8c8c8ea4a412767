// The settings that decide the bits of a rendering, in words: by them a checkpoint is told from that of another run.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/session/settings.h"

namespace pl {

/// Name and value of each, in a fixed order; reals to their last bit. Without `forced_effects`, which change no picture.
std::vector<std::pair<std::string, std::string>> settings_text(const RenderSettings& settings);

}  // namespace pl
