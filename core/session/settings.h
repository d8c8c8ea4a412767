// The settings of a rendering. Plain values with defaults; every front end fills the same structs.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "core/fields/field_settings.h"
#include "core/kernel/base/features.h"
#include "core/kernel/film/tonemap.h"
#include "core/kernel/inspect/views.h"
#include "core/kernel/integrator/path.h"
#include "core/scene/description.h"
#include "core/session/guiding_choice.h"
#include "core/session/methods.h"

namespace pl {

/// Value of RenderSettings::learn_passes: learning has no end.
inline constexpr std::uint64_t kEveryPass = std::numeric_limits<std::uint64_t>::max();

/// RenderSettings::roulette of paths that end by their depth alone. No rule of kernels: path_settings() puts the
/// first vertex with roulette out of reach.
inline constexpr RouletteRule kNoRoulette{2};

/// All settings besides the scene and the back end that decide the values of a film.
struct RenderSettings {
    /// The film that a front end shows, see slot_of(); a session renders the slot of each call.
    MethodId method = MethodId::Default;
    View view = View::Beauty;
    int width = 512;
    int height = 512;
    CameraDescription camera{};
    std::uint64_t seed = 1;
    int max_depth = 64;
    bool next_event = true;
    RouletteRule roulette = RouletteRule::Spare;
    GuidingRule guiding = GuidingRule::Paying;
    MixtureSettings mixture{};
    FieldSettings field{};
    std::uint64_t learn_passes = kEveryPass;  ///< that train the field of a method that learns; then it is frozen
    FeatureSet forced_effects{};  ///< effects that kernels cover besides the needed ones; no picture changes
};

/// Display only: no film or field depends on it.
struct DisplaySettings {
    float exposure_ev = 0.0f;
    ToneCurve curve = ToneCurve::Clamp;

    friend bool operator==(const DisplaySettings&, const DisplaySettings&) = default;
};

/// Name and value of each setting that decides the bits of a rendering, by which a checkpoint knows its run: in a fixed order, reals to their last bit. Without `forced_effects`, which change no picture.
std::vector<std::pair<std::string, std::string>> settings_text(const RenderSettings& settings);

}  // namespace pl
