#include <array>

#include <fmt/format.h>

#include "core/kernel/film/heat_color.h"
#include "core/kernel/film/tonemap.h"
#include "core/kernel/geometry/intersector.h"
#include "core/kernel/scene/surface_point.h"
#include "ui/draw/tab_row.h"
#include "ui/draw/widgets.h"
#include "ui/panels/panels.h"

namespace pl::ui {
namespace {

ImU32 color_of(MessageLevel level) {
    switch (level) {
    case MessageLevel::Info: return colors::kText;
    case MessageLevel::Warning: return colors::kWarning;
    case MessageLevel::Error: return colors::kError;
    }
    return colors::kText;
}

std::string vector_text(Vec3f v) { return fmt::format("{:.4g}  {:.4g}  {:.4g}", v.x, v.y, v.z); }

std::string radiance_text(Vec3f v) { return fmt::format("{:.5g}  {:.5g}  {:.5g}", v.x, v.y, v.z); }

/// The surface under the center of a pixel, by a ray of the window's thread: the render thread need not answer.
std::optional<PickedPoint> surface_under(const PublishedFrame& frame, const PixelPosition& pixel) {
    const Snapshot& snapshot = frame.snapshot;
    const Camera camera = make_camera(snapshot.camera, snapshot.width, snapshot.height);
    const Ray ray = generate_ray(camera, {static_cast<float>(pixel.x) + 0.5f, static_cast<float>(pixel.y) + 0.5f},
                                 {static_cast<float>(snapshot.width), static_cast<float>(snapshot.height)});
    const SceneView scene = frame.scene->view();
    const Hit hit = BvhIntersector{scene}.closest_hit(ray);
    if (!hit.found()) return std::nullopt;
    const SurfacePoint surface = make_surface_point<kPlaceFeatures>(scene, hit, -ray.direction);
    PickedPoint point;
    point.position = surface.position;
    point.normal = surface.geometric_normal;
    point.primitive = surface.primitive;
    point.material = surface.material;
    point.distance = hit.t;
    return point;
}

/// 8-bit sRGB of a pixel's value on screen.
std::array<int, 3> shown_code(const DisplayControls& display, const PublishedFrame& frame, Vec3f value) {
    const View view = frame.snapshot.slot.view;
    if (is_heat_map(view)) {
        const ByteColor color = heat_color(display.heat_range(frame).position(value.x));
        return {color.r, color.g, color.b};
    }
    const DisplaySettings settings = display_of(view, frame.display);
    const Vec3f shown = tone_map(value * frame.range.scale(), std::exp2(settings.exposure_ev), settings.curve);
    std::array<int, 3> code;
    for (int i = 0; i < 3; ++i)
        code[static_cast<std::size_t>(i)] = static_cast<int>(std::lround(255.0f * encode_srgb(shown[i])));
    return code;
}

void draw_pixel_values(const DisplayControls& display, const PublishedFrame& frame, const PixelPosition& pixel) {
    const Snapshot& snapshot = frame.snapshot;
    if (!frame.has_values()) return;  // the next frame brings them
    const std::size_t index = static_cast<std::size_t>(pixel.y) * static_cast<std::size_t>(snapshot.width) +
                              static_cast<std::size_t>(pixel.x);
    const Vec3f value = snapshot.pixels[index];
    const std::array<int, 3> code = shown_code(display, frame, value);
    text_row("Pixel", fmt::format("{}, {} of {}x{}", pixel.x, pixel.y, snapshot.width, snapshot.height));
    if (is_heat_map(snapshot.slot.view)) {
        text_row("Value", fmt::format("{:.5g}  {}", value.x, frame.range.unit),
                 "Of the radiance volume of this point.");
    } else {
        text_row("Linear RGB", radiance_text(value), "Mean of all samples before exposure and tone curve.");
        text_row("Luminance", fmt::format("{:.5g}", luminance(value)));
    }
    text_row("On screen",
             fmt::format("{}  {}  {}   #{:02x}{:02x}{:02x}", code[0], code[1], code[2], code[0], code[1], code[2]),
             "8-bit sRGB after exposure and tone curve.");
    ImGui::ColorButton("##swatch",
                       {static_cast<float>(code[0]) / 255.0f, static_cast<float>(code[1]) / 255.0f,
                        static_cast<float>(code[2]) / 255.0f, 1.0f},
                       ImGuiColorEditFlags_NoTooltip | ImGuiColorEditFlags_NoDragDrop,
                       {ImGui::GetContentRegionAvail().x, em(2.0f)});
}

void draw_surface(const PublishedFrame& frame, const PixelPosition& pixel) {
    const std::optional<PickedPoint> point = surface_under(frame, pixel);
    if (!point) {
        faint_text("The ray leaves the scene.");
        return;
    }
    text_row("Position", vector_text(point->position), "In scene units.");
    text_row("Normal", vector_text(point->normal), "Geometric normal, towards the camera.");
    text_row("Distance", fmt::format("{:.5g}", point->distance));
    text_row("Triangle", fmt::format("{}", point->primitive));
    const auto& materials = frame.description->materials;
    if (point->material >= materials.size()) return;
    const MaterialDescription& material = materials[point->material];
    text_row("Material", material.name.empty() ? "(no name)" : material.name);
    text_row("Albedo", vector_text(material.albedo));
    if (!is_black(material.emission)) text_row("Emission", vector_text(material.emission));
}

}  // namespace

void draw_pixel_tab(ViewerModel& model, const std::optional<PixelPosition>& hovered) {
    draw_histogram(model);
    if (!section("Under the pointer", true)) return;
    const PublishedFrame* frame = model.frame();
    if (!hovered || frame == nullptr) {
        faint_text("Move the pointer over the picture.");
        return;
    }
    model.window().values_shown = true;
    draw_pixel_values(model.display(), *frame, *hovered);
    ImGui::Separator();
    draw_surface(*frame, *hovered);
}

void draw_log_tab(const ViewerModel& model) {
    if (ImGui::Button("Copy all")) {
        std::string text;
        for (const LogLine& line : model.messages().log())
            text += fmt::format("{:9.2f}  {}\n", line.seconds, line.text);
        ImGui::SetClipboardText(text.c_str());
    }
    ImGui::BeginChild("lines", {0.0f, 0.0f}, true);
    for (const LogLine& line : model.messages().log()) {
        ImGui::TextDisabled("%7.2f", line.seconds);
        ImGui::SameLine();
        ImGui::PushStyleColor(ImGuiCol_Text, color_of(line.level));
        wrapped_text(line.text.c_str());
        ImGui::PopStyleColor();
    }
    if (ImGui::GetScrollY() >= ImGui::GetScrollMaxY()) ImGui::SetScrollHereY(1.0f);
    ImGui::EndChild();
}

void draw_knowledge_panel(ViewerModel& model, const Layout& layout, const std::optional<PixelPosition>& hovered) {
    model.selection().hover_cell(-1);  // the volume tab sets it again if it is in front
    begin_fixed_window("knowledge", layout.right);
    const bool research = is_research(model);
    const bool traces = model.paths().is_shown();
    TabRow tabs("tabs");
    // A click shows the material while materials are looked at, else the paths of the pixel if they are on, or else the volume.
    if (model.selection().take_new_volume() && !tabs.shows("Material")) tabs.choose(traces ? "Paths" : "Volume");
    const bool volume = tabs.add("Volume");
    const bool paths = (research || traces) && tabs.add("Paths");
    const bool material = tabs.add("Material");
    const bool effects = research && tabs.add("Effects");
    const bool pixel = tabs.add("Pixel");
    const bool statistics = research && tabs.add("Statistics");
    const bool log = research && tabs.add("Log");
    tabs.end();
    if (!material && !effects && !log && model.comparison().state().mode != CompareMode::Off)
        faint_text(("Of the present run: " + name_of(model.comparison().now())).c_str());
    if (volume) draw_volume_tab(model);
    if (paths) draw_paths_tab(model);
    if (material) draw_material_tab(model);
    if (effects) draw_effects_tab(model);
    if (pixel) draw_pixel_tab(model, hovered);
    if (statistics) draw_statistics_tab(model);
    if (log) draw_log_tab(model);
    ImGui::End();
}

}  // namespace pl::ui
