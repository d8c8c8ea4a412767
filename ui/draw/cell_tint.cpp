#include "ui/draw/cell_tint.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "core/kernel/film/heat_color.h"

namespace pl::ui {

std::vector<float> entropy_shares(const FieldKeyFrame& frame) {
    std::vector<float> shares;
    for (std::size_t volume = 0; volume < frame.volumes(); ++volume) {
        const std::vector<float> cells = frame.probabilities(static_cast<std::int32_t>(volume));
        float entropy = 0.0f;
        for (const float p : cells)
            if (p > 0.0f) entropy -= p * std::log(p);
        shares.push_back(entropy / std::log(static_cast<float>(std::max(cells.size(), std::size_t{2}))));
    }
    return shares;
}

CellImage tint_cells(const CellImage& cells, std::span<const std::uint32_t> colors,
                     std::span<const float> positions) {
    std::unordered_map<std::uint32_t, std::uint32_t> tints;
    for (std::size_t volume = 0; volume < std::min(colors.size(), positions.size()); ++volume) {
        const ByteColor color = heat_color(positions[volume]);
        tints[colors[volume]] = 0xff000000u | static_cast<std::uint32_t>(color.r) << 16 |
                                static_cast<std::uint32_t>(color.g) << 8 | color.b;
    }
    CellImage tinted = cells;
    for (std::uint32_t& pixel : tinted.argb)
        if (const auto tint = tints.find(pixel); tint != tints.end()) pixel = tint->second;
    return tinted;
}

}  // namespace pl::ui
