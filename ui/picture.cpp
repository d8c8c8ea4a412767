#include "ui/picture.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/kernel/film/heat_color.h"

namespace pl {
namespace {

constexpr std::uint32_t kOpaque = 0xff000000u;
constexpr std::uint32_t kInvalidPixel = 0xffff00ffu;
constexpr std::uint32_t kOutlinePixel = 0xffffffffu;
constexpr std::uint32_t kOutlineShade = 0xff000000u;

std::uint32_t pack(std::uint32_t r, std::uint32_t g, std::uint32_t b) { return kOpaque | r << 16 | g << 8 | b; }

bool is_nan(Vec3f v) { return v.x != v.x || v.y != v.y || v.z != v.z; }

/// a + (b - a) * weight / 256, per channel.
std::uint32_t blend(std::uint32_t a, std::uint32_t b, std::uint32_t weight) {
    const std::uint32_t even = ((a & 0xff00ffu) * (256 - weight) + (b & 0xff00ffu) * weight) >> 8 & 0xff00ffu;
    const std::uint32_t odd = ((a & 0xff00u) * (256 - weight) + (b & 0xff00u) * weight) >> 8 & 0xff00u;
    return kOpaque | even | odd;
}

std::uint32_t display_color(Vec3f v, float scale, const ToneTable& table) {
    return is_nan(v) ? kInvalidPixel : pack(table(v.x * scale), table(v.y * scale), table(v.z * scale));
}

std::uint32_t heat_pixel(float share) {
    const ByteColor color = heat_color(share);
    return pack(color.r, color.g, color.b);
}

void blend_cells(const CellImage& cells, float opacity, std::uint32_t* out, std::size_t pitch) {
    const auto weight = static_cast<std::uint32_t>(std::lround(std::clamp(opacity, 0.0f, 1.0f) * 256.0f));
    const auto width = static_cast<std::size_t>(cells.width);
    for (std::size_t y = 0; y < static_cast<std::size_t>(cells.height); ++y)
        for (std::size_t x = 0; x < width; ++x)
            out[y * pitch + x] = blend(out[y * pitch + x], cells.argb[y * width + x], weight);
}

/// White on the inner border of the cell, black around it: visible on every picture.
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

ToneTable::ToneTable(ToneCurve curve) : curve_(curve), codes_{} {
    for (std::size_t i = 0; i < kSize; ++i) {
        // The middle of the values that share this entry.
        const auto bits = ((static_cast<std::uint32_t>(i) + kFirst) << kShift) + (1u << (kShift - 1));
        const float encoded = encode_srgb(apply_curve(curve, std::bit_cast<float>(bits)));
        codes_[i] = static_cast<std::uint8_t>(std::lround(255.0f * encoded));
    }
}

std::uint8_t ToneTable::operator()(float exposed) const {
    const float positive = exposed > 0.0f ? exposed : 0.0f;
    const std::uint32_t index = std::bit_cast<std::uint32_t>(positive) >> kShift;
    const std::uint32_t clamped = std::clamp(index, kFirst, kFirst + static_cast<std::uint32_t>(kSize) - 1);
    return codes_[clamped - kFirst];
}

DisplaySettings display_of(View view, const DisplaySettings& asked) {
    return shows_radiance(view) ? asked : DisplaySettings{};
}

CellImage make_cell_image(const Snapshot& colors, const ToneTable& table) {
    CellImage image{colors.width, colors.height, {}};
    image.argb.reserve(colors.pixels.size());
    for (const Vec3f& color : colors.pixels) image.argb.push_back(display_color(color, 1.0f, table));
    return image;
}

std::uint32_t cell_color(std::int32_t volume, const ToneTable& table) {
    return display_color(color_of_id(static_cast<std::uint32_t>(volume)), 1.0f, table);
}

void write_picture(const Snapshot& snapshot, float scale, const ToneTable& table, const CellOverlay& overlay,
                   std::uint32_t* out, std::size_t pitch) {
    const auto width = static_cast<std::size_t>(snapshot.width);
    for (std::size_t y = 0; y < static_cast<std::size_t>(snapshot.height); ++y) {
        const Vec3f* row = snapshot.pixels.data() + y * width;
        std::uint32_t* target = out + y * pitch;
        if (is_heat_map(snapshot.slot.view))
            for (std::size_t x = 0; x < width; ++x) target[x] = heat_pixel(row[x].x * scale);
        else
            for (std::size_t x = 0; x < width; ++x) target[x] = display_color(row[x], scale, table);
    }
    const CellImage* cells = overlay.cells;
    if (cells == nullptr || cells->width != snapshot.width || cells->height != snapshot.height) return;
    if (overlay.opacity > 0.0f) blend_cells(*cells, overlay.opacity, out, pitch);
    // Pixels on the border of two cells may be mixtures of both: they count as outside.
    if (overlay.outlined) outline_cell(*cells, *overlay.outlined, out, pitch);
}

}  // namespace pl
