// The page of a bench: one self-contained HTML file.
#pragma once

#include <string>
#include <string_view>

#include "app/report/bench_plots.h"
#include "core/bench/bench_results.h"

namespace pl {

/// [RFC 4648, section 4]
std::string base64(std::string_view bytes);

// The pictures of a bench for its page: each method's at equal time or at equal error.

/// [{"scene", "width", "height", "exposure_ev", "cropped", "reference": data URL or null, "cells": [{"title",
/// "color", "points": [{"seconds", "spp", "relmse", "picture": data URL}]}]}]. Pictures are of the first seed, at
/// most kMostSteps of a cell, cropped to the middle kMostSide pixels, all of a scene with the same exposure. Pictures
/// missing from the folder are left out.
Json picture_data(const bench::BenchFolder& folder, const bench::BenchResults& results);

inline constexpr std::size_t kMostSteps = 10;
inline constexpr int kMostSide = 512;

std::string report_page(const bench::BenchResults& results, const std::vector<NamedPlot>& plots,
                        const Json& pictures);

/// Style and behavior of the page. The script finds the pictures in the element "pictures".
extern const char* const kPageStyle;
extern const char* const kPageScript;

}  // namespace pl
