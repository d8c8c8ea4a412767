#include "ui/overlays/scene_shapes.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/kernel/geometry/intersector.h"
#include "ui/draw/stream_texture.h"
#include "ui/draw/style.h"
#include "ui/draw/widgets.h"
#include "ui/overlays/overlays.h"

namespace pl::ui {
namespace {

constexpr float kLobeShare = 0.09f;  ///< of the scene's diagonal: the longest of the shown lobes
constexpr std::uint8_t kNormalAlpha = 235;
constexpr std::uint8_t kHiddenAlpha = 90;  ///< if the scene hides it from the camera
constexpr int kRimSteps = 48;

/// The picture, and the list that draws over it.
struct ShapeCanvas {
    ImDrawList& out;
    const PublishedFrame& frame;
    const Projection& projection;

    void line(Vec3f from, Vec3f to, ImU32 color, float width) const {
        draw_scene_line(out, projection, from, to, color, width);
    }
};

/// Whether the scene hides the top of the hemisphere from the camera.
bool is_hidden(const PublishedFrame& frame, const VolumeInspection& volume, float radius) {
    const Vec3f top = volume.position + radius * volume.normal;
    const Vec3f eye = frame.snapshot.camera.eye;
    return BvhIntersector{frame.scene->view()}.occluded({.origin = eye, .direction = top - eye, .t_max = 1.0f});
}

/// The rim in the color of the pin.
void draw_rim(const ShapeCanvas& canvas, const VolumeInspection& volume, float radius, ImU32 color) {
    const Frame frame = make_frame(volume.normal);
    const auto at = [&](int step) {
        const float angle = 2.0f * kPi * static_cast<float>(step) / kRimSteps;
        return volume.position + radius * (std::cos(angle) * frame.x + std::sin(angle) * frame.y);
    };
    for (int step = 0; step < kRimSteps; ++step) canvas.line(at(step), at(step + 1), color, em(0.1f));
}

/// From the volume through the peak, beyond the shape.
void draw_peak(const ShapeCanvas& canvas, const VolumeInspection& volume, float length, ImU32 color) {
    const Vec3f direction = peak_direction(volume.normal, volume.side, volume.probability);
    const Vec3f tip = volume.position + length * direction;
    canvas.line(volume.position, tip, color, em(0.12f));
    const auto tip_point = canvas.projection(tip);
    const auto start_point = canvas.projection(volume.position);
    if (!tip_point || !start_point) return;
    const Vec2f along = tip_point->window - start_point->window;
    const float pixels = glm::length(along);
    if (!(pixels > 1.0f)) return;
    const Vec2f unit = along / pixels;
    const Vec2f back = tip_point->window - em(0.7f) * unit;
    const Vec2f aside{-em(0.3f) * unit.y, em(0.3f) * unit.x};
    canvas.out.AddTriangleFilled({tip_point->window.x, tip_point->window.y}, {back.x + aside.x, back.y + aside.y},
                                 {back.x - aside.x, back.y - aside.y}, color);
}

/// Densities of sampling the field, relative to those of cosine sampling.
std::vector<float> densities_of(const VolumeInspection& volume) { return cell_values(volume, CellQuantity::Density); }

float largest_density(const std::vector<ShownVolume>& volumes) {
    float largest = 0.0f;
    for (const ShownVolume& shown : volumes)
        for (const float density : densities_of(*shown.volume)) largest = std::max(largest, density);
    return largest;
}

void draw_volume(const ShapeCanvas& canvas, const ShownVolume& shown, const ShapeScale& scale, float largest) {
    const VolumeInspection& volume = *shown.volume;
    const float share = scale.shape == LobeShape::Lobe ? kLobeShare : kDomeShare;
    const float radius = share * canvas.frame.facts.diagonal;
    const bool hidden = is_hidden(canvas.frame, volume, 0.3f * radius);
    const std::uint8_t alpha = hidden ? kHiddenAlpha : kNormalAlpha;
    std::vector<float> lengths = densities_of(volume);
    for (float& length : lengths) length /= std::max(largest, 1.0e-30f);
    const float longest = scale.shape == LobeShape::Lobe ? *std::ranges::max_element(lengths) : 1.0f;
    const std::vector<float> positions = positions_in(scale.range, cell_values(volume, scale.quantity));
    const ImU32 color = (shown.color & 0x00ffffffu) | static_cast<ImU32>(alpha) << 24;
    draw_rim(canvas, volume, kDomeShare * canvas.frame.facts.diagonal, color);
    ScreenMesh mesh;
    add_glyph(mesh,
              {.position = volume.position,
               .normal = volume.normal,
               .radius = radius,
               .side = volume.side,
               .lengths = lengths,
               .positions = positions,
               .alpha = alpha},
              scale.shape, canvas.projection);
    draw_mesh(canvas.out, mesh);
    draw_peak(canvas, volume, radius * longest + 0.02f * canvas.frame.facts.diagonal, color);
}

}  // namespace

void draw_scene_line(ImDrawList& out, const Projection& projection, Vec3f from, Vec3f to, ImU32 color, float width) {
    if (const auto ends = projection.clipped(from, to))
        out.AddLine({(*ends)[0].x, (*ends)[0].y}, {(*ends)[1].x, (*ends)[1].y}, color, width);
}

void draw_shapes(ImDrawList& out, const PublishedFrame& frame, const Projection& projection,
                 std::vector<ShownVolume> volumes, const ShapeScale& scale) {
    const auto distance = [&](const ShownVolume& shown) {
        return glm::length(shown.volume->position - projection.eye());
    };
    std::ranges::stable_sort(volumes, std::ranges::greater{}, distance);
    const float largest = largest_density(volumes);
    const ShapeCanvas canvas{out, frame, projection};
    for (const ShownVolume& shown : volumes) draw_volume(canvas, shown, scale, largest);
}

void draw_mesh(ImDrawList& out, const ScreenMesh& mesh) {
    constexpr std::size_t kBatch = 3 * 4096;  // points have 16-bit numbers in some versions of ImGui
    const ImVec2 uv = ImGui::GetFontTexUvWhitePixel();
    for (std::size_t first = 0; first < mesh.indices.size(); first += kBatch) {
        const std::size_t count = std::min(kBatch, mesh.indices.size() - first);
        out.PrimReserve(static_cast<int>(count), static_cast<int>(count));
        for (std::size_t i = first; i < first + count; ++i) {
            const Vec2f point = mesh.points[mesh.indices[i]];
            out.PrimVtx({point.x, point.y}, uv, mesh.colors[mesh.indices[i]]);
        }
    }
}

namespace {

/// The direction of the hovered cell, up to the surface in that direction.
void draw_hovered_ray(ImDrawList& out, const PublishedFrame& frame, const Projection& projection,
                      const VolumeInspection& volume, int cell) {
    if (cell < 0 || cell >= volume.side * volume.side) return;
    const CellFan fan = make_cell_fans(volume.side)[static_cast<std::size_t>(cell)];
    const Vec3f direction = direction_of(volume, fan[0]);
    const float radius = kDomeShare * frame.facts.diagonal;
    const Vec3f start = volume.position + 0.01f * radius * volume.normal;
    const Hit hit = BvhIntersector{frame.scene->view()}.closest_hit({.origin = start, .direction = direction});
    draw_scene_line(out, projection, start, start + (hit.found() ? hit.t : 10.0f * radius) * direction,
                    IM_COL32(255, 255, 255, 220), em(0.12f));
}

}  // namespace

void draw_hemisphere(ViewerModel& model, const Rect& image) {
    if (!model.window().hemisphere || model.frame() == nullptr) return;
    const std::vector<ShownVolume> volumes = shown_volumes(model);
    if (volumes.empty()) return;
    const PublishedFrame& frame = *model.frame();
    const Snapshot& snapshot = frame.snapshot;
    const Projection projection(snapshot.camera, snapshot.width, snapshot.height, image);
    ImDrawList& out = *ImGui::GetBackgroundDrawList();
    draw_shapes(out, frame, projection, volumes,
                {.range = shown_range(model, volumes),
                 .shape = model.window().lobe_shape,
                 .quantity = model.window().cell_display.quantity});
    for (const ShownVolume& shown : volumes)
        if (shown.is_selected)
            draw_hovered_ray(out, frame, projection, *shown.volume, model.selection().hovered_cell());
    note_place("lobes", image);
}

void draw_flowers(ViewerModel& model, const Rect& image) {
    if (!model.flowers().is_shown() || model.frame() == nullptr) return;
    ImDrawList& out = *ImGui::GetBackgroundDrawList();
    const std::shared_ptr<const ScreenMesh> mesh = model.flowers().mesh(*model.frame(), image);
    const ImVec2 low{std::ceil(out.GetClipRectMin().x), std::ceil(out.GetClipRectMin().y)};
    const ImVec2 high{std::floor(out.GetClipRectMax().x), std::floor(out.GetClipRectMax().y)};
    if (mesh->indices.empty() || low.x >= high.x || low.y >= high.y) return;
    if (SDL_Texture* const texture = texture_of(mesh, Rect{low.x, low.y, high.x - low.x, high.y - low.y}))
        out.AddImage(to_texture_id(texture), low, high);
    else
        draw_mesh(out, *mesh);
}

namespace {

/// The numbers of a path's vertices, at their positions.
void draw_numbers(ImDrawList& out, const diagnose::PathRecord& path, const Projection& projection) {
    for (std::size_t i = 0; i < path.vertices.size(); ++i) {
        if (path.vertices[i].is_escape) continue;
        const auto point = projection(path.vertices[i].position);
        if (!point) continue;
        const ImVec2 at{point->window.x, point->window.y};
        const std::string text = fmt::format("{}", i);
        out.AddCircleFilled(at, em(0.28f), IM_COL32(0, 0, 0, 220));
        out.AddCircleFilled(at, em(0.18f), IM_COL32_WHITE);
        const ImVec2 corner{at.x + em(0.35f), at.y - em(1.1f)};
        out.AddText({corner.x + 1.0f, corner.y + 1.0f}, IM_COL32_BLACK, text.c_str());
        out.AddText(corner, IM_COL32_WHITE, text.c_str());
    }
}

/// In short pieces: without a graphics card a line costs every pixel of the rectangle that it crosses.
void draw_stroke(ImDrawList& out, const Stroke& stroke) {
    constexpr float kPiecePixels = 24.0f;
    constexpr float kMostPieces = 256.0f;  // of a stroke that reaches far out of the window
    const Vec2f along = stroke.to - stroke.from;
    const int pieces = static_cast<int>(std::clamp(glm::length(along) / kPiecePixels, 1.0f, kMostPieces));
    const auto at = [&](int piece) {
        const float share = static_cast<float>(piece) / static_cast<float>(pieces);
        return ImVec2{stroke.from.x + share * along.x, stroke.from.y + share * along.y};
    };
    for (int piece = 0; piece < pieces; ++piece) out.AddLine(at(piece), at(piece + 1), stroke.color, stroke.width_px);
}

}  // namespace

void draw_strokes(ImDrawList& out, std::span<const PathPiece> pieces, const Projection& projection,
                  const diagnose::PathRecord* numbered) {
    for (const Stroke& stroke : strokes_of(pieces, projection, em(1.0f) / kFontPixels)) draw_stroke(out, stroke);
    if (numbered != nullptr) draw_numbers(out, *numbered, projection);
}

void draw_path_lines(ViewerModel& model, const Rect& image) {
    PathExplorer& explorer = model.paths();
    if (!explorer.is_shown() || explorer.paths() == nullptr || model.frame() == nullptr) return;
    const PublishedFrame& frame = *model.frame();
    const Snapshot& snapshot = frame.snapshot;
    const Projection projection(snapshot.camera, snapshot.width, snapshot.height, image);
    ImDrawList& out = *ImGui::GetBackgroundDrawList();
    const auto selected = explorer.selected();
    draw_strokes(out, explorer.pieces(frame), projection, selected ? &explorer.listed()[*selected] : nullptr);
}

namespace {

/// A triangle up for a gain, one down for a loss, a disc for no difference, a ring where nothing is known.
void draw_mark(ImDrawList& out, ImVec2 center, float radius, Verdict verdict, bool is_old) {
    const ImU32 color = is_old ? colors::kFaint : to_imgui_color(mark_color(verdict));
    out.AddCircleFilled(center, 1.35f * radius, IM_COL32(0, 0, 0, 170));
    const float sign = verdict == Verdict::Faster ? -1.0f : 1.0f;
    if (verdict == Verdict::Faster || verdict == Verdict::Slower)
        out.AddTriangleFilled({center.x, center.y + sign * radius},
                              {center.x - 0.87f * radius, center.y - 0.5f * sign * radius},
                              {center.x + 0.87f * radius, center.y - 0.5f * sign * radius}, color);
    else if (verdict == Verdict::NoDifference)
        out.AddCircleFilled(center, 0.7f * radius, color);
    else
        out.AddCircle(center, 0.7f * radius, color, 0, em(0.1f));
}

}  // namespace

void draw_gain_marks(ImDrawList& out, const TileGains& gains, const Rect& image, bool is_old) {
    const float width = image.width / static_cast<float>(gains.columns);
    const float height = image.height / static_cast<float>(gains.rows);
    const float radius = std::min(em(0.6f), 0.2f * std::min(width, height));
    for (std::size_t i = 0; i < gains.tiles.size(); ++i) {
        const auto columns = static_cast<std::size_t>(gains.columns);
        draw_mark(out,
                  {image.x + (static_cast<float>(i % columns) + 0.5f) * width,
                   image.y + (static_cast<float>(i / columns) + 0.5f) * height},
                  radius, verdict_of(gains.tiles[i]), is_old);
    }
}

void draw_gain_marks(const ViewerModel& model, const Rect& image) {
    if (const TileGains* gains = model.gain_marks().gains())
        draw_gain_marks(*ImGui::GetBackgroundDrawList(), *gains, image, model.gain_marks().is_old());
}

}  // namespace pl::ui
