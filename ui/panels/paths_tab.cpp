#include <algorithm>

#include <fmt/format.h>

#include "ui/draw/value_text.h"
#include "ui/draw/widgets.h"
#include "ui/model/window_choices.h"
#include "ui/panels/panels.h"
#include "ui/panels/volume_discs.h"

namespace pl::ui {
namespace {

constexpr float kTableEm = 8.6f;

std::string guided_name(const PathExplorer& explorer) { return std::string(info_of(explorer.guided_method()).name); }

void draw_options(PathExplorer& explorer) {
    PathOptions& options = explorer.options();
    const float half = 0.5f * (ImGui::GetContentRegionAvail().x - em(0.4f));
    ImGui::SetNextItemWidth(half);
    ImGui::SliderInt("##count", &options.count, 1, PathExplorer::kMostPaths, "%d paths",
                     ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
    note_place("number of paths");
    tooltip("Of the pixel, by each method. Ctrl+click to type.");
    ImGui::SameLine(0.0f, em(0.4f));
    choice_row("which paths", "Of the samples of the picture.", &options.choice, half);
    choice_row("methods of paths",
               "Both have the same random numbers; those of default are dashed beside those of the guided method.",
               &options.sides, half);
    ImGui::SameLine(0.0f, em(0.4f));
    ImGui::Checkbox("shadow rays", &options.has_shadow_rays);
    tooltip("To the visible lights of light samples; the selected path always has them.");
}

std::string light_text(const std::vector<diagnose::PathRecord>& paths, std::size_t i) {
    return i < paths.size() ? short_value(diagnose::path_light(paths[i])) : "-";
}

/// One row for each pass, by the light of the listed method.
void draw_table(PathExplorer& explorer) {
    const diagnose::PixelPaths& paths = *explorer.paths();
    constexpr ImGuiTableFlags kFlags =
        ImGuiTableFlags_SizingStretchProp | ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg;
    const float width = ImGui::GetContentRegionAvail().x - em(kLegendEm);
    if (!ImGui::BeginTable("paths", 4, kFlags, {width, em(kTableEm)})) return;
    ImGui::TableSetupScrollFreeze(0, 1);
    ImGui::TableSetupColumn("sample");
    ImGui::TableSetupColumn("default");
    ImGui::TableSetupColumn(paths.guided.empty() ? "guided" : guided_name(explorer).c_str());
    ImGui::TableSetupColumn("vertices");
    ImGui::TableHeadersRow();
    for (const std::size_t i : diagnose::by_light(explorer.listed())) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::PushID(static_cast<int>(i));
        const std::string label = fmt::format("{}", paths.passes[i]);
        const bool is_selected = explorer.selected() == i;
        const ImU32 color = is_selected ? colors::kAccent : colors::kText;
        ImGui::PushStyleColor(ImGuiCol_Text, color);
        if (ImGui::Selectable(label.c_str(), is_selected, ImGuiSelectableFlags_SpanAllColumns)) explorer.select(i);
        ImGui::PopStyleColor();
        note_place(("path " + label).c_str());
        ImGui::PopID();
        text_cell(light_text(paths.plain, i), color);
        text_cell(light_text(paths.guided, i), color);
        text_cell(fmt::format("{}", explorer.listed()[i].vertices.size()), color);
    }
    ImGui::EndTable();
}

void draw_table_with_legend(PathExplorer& explorer) {
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x;
    draw_table(explorer);
    draw_legend(*ImGui::GetWindowDrawList(),
                {corner.x + width - em(kLegendEm - 0.6f), corner.y, em(kLegendEm - 0.6f), em(kTableEm)},
                explorer.range());
}

std::string triple_text(Vec3f v) { return fmt::format("{:.3g}  {:.3g}  {:.3g}", v.x, v.y, v.z); }

void draw_light(const diagnose::VertexRecord& vertex) {
    if (!is_black(vertex.emission.radiance))
        text_row(
            "emission",
            fmt::format("+{:.3g}  weight {:.3g}", luminance(vertex.emission.contribution), vertex.emission.weight),
            "Luminance that it adds to the pixel, and its MIS weight against light samples.");
    if (!vertex.light) return;
    text_row("light sample",
             vertex.light->is_visible
                 ? fmt::format("+{:.3g}  weight {:.3g}", luminance(vertex.light->contribution), vertex.light->weight)
                 : "occluded",
             "Luminance that it adds to the pixel, and its MIS weight.");
    text_row("  densities",
             fmt::format("light {:.3g}, scattering {:.3g}", vertex.light->pdf_sa, vertex.light->scatter_pdf_sa),
             "Of sampling the direction of the light, by either technique, per steradian.");
}

void draw_direction(const diagnose::ScatterRecord& direction) {
    text_row("direction", fmt::format("by {}", label_of(direction.technique)), "The technique that sampled it.");
    if (direction.technique != diagnose::Technique::Delta)
        text_row("  densities",
                 fmt::format("{:.3g}: bsdf {:.3g}, field {:.3g}", direction.pdf_sa, direction.bsdf_pdf_sa,
                             direction.field_pdf_sa),
                 "Of the mixture, of BSDF sampling and of the field, per steradian.");
    text_row("  throughput", triple_text(direction.throughput), "Of the path up to the next vertex.");
}

void draw_vertex(const diagnose::VertexRecord& vertex, std::size_t index, const SceneDescription& scene) {
    const bool has_name = !vertex.is_escape && vertex.material < scene.materials.size();
    const std::string name = vertex.is_escape ? "leaves the scene"
                             : has_name       ? scene.materials[vertex.material].name
                                              : "";
    ImGui::TextColored(to_vec4(colors::kAccent), "%zu  %s", index, name.c_str());
    const float light = luminance(vertex.contribution());
    if (light > 0.0f) {
        ImGui::SameLine();
        ImGui::TextColored(to_vec4(colors::kGood), "+%.3g", static_cast<double>(light));
    }
    if (vertex.volume != kNoVolume)
        text_row("volume", fmt::format("{}, BSDF fraction {:.2f}", vertex.volume, vertex.bsdf_fraction),
                 "The radiance volume that serves the vertex, and the probability of BSDF sampling.");
    if (vertex.delta_probability > 0.0f)
        text_row("delta lobe", fmt::format("probability {:.2f}", vertex.delta_probability));
    draw_light(vertex);
    if (vertex.roulette)
        text_row("roulette",
                 fmt::format("{:.3g}: {}", vertex.roulette->survival_probability,
                             vertex.roulette->survives ? "continues" : "ends"),
                 "Survival probability and outcome.");
    if (vertex.scattered) draw_direction(*vertex.scattered);
}

void draw_path(const PathExplorer& explorer, const SceneDescription& scene) {
    const std::optional<std::size_t> selected = explorer.selected();
    if (!selected) return;
    const diagnose::PathRecord& path = explorer.listed()[*selected];
    const std::string method = explorer.lists_guided() ? guided_name(explorer) : std::string("default");
    ImGui::Text("Sample %u by %s%s", explorer.paths()->passes[*selected], method.c_str(),
                explorer.lists_guided() && !path.is_guided ? ", not guided" : "");
    text_row("Radiance", triple_text(path.radiance), "That the path brought to the pixel, in linear RGB.");
    ImGui::Separator();
    for (std::size_t i = 0; i < path.vertices.size(); ++i) {
        draw_vertex(path.vertices[i], i, scene);
        if (i + 1 == path.vertices.size()) text_row("end", std::string(label_of(path.end)));
        ImGui::Separator();
    }
}

}  // namespace

void draw_paths_tab(ViewerModel& model) {
    PathExplorer& explorer = model.paths();
    bool shown = explorer.is_shown();
    if (toggle_row("Trace the clicked pixel", "J: the paths of the pixel, as lines in the picture and one by one.",
                   &shown))
        explorer.set_shown(shown);
    if (!shown) return;
    draw_options(explorer);
    if (explorer.paths() == nullptr || model.frame() == nullptr) {
        faint_text(explorer.is_tracing() ? "Tracing." : "Click a pixel in the picture.");
        return;
    }
    const diagnose::PixelPaths& paths = *explorer.paths();
    text_row(
        "Pixel",
        fmt::format("{}, {}: {} of {} samples{}", explorer.x(), explorer.y(), paths.passes.size(), paths.searched,
                    explorer.is_tracing() ? ", tracing" : ""),
        "The paths shown, of the samples that were searched. Guided paths sample from the field as it was at the "
        "click.");
    draw_noise_section(explorer);
    draw_table_with_legend(explorer);
    draw_path(explorer, *model.frame()->description);
}

// The noise of the clicked pixel: shares by technique, bounces and light, of default and of the guided method, and the gain of guidance.

namespace {

/// The half width of an interval.
double spread(const Interval& value) { return 0.5 * (value.high - value.low); }

/// "97 ± 2"; empty for a part without contributions.
std::string share_text(const Interval& share) {
    if (share.value == 0.0 && spread(share) == 0.0) return "-";
    return fmt::format("{:.0f} \u00b1 {:.0f} %", 100.0 * share.value, 100.0 * spread(share));
}

bool has_part(const Interval& share) { return share.value != 0.0 || spread(share) != 0.0; }

/// One row for a part that has a share by either method.
template <class Share>
void draw_part(const diagnose::PixelNoise& noise, const std::string& name, Share share) {
    const Interval none{};
    const Interval plain = noise.plain.shares ? share(*noise.plain.shares) : none;
    const Interval guided = noise.guided && noise.guided->shares ? share(*noise.guided->shares) : none;
    if (!has_part(plain) && !has_part(guided)) return;
    ImGui::TableNextRow();
    text_cell(name, colors::kFaint);
    text_cell(share_text(plain));
    if (noise.guided) text_cell(share_text(guided));
}

void draw_noise_heading(const char* name) {
    ImGui::TableNextRow();
    text_cell(name, colors::kAccent);
}

template <class Figure>
void draw_figure(const diagnose::PixelNoise& noise, const char* name, Figure figure) {
    ImGui::TableNextRow();
    text_cell(name, colors::kFaint);
    text_cell(figure(noise.plain));
    if (noise.guided) text_cell(figure(*noise.guided));
}

void draw_shares(const diagnose::PixelNoise& noise) {
    constexpr ImGuiTableFlags kFlags = ImGuiTableFlags_SizingStretchProp | ImGuiTableFlags_RowBg;
    if (!ImGui::BeginTable("noise", noise.guided ? 3 : 2, kFlags)) return;
    ImGui::TableSetupColumn("share of the noise");
    ImGui::TableSetupColumn("default");
    if (noise.guided) ImGui::TableSetupColumn(std::string(info_of(noise.guided_method).name).c_str());
    ImGui::TableHeadersRow();
    for (const ChoiceInfo<diagnose::Technique>& info : kChoices<diagnose::Technique>)
        draw_part(noise, std::string(info.label), [&](const diagnose::NoiseShares& shares) {
            return shares.found_by[static_cast<std::size_t>(info.value)];
        });
    draw_noise_heading("by bounces");
    for (std::size_t i = 0; i < diagnose::kBounceClasses; ++i)
        draw_part(noise, diagnose::bounce_name(i),
                  [&](const diagnose::NoiseShares& shares) { return shares.bounces[i]; });
    draw_noise_heading("by light");
    for (std::size_t i = 0; i < diagnose::kNoiseLights.size(); ++i)
        draw_part(noise, diagnose::kNoiseLights[i],
                  [&](const diagnose::NoiseShares& shares) { return shares.lights[i]; });
    draw_noise_heading("of one path");
    draw_figure(noise, "luminance",
                [](const diagnose::PixelEstimate& e) { return fmt::format("{:.3g}", e.mean.value); });
    draw_figure(noise, "variance",
                [](const diagnose::PixelEstimate& e) { return fmt::format("{:.3g}", e.variance.value); });
    draw_figure(noise, "time", [](const diagnose::PixelEstimate& e) { return short_seconds(e.seconds_per_path); });
    ImGui::EndTable();
}

/// In one line, in the color of its mark.
void draw_pixel_gain(const diagnose::PixelNoise& noise) {
    if (!noise.guided) {
        faint_text(
            fmt::format("No method has learned a field: press {} to compare one.", info_of(learning_method()).key)
                .c_str());
        return;
    }
    const std::string name{info_of(noise.guided_method).name};
    if (!noise.gain) {
        faint_text("Undecided: a method has found no light in this pixel, or has no noise.");
        return;
    }
    text_line(fmt::format("{} {} in this pixel", name, mark_name(verdict_of(noise.gain->net))).c_str(),
              to_text_color(mark_color(verdict_of(noise.gain->net))));
    tooltip("Time to the same noise in this pixel: variance times time of a path, default's over the method's, with "
            "its 95 % interval. "
            "Both are measured here, by paths in turns.");
    faint_text((headline(*noise.gain, "default")).c_str());
}

}  // namespace

void draw_noise_section(PathExplorer& explorer) {
    if (!section("Why this pixel?", false)) return;
    NoiseTracing& tracing = explorer.noise();
    tracing.show();
    if (!tracing.failure().empty()) text_line(tracing.failure().c_str(), colors::kError);
    const diagnose::PixelNoise* noise = tracing.noise();
    if (noise == nullptr) {
        faint_text("Tracing its first paths.");
        return;
    }
    draw_pixel_gain(*noise);
    draw_shares(*noise);
    faint_text(fmt::format("{} paths by each, {}", short_number(static_cast<double>(noise->plain.paths)),
                           short_seconds(tracing.seconds()))
                   .c_str());
    tooltip("A part's share of the variance is its covariance with the whole path's light: all add up to 100 %, and "
            "one that "
            "makes up for others is negative. On a thread of low priority; its time is on no other clock.");
}

}  // namespace pl::ui
