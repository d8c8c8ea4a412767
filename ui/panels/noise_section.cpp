// The noise of the clicked pixel: shares by technique, bounces and light, of default and of the guided method, and the gain of guidance.
#include <fmt/format.h>

#include "ui/draw/value_text.h"
#include "ui/draw/widgets.h"
#include "ui/panels/panels.h"

namespace pl::ui {
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
    for (const diagnose::FoundByInfo& info : diagnose::all_found_by())
        draw_part(noise, std::string(info.label), [&](const diagnose::NoiseShares& shares) {
            return shares.found_by[static_cast<std::size_t>(info.id)];
        });
    draw_noise_heading("by bounces");
    for (std::size_t i = 0; i < diagnose::kBounceClasses; ++i)
        draw_part(noise, i + 1 < diagnose::kBounceClasses ? fmt::format("{}", i) : fmt::format("{} or more", i),
                  [&](const diagnose::NoiseShares& shares) { return shares.bounces[i]; });
    draw_noise_heading("by light");
    for (std::size_t i = 0; i < 2; ++i)
        draw_part(noise, i == 0 ? "surfaces" : "environment",
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
    text_line(fmt::format("{} {} here", name, mark_text(noise.gain->net)).c_str(),
              to_imgui_color(mark_color(verdict_of(noise.gain->net))));
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
