#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/kernel/film/heat_color.h"
#include "ui/compare/half_image.h"
#include "ui/draw/imgui_draw.h"
#include "ui/draw/picture.h"
#include "ui/draw/style.h"
#include "ui/draw/value_text.h"
#include "ui/draw/widgets.h"
#include "ui/input/actions.h"
#include "ui/overlays/overlays.h"

namespace pl::ui {
namespace {

/// Small labels in a row, from the left.
class BadgeRow {
public:
    BadgeRow(ImVec2 corner, float right, float end)
        : list_(*ImGui::GetBackgroundDrawList()), corner_(corner), left_(corner.x), right_(right), end_(end) {}

    void add(const std::string& text, ImU32 color) {
        gui_memory().badges += text + "; ";
        const std::string lines = text_in_lines(text, right_ - left_ - em(0.9f));
        const ImVec2 size = ImGui::CalcTextSize(lines.c_str());
        const float width = size.x + em(0.9f);
        if (!find_room(width, size.y)) return;
        if (corner_.x + width > right_) gui_memory().cut += text + "; ";
        list_.AddRectFilled(corner_, {corner_.x + width, bottom()}, colors::kBadge, em(0.2f));
        list_.AddText({corner_.x + em(0.45f), corner_.y + em(0.2f)}, color, lines.c_str());
        corner_.x += width + em(0.35f);
    }

    float bottom() const { return corner_.y + height_ + em(0.4f); }

    /// The colors of a heat map from its lowest to its highest value, and their meaning.
    void add_heat_legend(const std::string& text) {
        const float step = em(0.5f);
        const float width = step * static_cast<float>(kHeatSteps);
        if (!find_room(width, ImGui::GetTextLineHeight())) return;
        for (int i = 0; i < kHeatSteps; ++i) {
            const float x = corner_.x + step * static_cast<float>(i);
            const ImU32 low = heat_color_at(i);
            const ImU32 high = heat_color_at(i + 1);
            list_.AddRectFilledMultiColor({x, corner_.y}, {x + step, bottom()}, low, high, high, low);
        }
        corner_.x += width + em(0.1f);
        add(text, colors::kText);
    }

private:
    /// In the next row where this one ends; false above the card or the names of compared pictures.
    bool find_room(float width, float height) {
        if (corner_.x + width > right_ && corner_.x > left_) corner_ = {left_, bottom() + em(0.3f)};
        if (corner_.x == left_) height_ = height;
        return bottom() <= end_;
    }

    static ImU32 heat_color_at(int step) {
        const ByteColor color = heat_color(static_cast<float>(step) / static_cast<float>(kHeatSteps));
        return IM_COL32(color.r, color.g, color.b, 255);
    }

