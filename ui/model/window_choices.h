// What users read of the choices of the window alone.
#pragma once

#include <array>

#include "core/base/choice.h"
#include "ui/model/path_explorer.h"
#include "ui/model/window_state.h"

namespace pl {

template <>
inline constexpr auto kChoices<diagnose::PassChoice> = std::to_array<ChoiceInfo<diagnose::PassChoice>>({
    {diagnose::PassChoice::Brightest, "brightest", "brightest", "those that brought most light, of up to 16384"},
    {diagnose::PassChoice::Newest, "newest", "newest", "a fair sample"},
});

template <>
inline constexpr auto kChoices<ui::PathSides> = std::to_array<ChoiceInfo<ui::PathSides>>({
    {ui::PathSides::Plain, "default", "default"},
    {ui::PathSides::Guided, "guided", "guided"},
    {ui::PathSides::Both, "both", "both methods"},
});

template <>
inline constexpr auto kChoices<ui::LobeShape> = std::to_array<ChoiceInfo<ui::LobeShape>>({
    {ui::LobeShape::Lobe, "lobes", "lobes", "their length is the density, on one scale"},
    {ui::LobeShape::Dome, "dome", "glass dome", "see through it"},
});

template <>
inline constexpr auto kChoices<ui::Theme> = std::to_array<ChoiceInfo<ui::Theme>>({
    {ui::Theme::Dark, "dark", "dark"},
    {ui::Theme::Light, "light", "light"},
    {ui::Theme::HighContrast, "high contrast", "high contrast"},
});

template <>
inline constexpr auto kChoices<ui::CellQuantity> = std::to_array<ChoiceInfo<ui::CellQuantity>>({
    {ui::CellQuantity::Radiance, "radiance", "radiance Q", "incident radiance"},
    {ui::CellQuantity::Probability, "probability", "probability P", "in the table"},
    {ui::CellQuantity::Density, "density", "density", "that paths are sampled with, relative to cosine sampling"},
    {ui::CellQuantity::Visits, "visits", "visits", "training samples"},
});

}  // namespace pl
