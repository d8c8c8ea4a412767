// Texts for users of the choices in the settings of a rendering; field_choices.h has the choices of the field. They are apart from
// the enumerations, which kernels include.
#pragma once

#include "core/fields/field_choices.h"
#include "core/session/settings.h"

namespace pl {

template <>
inline constexpr auto kChoices<RouletteRule> = std::to_array<ChoiceInfo<RouletteRule>>({
    {RouletteRule::Spare, "spare", "Spare",
     "the product of albedos ends paths, a large contribution estimate keeps them"},
    {RouletteRule::Albedo, "albedo", "Albedo", "the product of albedos alone"},
    {kNoRoulette, "off", "Off", "only the maximum depth ends paths"},
});

template <>
inline constexpr auto kChoices<GuidingRule> = std::to_array<ChoiceInfo<GuidingRule>>({
    {GuidingRule::Paying, "paying", "While it pays",
     "where guiding takes more time than it saves, most passes are those of default, and the field learns rarely"},
    {GuidingRule::Always, "always", "Always", "every pass is guided, and learns"},
});

template <>
inline constexpr auto kChoices<ToneCurve> = std::to_array<ChoiceInfo<ToneCurve>>({
    {ToneCurve::Clamp, "clamp", "Clamp", "values up to 1 stay as they are"},
    {ToneCurve::Reinhard, "reinhard", "Reinhard", "x becomes x/(1+x)"},
    {ToneCurve::Aces, "aces", "ACES fit", "a fit of the filmic curve of ACES"},
});

}  // namespace pl
