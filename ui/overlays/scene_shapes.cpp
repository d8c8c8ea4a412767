#include "ui/overlays/scene_shapes.h"

#include <algorithm>
#include <cmath>

#include "core/kernel/geometry/intersector.h"
#include "ui/draw/style.h"

namespace pl::ui {
namespace {

constexpr float kLobeShare = 0.09f;  ///< of the scene's diagonal: the longest of the shown lobes
constexpr std::uint8_t kAlpha = 235;
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
    const std::uint8_t alpha = hidden ? kHiddenAlpha : kAlpha;
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

}  // namespace pl::ui