    ImDrawList& list_;
    ImVec2 corner_;
    float left_;
    float right_;
    float end_;
    float height_ = ImGui::GetTextLineHeight();  ///< of the text in the present row: long ones have one of their own
};

bool is_given_up(const PublishedFrame& frame) {
    const auto& guiding = frame.snapshot.guiding;
    return guiding && guiding->variance_ratio && !guiding->pays;
}

/// The name of a run before what is said of its field alone: in turns of two runs that have one each.
std::string whose(const ViewerModel& model, std::size_t side) {
    const auto runs = model.comparison().labels_in_turns();
    const auto has_field = [](const RunLabel& run) { return info_of(run.method).uses_field; };
    return runs && std::ranges::all_of(*runs, has_field) ? name_of((*runs)[side]) + ": " : "";
}

/// Whether guiding pays in this picture, by the variances of its paths: the error of the picture is measured against the baseline
/// elsewhere. Guiding that pays with a ratio below 1 has found hidden light, see GuidingChoice.
void add_guiding_badge(BadgeRow& row, const PublishedFrame& frame, const std::string& run) {
    const auto& guiding = frame.snapshot.guiding;
    if (!guiding || !guiding->variance_ratio) return;
    const double ratio = *guiding->variance_ratio;
    const std::string share = fmt::format(", guided {:.0f} % of the time", 100.0 * guiding->guided_share);
    const std::string measured = fmt::format(": {:.2g} ({:.2g} to {:.2g}) times less variance", ratio,
                                             ratio / guiding->ratio_factor, ratio * guiding->ratio_factor);
    if (!guiding->pays)
        row.add(run + "guiding given up" + measured + share, colors::kWarning);
    else if (ratio < 1.0)
        row.add(run + "guiding finds light that Default misses" + share, colors::kGood);
    else
        row.add(run + "guiding pays" + measured + share, colors::kGood);
}

/// Light that the scene's files do not have, or its lack.
void add_light_badge(BadgeRow& row, SceneLight light) {
    if (light == SceneLight::Default) row.add("default light: a sky with a sun", colors::kText);
    if (light == SceneLight::None) row.add("no light in this scene", colors::kWarning);
}

void add_picture_badges(BadgeRow& row, const ViewerModel& model, const PublishedFrame& frame) {
    const Snapshot& snapshot = frame.snapshot;
    const View view = snapshot.slot.view;
    const std::string back_end = back_end_label(frame.backend.name);
    const bool shows_light = view == View::Beauty || view == View::RadianceMap;
    row.add(shows_light ? fmt::format("{}, {}", method_text(frame.settings, snapshot.slot.method),
                                      light_samples_text(frame.settings.next_event))
                        : std::string(info_of(view).label),
            colors::kText);
    row.add(fmt::format("{}  {} spp{}", back_end, snapshot.passes,
                        shows_light ? "  " + short_seconds(work_seconds(snapshot.clocks)) : ""),
            colors::kText);
    if (frame.preview == Preview::LightSamples) row.add("while moving: preview with light samples", colors::kWarning);
    if (frame.preview == Preview::RadianceMap)
        row.add("while moving: preview by the learned radiance map", colors::kWarning);
    else if (view == View::RadianceMap)
        row.add("radiance map: biased preview", colors::kWarning);
    if (info_of(view).needs_tables && !info_of(snapshot.slot.method).uses_field && frame.preview == Preview::None)
        row.add(fmt::format("field of {0}: {1} continues learning", info_of(learning_method()).label,
                            info_of(learning_method()).key),
                colors::kWarning);
    if (view == View::Depth) row.add(fmt::format("black 0, white {:.4g}", frame.range.high), colors::kText);
    if (shows_heat(frame)) {
        const ValueRange& range = model.display().heat_range(frame);
        row.add_heat_legend(fmt::format("{} to {} {}{}", short_value(range.low), short_value(range.high),
                                        frame.range.unit,
                                        range.scale == ColorScale::Logarithmic ? ", logarithmic" : ""));
    } else if (is_heat_map(view)) {
        row.add_heat_legend(legend(view, frame.range));
    }
    if (model.shows_denoised())
        row.add(fmt::format("denoised preview, {:.0f} ms", 1000.0 * frame.denoise_seconds), colors::kWarning);
    if (frame.divider > 1) row.add(fmt::format("1/{} of the resolution", frame.divider), colors::kWarning);
}

void draw_precompute_progress(ViewerModel& model, const Layout& layout, double share) {
    const Vec2f center = layout.clear.center();
    const float width = std::min(em(24.0f), layout.clear.width - em(1.0f));
    // Height 0: as high as its content.
    begin_fixed_window("precompute", {center.x - 0.5f * width, center.y - em(2.0f), width, 0.0f});
    ImGui::Text("Precomputing the radiance map");
    const float button = em(5.0f);
    ImGui::ProgressBar(static_cast<float>(share), {ImGui::GetContentRegionAvail().x - button - em(0.5f), 0.0f},
                       fmt::format("{:.0f} %", 100.0 * share).c_str());
    ImGui::SameLine();
    if (ImGui::Button("Cancel", {button, 0.0f})) model.render().cancel_precomputation();
    tooltip("Esc: back to the previous method. The part computed so far is kept.");
    ImGui::End();
}

/// The mode of the comparison and its hints.
void add_compare_badges(BadgeRow& row, const ViewerModel& model, const ComparePlan& plan) {
    if (model.comparison().state().mode == CompareMode::Off) return;
    row.add(fmt::format("compare: {}", label_of(model.comparison().state().mode)), colors::kAccent);
    if (plan.has_heat) row.add_heat_legend(error_map_legend());
    if (!plan.hint.empty()) row.add(plan.hint, colors::kWarning);
}

/// The run whose field lies over both of two compared pictures.
void add_field_badge(BadgeRow& row, const ViewerModel& model) {
    const bool has_lobes = model.selection().inspection() != nullptr || !model.selection().pins().is_empty();
    const bool is_shown = model.display().cells() || model.flowers().is_shown() || has_lobes;
    if (!is_shown || model.comparison().state().mode == CompareMode::Off) return;
    const RunLabel run = model.comparison().now();
    row.add("lobes and volumes: " + name_of(run),
            to_text_color(run_color(model.comparison().accuracy().runs(), run)));
}

void add_reference_badge(BadgeRow& row, const ViewerModel& model) {
    if (const auto making = model.references().progress())
        row.add(fmt::format("rendering the reference, {:.0f} %: {}", 100.0 * making->share, making->detail),
                colors::kWarning);
}

ImU32 color_of(const diagnose::DiagnosticInfo& diagnostics) {
    return IM_COL32(diagnostics.color >> 16 & 255, diagnostics.color >> 8 & 255, diagnostics.color & 255, 255);
}

/// The meaning of the marks in the picture, and the progress of the search.
void add_diagnostics_badges(BadgeRow& row, const ViewerModel& model) {
    if (const auto share = model.diagnostics().share())
        row.add(fmt::format("searching for invalid samples, {:.0f} %", 100.0 * *share), colors::kWarning);
    const auto map = model.diagnostics().map();
    if (!map) return;
    for (const diagnose::DiagnosticInfo& diagnostics : diagnose::all_diagnostics()) {
        const std::uint64_t count = map->found[static_cast<std::size_t>(diagnostics.id)];
        if (count > 0)
            row.add(fmt::format("{} {}", short_number(static_cast<double>(count)), diagnostics.label),
                    color_of(diagnostics));
    }
    if (map->found == diagnose::DiagnosticCounts{}) row.add("all samples valid", colors::kGood);
    row.add(fmt::format("after {} spp", map->samples), colors::kText);
    if (!map->is_complete)
        row.add(fmt::format("only the last {} searched", map->traced), colors::kWarning);
    else if (map->has_moving_tables && map->traced > 0)
        row.add("with the present field", colors::kText);
}

/// The number of tiles of each mark; the gain of the picture is that of the table.
void add_gain_badges(BadgeRow& row, const GainMarks& marks) {
    if (!marks.is_shown()) return;
    const TileGains* gains = marks.gains();
    if (gains == nullptr) {
        row.add("gain marks: " + (marks.reason().empty() ? "measuring" : marks.reason()), colors::kWarning);
        return;
    }
    const auto color = [](Verdict verdict) { return to_text_color(mark_color(verdict)); };
    for (const Verdict verdict :
         {Verdict::Faster, Verdict::Slower, Verdict::NoDifference, Verdict::Undecided, Verdict::Unresolved}) {
        const auto count =
            std::ranges::count_if(gains->tiles, [&](const Interval& tile) { return verdict_of(tile) == verdict; });
        if (count > 0)
            row.add(fmt::format("{} of {} tiles: {}", count, gains->tiles.size(), mark_name(verdict)),
                    marks.is_old() ? colors::kFaint : color(verdict));
    }
}

void add_state_badges(BadgeRow& row, const ViewerModel& model) {
    const WorkerStatus& status = model.status();
    if (status.state == WorkerState::Starting) row.add("starting", colors::kWarning);
    const std::string wanted = model.render().wanted_backend();
    if (model.frame() != nullptr && model.frame()->backend.name != wanted && status.state != WorkerState::Failed)
        row.add("switching to " + back_end_label(wanted), colors::kWarning);
    if (model.render().paused()) row.add("paused", colors::kWarning);
    if (!model.window().zoom.is_whole())
        row.add(fmt::format("zoom {:.4g}x", model.window().zoom.scale()), colors::kAccent);
    if (model.exposure().is_on())
        row.add(fmt::format("automatic exposure {:+.2f} EV", model.display().settings().exposure_ev), colors::kText);
    if (const auto writing = model.sequence().progress())
        row.add(fmt::format("writing frame {} of {}, Esc stops", writing->written + 1, writing->frames),
                colors::kWarning);
    if (const auto written = model.past_film().written())
        row.add(fmt::format("writing key frame {}, Esc stops", *written + 1), colors::kWarning);
    if (status.state == WorkerState::Done) row.add("done", colors::kGood);
    if (status.state == WorkerState::Failed) row.add("rendering failed, see the log", colors::kError);
    if (!info_of(model.render().settings().method).learns || !status.field || model.frame() == nullptr) return;
    if (status.field->is_frozen)
        row.add(whose(model, 0) + "learning frozen after " + passes_text(status.field->passes), colors::kWarning);
    else if (status.state == WorkerState::Rendering && status.field->passes > 0 &&
             model.frame()->snapshot.slot.view == View::Beauty && !is_given_up(*model.frame()))
        row.add(whose(model, 0) + "learning, " + passes_text(status.field->passes), colors::kGood);
}

}  // namespace

void draw_badges(ViewerModel& model, const Layout& layout, const ComparePlan& plan) {
    if (is_heat_map(model.render().settings().view)) model.window().values_shown = true;
    const Rect& view = layout.clear;
    // Below a card, which has its place: badges come, go and wrap while pictures render.
    gui_memory().badges.clear();
    const float top = std::max(gui_memory().top_card_end, view.y) + em(0.6f);
    const float names = plan.tiles.empty() ? gui_memory().low_card_start : top_of_names(plan, {});
    BadgeRow row({view.x + em(0.6f), top}, view.x + view.width - em(0.6f),
                 std::min(names, gui_memory().low_card_start));
    // Compared pictures have labels of their own.
    if (model.frame() != nullptr && plan.tiles.empty()) add_picture_badges(row, model, *model.frame());
    if (model.frame() != nullptr) add_guiding_badge(row, *model.frame(), whose(model, 0));
    if (const auto& second = model.link().second_frame()) add_guiding_badge(row, *second, whose(model, 1));
    if (model.frame() != nullptr) add_light_badge(row, model.frame()->facts.light);
    if (model.outside().is_outside())
        row.add(fmt::format("outside the room: {} brings you back", info_of(ActionId::CameraHome).keys),
                colors::kWarning);
    add_compare_badges(row, model, plan);
    const WorkerStatus& status = model.status();
    add_reference_badge(row, model);
    if (plan.tiles.empty()) add_diagnostics_badges(row, model);
    add_gain_badges(row, model.gain_marks());
    add_state_badges(row, model);
    if (model.display().cells())
        row.add(fmt::format("volumes {:.0f} %", 100.0f * model.display().cells_opacity()), colors::kText);
    if (const auto past = model.time().shown_frame(); past && model.display().cells())
        row.add_heat_legend(fmt::format("entropy after {}, 0 to {:g} bits", passes_text(past->passes()),
                                        std::log2(static_cast<float>(past->bins()))));
    add_field_badge(row, model);
    if (model.busy() && !model.references().progress() && !model.diagnostics().share())
        row.add("working", colors::kFaint);
    note_place("badges", {view.x, view.y, view.width, row.bottom() - view.y});
    if (status.state == WorkerState::Precomputing && status.field)
        draw_precompute_progress(model, layout, status.field->precomputed_share);
}

namespace {

ImU32 stripe_of(MessageLevel level) {
    switch (level) {
    case MessageLevel::Info: return colors::kAccent;
    case MessageLevel::Warning: return colors::kWarning;
    case MessageLevel::Error: return colors::kError;
    }
    return colors::kAccent;
}

/// One message with its lower left corner at `corner`; returns its height.
float draw_toast(ImDrawList& list, ImVec2 corner, float max_width, MessageLevel level, const std::string& text) {
    const ImVec2 pad{em(0.7f), em(0.5f)};
    const float wrap = max_width - 2.0f * pad.x;
    const std::string lines = text_in_lines(text, wrap);
    const ImVec2 size = ImGui::CalcTextSize(lines.c_str(), nullptr, false, wrap);
    const float height = size.y + 2.0f * pad.y;
    const ImVec2 low{corner.x, corner.y - height};
    const ImVec2 high{corner.x + size.x + 2.0f * pad.x, corner.y};
    list.AddRectFilled(low, high, ImGui::GetColorU32(ImGuiCol_PopupBg, 0.94f), em(0.2f));
    list.AddRectFilled(low, {low.x + em(0.25f), high.y}, stripe_of(level));
    list.AddText(ImGui::GetFont(), ImGui::GetFontSize(), {low.x + pad.x, low.y + pad.y}, colors::kText, lines.c_str(),
                 nullptr, wrap);
    return height;
}

}  // namespace

void draw_toasts(const ViewerModel& model, const Layout& layout, const ComparePlan& plan) {
    const Rect& view = layout.clear;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    ImVec2 corner{view.x + em(0.6f), view.y + view.height - em(0.6f)};
    if (!plan.tiles.empty()) corner.y = std::min(corner.y, top_of_names(plan, {}) - em(0.6f));
    corner.y = std::min(corner.y, gui_memory().low_card_start - em(0.6f));
    const float width = std::min(view.width - em(1.2f), em(34.0f));
    const Rect& badges = gui_memory().places["badges"];
    for (auto toast = model.messages().toasts().rbegin(); toast != model.messages().toasts().rend(); ++toast) {
        // Older ones have no room where badges are.
        if (toast != model.messages().toasts().rbegin() && corner.y < badges.y + badges.height + em(2.0f)) break;
        corner.y -= draw_toast(list, corner, width, toast->level, toast->text) + em(0.35f);
    }

    if (!model.camera().is_speed_shown()) return;
    const std::string text = fmt::format("speed {:.4g} units/s", model.camera().speed());
    const float text_width = ImGui::CalcTextSize(text.c_str()).x;
    draw_toast(list, {view.center().x - 0.5f * text_width - em(0.7f), view.y + 0.2f * view.height}, em(30.0f),
               MessageLevel::Info, text);
}

void draw_show_panels(ViewerModel& model) {
    constexpr float kShownSeconds = 2.0f;
    if (gui_memory().pointer_rest_seconds > kShownSeconds) return;
    ImGui::SetNextWindowPos({em(0.6f), em(0.6f)});
    ImGui::SetNextWindowBgAlpha(0.8f);
    ImGui::Begin("show panels", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoFocusOnAppearing);
    if (ImGui::Button("Show the panels (Tab)")) model.window().panels.shown = true;
    note_place("show the panels");
    ImGui::End();
}

}  // namespace pl::ui
