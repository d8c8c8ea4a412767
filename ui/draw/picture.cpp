#include "ui/draw/picture.h"

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

namespace {

constexpr std::uint32_t kOpaque = 0xff000000u;
constexpr std::uint32_t kOutlinePixel = 0xffffffffu;
constexpr std::uint32_t kOutlineShade = 0xff000000u;

/// a + (b - a) * weight / 256, per channel.
std::uint32_t blend(std::uint32_t a, std::uint32_t b, std::uint32_t weight) {
    const std::uint32_t even = ((a & 0xff00ffu) * (256 - weight) + (b & 0xff00ffu) * weight) >> 8 & 0xff00ffu;
    const std::uint32_t odd = ((a & 0xff00u) * (256 - weight) + (b & 0xff00u) * weight) >> 8 & 0xff00u;
    return kOpaque | even | odd;
}

void blend_cells(const CellImage& cells, float opacity, std::uint32_t* out, std::size_t pitch) {
    const auto weight = static_cast<std::uint32_t>(std::lround(std::clamp(opacity, 0.0f, 1.0f) * 256.0f));
    const auto width = static_cast<std::size_t>(cells.width);
    for (std::size_t y = 0; y < static_cast<std::size_t>(cells.height); ++y)
        for (std::size_t x = 0; x < width; ++x)
            out[y * pitch + x] = blend(out[y * pitch + x], cells.argb[y * width + x], weight);
}

/// White inside the border of the cell, black outside: visible on every picture.
void outline_cell(const CellImage& cells, std::uint32_t wanted, std::uint32_t* out, std::size_t pitch) {
    const int width = cells.width;
    const int height = cells.height;
    const auto inside = [&](int x, int y) {
        if (x < 0 || y < 0 || x >= width || y >= height) return false;
        return cells.argb[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                          static_cast<std::size_t>(x)] == wanted;
    };
    const auto put = [&](int x, int y, std::uint32_t color) {
        if (x >= 0 && y >= 0 && x < width && y < height)
            out[static_cast<std::size_t>(y) * pitch + static_cast<std::size_t>(x)] = color;
    };
    constexpr int kSteps[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            if (!inside(x, y)) continue;
            for (const auto& step : kSteps) {
                if (inside(x + step[0], y + step[1])) continue;
                put(x, y, kOutlinePixel);
                put(x + step[0], y + step[1], kOutlineShade);
            }
        }
}

}  // namespace

void write_heat(const Snapshot& snapshot, const ValueRange& range, std::uint32_t* out, std::size_t pitch) {
    const auto width = static_cast<std::size_t>(snapshot.width);
    for (std::size_t i = 0; i < snapshot.pixels.size(); ++i) {
        const float value = snapshot.pixels[i].x;
        const ByteColor color = heat_color(std::isfinite(value) ? range.position(value) : value);
        out[i / width * pitch + i % width] =
            kOpaque | static_cast<std::uint32_t>(color.r) << 16 | static_cast<std::uint32_t>(color.g) << 8 | color.b;
    }
}

void write_cells(const CellOverlay& overlay, int width, int height, std::uint32_t* out, std::size_t pitch) {
    const CellImage* cells = overlay.cells.get();
    if (cells == nullptr || cells->width != width || cells->height != height) return;
    if (overlay.opacity > 0.0f)
        blend_cells(overlay.tint != nullptr ? *overlay.tint : *cells, overlay.opacity, out, pitch);
    // Pixels on the border of two cells may mix their colors: they count as outside.
    if (overlay.outlined) outline_cell(*cells, *overlay.outlined, out, pitch);
}

void write_picture(const DisplayFrame& frame, const CellOverlay& overlay, std::uint32_t* out, std::size_t pitch) {
    const std::uint32_t* pixels = frame.pixels();
    const auto width = static_cast<std::size_t>(frame.width);
    for (std::size_t y = 0; y < static_cast<std::size_t>(frame.height); ++y)
        std::copy_n(pixels + y * width, width, out + y * pitch);
    write_cells(overlay, frame.width, frame.height, out, pitch);
}

}  // namespace pl::ui
