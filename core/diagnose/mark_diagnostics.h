// Marks of diagnostics in a picture: a picture and a map in, a marked picture out.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/diagnose/diagnostics.h"

namespace pl::diagnose {

/// Pixels of a picture in place: rows of ARGB, `pitch` pixels apart.
struct PixelRows {
    std::uint32_t* argb = nullptr;
    std::size_t pitch = 0;

    std::uint32_t& at(int x, int y) const {
        return argb[static_cast<std::size_t>(y) * pitch + static_cast<std::size_t>(x)];
    }
};

/// Darkens the picture to a quarter and colors the pixels of the map that have occurrences; isolated ones get a ring,
/// visible from a distance. Of several kinds at a pixel the first one of all_diagnostics() is shown. The picture has
/// the map's size.
void mark_diagnostics(const DiagnosticsMap& map, PixelRows picture);

}  // namespace pl::diagnose
