#include "ui/draw/path_lines.h"

#include <algorithm>
#include <cmath>

#include "core/diagnose/pixel_paths.h"
#include "core/kernel/geometry/intersector.h"
#include "ui/draw/direction_disc.h"

namespace pl::ui {
namespace {

constexpr std::uint32_t kDark = 0x70a69c96u;  ///< of paths without light: faint gray
constexpr std::uint32_t kCasing = 0xc0000000u;
constexpr std::uint8_t kAlpha = 215;
constexpr float kHiddenShare = 0.28f;  ///< of the opacity of visible parts
constexpr float kWidth = 1.5f;
constexpr float kDarkWidth = 1.0f;  ///< of paths without light
constexpr float kSelectedWidth = 2.6f;
constexpr float kShadowWidth = 0.8f;
constexpr std::size_t kMostPartsOfLine = 24;
constexpr float kDashPixels = 7.0f;
constexpr float kGapPixels = 5.0f;

std::uint32_t faded(std::uint32_t color, float share) {
    const auto alpha = static_cast<std::uint32_t>(std::lround(static_cast<float>(color >> 24) * share));
    return (color & 0x00ffffffu) | alpha << 24;
}

/// The end of a vertex's incoming ray.
Vec3f end_of(const diagnose::VertexRecord& vertex, float escape_length) {
    return vertex.is_escape ? vertex.origin - escape_length * vertex.wo : vertex.position;
}

void add_line(std::vector<PathPiece>& pieces, PathPiece piece, bool is_selected) {
    if (is_selected) {
        PathPiece casing = piece;
        casing.color = kCasing;
        casing.width_px += 2.0f;
        casing.is_dashed = false;
        pieces.push_back(casing);
    }
    pieces.push_back(piece);
}

bool is_hidden(const BvhIntersector& scene, Vec3f eye, Vec3f point) {
    return scene.occluded({.origin = eye, .direction = point - eye, .t_max = 0.9999f});
}

}  // namespace

std::uint32_t path_color(float light, const ValueRange& range) {
    return light > 0.0f ? map_color(range.position(light), kAlpha) : kDark;
}

void add_path(std::vector<PathPiece>& pieces, const diagnose::PathRecord& path, const PathLineStyle& style) {
    const float light = diagnose::path_light(path);
    const std::uint32_t color = path_color(light, style.range);
    const float width = style.is_selected ? kSelectedWidth : light > 0.0f ? kWidth : kDarkWidth;
    for (const diagnose::VertexRecord& vertex : path.vertices) {
        PathPiece piece{.from = vertex.origin,
                        .to = end_of(vertex, style.escape_length),
                        .color = color,
                        .width_px = width,
                        .is_dashed = style.is_dashed};
        add_line(pieces, piece, style.is_selected);
        if (!style.has_shadow_rays || !vertex.light || !vertex.light->is_visible) continue;
        piece.from = vertex.position;
        piece.to = vertex.light->position.value_or(vertex.position + style.escape_length * vertex.light->wi);
        piece.width_px = kShadowWidth;
        pieces.push_back(piece);
    }
}

std::vector<PathPiece> split_by_visibility(std::span<const PathPiece> pieces, const SceneView& scene, Vec3f eye) {
    const BvhIntersector intersector{scene};
    const std::size_t parts =
        std::clamp(kMostVisibilityRays / std::max(pieces.size(), std::size_t{1}), std::size_t{1}, kMostPartsOfLine);
    std::vector<PathPiece> result;
    for (const PathPiece& piece : pieces) {
        const std::size_t first = result.size();
        for (std::size_t i = 0; i < parts; ++i) {
            const auto at = [&](float place) {
                return glm::mix(piece.from, piece.to, place / static_cast<float>(parts));
            };
            const auto start = static_cast<float>(i);
            PathPiece part = piece;
            part.from = at(start);
            part.to = at(start + 1.0f);
            part.is_hidden = is_hidden(intersector, eye, at(start + 0.5f));
            if (result.size() > first && result.back().is_hidden == part.is_hidden)
                result.back().to = part.to;
            else
                result.push_back(part);
        }
    }
    return result;
}

std::vector<Stroke> strokes_of(std::span<const PathPiece> pieces, const Projection& projection, float scale) {
    std::vector<Stroke> strokes;
    for (const bool hidden : {true, false}) {
        for (const PathPiece& piece : pieces) {
            if (piece.is_hidden != hidden) continue;
            const auto line = projection.clipped(piece.from, piece.to);
            if (!line) continue;
            const auto [from, to] = *line;
            const Stroke whole{from, to, hidden ? faded(piece.color, kHiddenShare) : piece.color,
                               scale * piece.width_px};
            const float length = glm::length(to - from);
            if (!piece.is_dashed || !(length > 0.0f)) {
                strokes.push_back(whole);
                continue;
            }
            for (float at = 0.0f; at < length; at += scale * (kDashPixels + kGapPixels)) {
                Stroke dash = whole;
                dash.from = glm::mix(from, to, at / length);
                dash.to = glm::mix(from, to, std::min(at + scale * kDashPixels, length) / length);
                strokes.push_back(dash);
            }
        }
    }
    return strokes;
}

}  // namespace pl::ui
