// The pictures of a bench for its page: each method's at equal time or at equal error.
#pragma once

#include "core/bench/bench_results.h"

namespace pl {

/// [{"scene", "width", "height", "exposure_ev", "cropped", "reference": data URL or null, "cells": [{"title",
/// "color", "points": [{"seconds", "spp", "relmse", "picture": data URL}]}]}]. Pictures are those of the first seed,
/// at most kMostSteps of a cell, cropped to the middle kMostSide pixels, all of a scene with the same exposure.
/// Pictures missing from the folder are left out.
Json picture_data(const bench::BenchFolder& folder, const bench::BenchResults& results);

inline constexpr std::size_t kMostSteps = 10;
inline constexpr int kMostSide = 512;

}  // namespace pl
