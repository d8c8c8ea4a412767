#include "ui/script/script_values.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "core/session/backend.h"
#include "ui/draw/imgui_draw.h"
#include "ui/model/viewer_model.h"
#include "ui/model/window_memory.h"
#include "ui/script/overlay_values.h"

namespace pl::ui {
namespace {

using Value = ScriptValue;

std::string word(bool value) { return value ? "yes" : "no"; }

std::string comma_text(Vec3f v) { return fmt::format("{:.3f},{:.3f},{:.3f}", v.x, v.y, v.z); }

std::string last_message(const ViewerModel& model) {
    return model.messages().log().empty() ? "" : model.messages().log().back().text;
}

std::string learned_passes(const ViewerModel& model) {
    return fmt::format("{}", model.status().field ? model.status().field->passes : 0);
}

/// A property of the picture in the window, which follows the settings after the next pass.
template <auto kRead>
std::string shown(const ViewerModel& model) {
    return model.frame() != nullptr ? kRead(*model.frame()) : "none";
}

/// Stored points of the run in progress, else of the newest run.
std::string point_count(const ViewerModel& model) {
    std::size_t points = 0;
    for (const auto& run : model.comparison().accuracy().runs()) {
        points = run->points.size();
        if (run->in_progress) break;
    }
    return fmt::format("{}", points);
}

/// Labels of the compared pictures, in a window of any size.
std::string shown_sides(const ViewerModel& model) {
    std::string text;
    for (const CompareTile& tile : model.comparison().plan({0.0f, 0.0f, 600.0f, 600.0f}).tiles)
        text += (text.empty() ? "" : " | ") + tile.label;
    return text;
}

std::string cursor_kind(const ViewerModel& model) {
    const Cursor::Kind kind = model.comparison().accuracy().cursor().kind;
    return kind == Cursor::Kind::None ? "none" : (kind == Cursor::Kind::EqualCost ? "cost" : "error");
}

/// The marks in the picture.
std::string diagnostics_found(const ViewerModel& model) {
    const auto map = model.diagnostics().map();
    return map ? summary_of(*map) : "not searched";
}

std::string turn_passes(const ViewerModel& model, std::size_t side) {
    return fmt::format("{}", model.status().turns ? model.status().turns->passes[side] : 0);
}

/// The sentence on the newest run of the table that is compared; without one the note, or why there is none.
std::string headline_text(const ViewerModel& model) {
    const RunTable& table = model.comparison().accuracy().table();
    std::string text = table.note;
    std::uint64_t newest = 0;
    for (const RunRow& row : table.rows) {
        if (row.missing == MissingGain::IsBase || row.run < newest) continue;
        newest = row.run;
        text = row.remark;
    }
    return text;
}

/// Of the tooltip "beside" the panel under the pointer and the card of the tour, or "over" one of them; "none".
std::string tooltip_place(const ViewerModel&) {
    const auto& places = gui_memory().places;
    const auto tooltip = places.find("tooltip");
    if (tooltip == places.end()) return "none";
    const ImVec2 pointer = ImGui::GetIO().MousePos;
    const auto is_covered = [&](const char* name, bool is_pointed) {
        const auto part = places.find(name);
        if (part == places.end() || (is_pointed && !part->second.contains({pointer.x, pointer.y}))) return false;
        const Rect common = common_part(part->second, tooltip->second);
        return common.width > 0.0f && common.height > 0.0f;
    };
    const bool is_over = is_covered("tour", false) || is_covered("settings", true) || is_covered("knowledge", true) ||
                         is_covered("accuracy", true);
    return is_over ? "over" : "beside";
}

/// "96,134", "none".
std::string pointed_at(const ViewerModel& model) {
    const auto& pointed = model.window().pointed;
    return pointed ? fmt::format("{},{}", pointed->at.x, pointed->at.y) : "none";
}

/// Linear red, green and blue, "none".
std::string pointed_value(const ViewerModel& model) {
    const auto& pointed = model.window().pointed;
    return pointed && pointed->value ? comma_text(*pointed->value) : "none";
}

/// "opening=17.9", "none".
std::string knob_text(const std::vector<KnobDescription>& knobs) {
    std::string text;
    for (const KnobDescription& knob : knobs)
        text += fmt::format("{}{}={}", text.empty() ? "" : ",", knob.name, knob.value);
    return text.empty() ? "none" : text;
}

constexpr std::array kValues{
    Value{"method", [](const ViewerModel& m) { return std::string(info_of(m.render().settings().method).name); }},
    Value{"view", [](const ViewerModel& m) { return std::string(info_of(m.render().settings().view).name); }},
    Value{"state", [](const ViewerModel& m) { return std::string(name_of(m.status().state)); }},
    Value{"spp", [](const ViewerModel& m) { return fmt::format("{}", m.status().passes); }},
    Value{"learned", learned_passes},
    Value{"frozen", [](const ViewerModel& m) { return word(m.status().field && m.status().field->is_frozen); }},
    Value{"backend", [](const ViewerModel& m) { return m.status().backend; }},
    Value{"nee", [](const ViewerModel& m) { return word(m.render().settings().next_event); }},
    Value{"exposure", [](const ViewerModel& m) { return fmt::format("{}", m.display().settings().exposure_ev); }},
    Value{"opacity", [](const ViewerModel& m) { return fmt::format("{:.2f}", m.display().cells_opacity()); }},
    Value{"list",
          [](const ViewerModel&) {
              return std::string(ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup) ? "open" : "closed");
          }},
    Value{"accuracy", [](const ViewerModel& m) { return word(m.window().panels.accuracy); }},
    Value{"runs", [](const ViewerModel& m) { return fmt::format("{}", m.comparison().accuracy().runs().size()); }},
    Value{"points", point_count},
    Value{"plotted",
          [](const ViewerModel& m) { return std::string(info_of(m.comparison().accuracy().kind().metric).label); }},
    Value{"headline", headline_text},
    Value{"compare", [](const ViewerModel& m) { return std::string(label_of(m.comparison().state().mode)); }},
    Value{"sides", shown_sides},
    Value{"split", [](const ViewerModel& m) { return fmt::format("{:.2f}", m.comparison().state().split); }},
    Value{"cursor", cursor_kind},
    Value{"cursor_at", [](const ViewerModel& m) { return fmt::format("{}", m.comparison().accuracy().cursor().at); }},
    Value{"rows", [](const ViewerModel& m) { return fmt::format("{}", m.comparison().accuracy().rows().size()); }},
    Value{"reference", [](const ViewerModel& m) { return word(m.references().current() != nullptr); }},
    Value{"reference_share",
          [](const ViewerModel& m) {
              const auto making = m.references().progress();
              return fmt::format("{}", making ? making->share : 0.0);
          }},
    Value{"making", [](const ViewerModel& m) { return word(m.references().progress().has_value()); }},
    Value{"turns", [](const ViewerModel& m) { return word(m.comparison().in_turns()); }},
    Value{"turn_a", [](const ViewerModel& m) { return turn_passes(m, 0); }},
    Value{"turn_b", [](const ViewerModel& m) { return turn_passes(m, 1); }},
    Value{"cells", [](const ViewerModel& m) { return word(m.display().cells()); }},
    Value{"hemisphere", [](const ViewerModel& m) { return word(m.window().hemisphere); }},
    Value{"help", [](const ViewerModel& m) { return word(m.window().help); }},
    Value{"about", [](const ViewerModel& m) { return word(m.window().about); }},
    Value{"tooltip_place", tooltip_place},
    Value{"panels", [](const ViewerModel& m) { return word(m.window().panels.shown); }},
    Value{"badges", [](const ViewerModel&) { return gui_memory().badges; }},
    Value{"cut", [](const ViewerModel&) { return gui_memory().cut.empty() ? "none" : gui_memory().cut; }},
    Value{"moved", [](const ViewerModel&) { return gui_memory().moved.empty() ? "none" : gui_memory().moved; }},
    Value{"theme", [](const ViewerModel& m) { return std::string(pl::name_of(m.window().theme)); }},
    Value{"ground", [](const ViewerModel&) { return fmt::format("{:06x}", colors::kGround & 0xffffffu); }},
    Value{"keyed_panel",
          [](const ViewerModel& m) {
              const auto& panel = m.window().keyed_panel;
              return panel ? fmt::format("{}", static_cast<int>(*panel)) : std::string("none");
          }},
    Value{"window",
          [](const ViewerModel&) {
              const ImVec2 size = ImGui::GetIO().DisplaySize;
              return fmt::format("{:.0f}x{:.0f}", size.x, size.y);
          }},
    Value{"ui_scale", [](const ViewerModel& m) { return fmt::format("{}", m.window().ui_scale); }},
    Value{"layout", [](const ViewerModel& m) { return std::string(name_of(m.window().layout)); }},
    Value{"settings_panel",
          [](const ViewerModel& m) { return word(m.window().panels.shows_settings(m.window().one_side)); }},
    Value{"right_side",
          [](const ViewerModel& m) { return word(m.window().panels.shows_right(m.window().one_side)); }},
    Value{"tabs", [](const ViewerModel& m) { return word(m.window().panels.tabs); }},
    Value{"settings_em", [](const ViewerModel& m) { return fmt::format("{:.2f}", m.window().panels.settings_em); }},
    Value{"right_em", [](const ViewerModel& m) { return fmt::format("{:.2f}", m.window().panels.right_em); }},
    Value{"accuracy_share",
          [](const ViewerModel& m) { return fmt::format("{:.2f}", m.window().panels.accuracy_share); }},
    Value{"moving", [](const ViewerModel& m) { return word(m.camera().is_moving()); }},
    Value{"busy", [](const ViewerModel& m) { return word(m.busy()); }},
    Value{"volume", [](const ViewerModel& m) { return fmt::format("{}", m.selection().volume()); }},
    Value{"inspected",
          [](const ViewerModel& m) {
              const Selection& selection = m.selection();
              return word(selection.inspection() != nullptr && !selection.awaits_pick());
          }},
    Value{"at_home",
          [](const ViewerModel& m) {
              const CameraDescription& home = m.scene().materials().file()->camera;
              const CameraDescription& now = m.camera().camera();
              return word(now.eye == home.eye && now.target == home.target);
          }},
    Value{"outside", [](const ViewerModel& m) { return word(m.outside().is_outside()); }},
    Value{"eye", [](const ViewerModel& m) { return comma_text(m.render().settings().camera.eye); }},
    Value{"eye_z", [](const ViewerModel& m) { return fmt::format("{}", m.render().settings().camera.eye.z); }},
    Value{"target", [](const ViewerModel& m) { return comma_text(m.render().settings().camera.target); }},
    Value{"speed", [](const ViewerModel& m) { return fmt::format("{}", m.camera().speed()); }},
    Value{"size",
          [](const ViewerModel& m) {
              return fmt::format("{}x{}", m.render().settings().width, m.render().settings().height);
          }},
    Value{"title", [](const ViewerModel& m) { return m.title(); }},
    Value{"message", last_message},
    Value{"toasts", [](const ViewerModel& m) { return fmt::format("{}", m.messages().toasts().size()); }},
    Value{"shown_method", shown<[](const PublishedFrame& f) { return std::string(info_of(f.snapshot.slot.method).name); }>},
    Value{"shown_view", shown<[](const PublishedFrame& f) { return std::string(info_of(f.snapshot.slot.view).name); }>},
    Value{"shown_spp", shown<[](const PublishedFrame& f) { return fmt::format("{}", f.snapshot.passes); }>},
    Value{"shown_backend", shown<[](const PublishedFrame& f) { return f.backend.name; }>},
    Value{"shown_device", shown<[](const PublishedFrame& f) { return device_text(f.backend); }>},
    Value{"undo", [](const ViewerModel& m) { return m.history().undone_next(); }},
    Value{"redo", [](const ViewerModel& m) { return m.history().redone_next(); }},
    Value{"shown_denoised", [](const ViewerModel& m) { return word(m.shows_denoised()); }},
    Value{"shown_preview", shown<[](const PublishedFrame& f) { return std::string(name_of(f.preview)); }>},
    Value{"shown_light", shown<[](const PublishedFrame& f) { return std::string(name_of(f.facts.light)); }>},
    Value{"shown_divider", shown<[](const PublishedFrame& f) { return fmt::format("{}", f.divider); }>},
    Value{"shown_cells", shown<[](const PublishedFrame& f) { return word(f.cells != nullptr); }>},
    Value{"material",
          [](const ViewerModel& m) {
              const auto index = m.scene().selected_material();
              return index ? shown_name(m.scene().materials().now()[*index], *index) : std::string("none");
          }},
    Value{"measure_percent",
          [](const ViewerModel& m) {
              const LiveRunSet* set = m.comparison().accuracy().set();
              const bool any = set != nullptr && set->charged_seconds > 0.0;
              return fmt::format("{:.3f}", any ? 100.0 * set->measure_seconds / set->charged_seconds : 0.0);
          }},
    Value{"charged",
          [](const ViewerModel& m) {
              return fmt::format("{:.2f}", m.comparison().accuracy().set() != nullptr
                                               ? m.comparison().accuracy().set()->charged_seconds
                                               : 0.0);
          }},
    Value{"edited",
          [](const ViewerModel& m) { return fmt::format("{}", m.scene().materials().edited_names().size()); }},
    Value{"scene", [](const ViewerModel& m) { return m.scene().name(); }},
    Value{"tour", [](const ViewerModel& m) { return state_text(m.tour()); }},
    Value{"tour_seen", [](const ViewerModel& m) { return word(m.tour().is_seen()); }},
    Value{"lesson", [](const ViewerModel& m) { return lesson_text(m); }},
    Value{"tells",
          [](const ViewerModel& m) {
              const auto headline = m.comparison().headline();
              return headline ? headline->text : std::string("none");
          }},
    Value{"dialog", [](const ViewerModel& m) { return word(m.open_dialog().is_shown()); }},
    Value{"open_choice", [](const ViewerModel& m) { return m.open_dialog().choice(); }},
    Value{"typing", [](const ViewerModel&) { return word(ImGui::GetIO().WantTextInput); }},
    Value{"thumbnails", [](const ViewerModel& m) { return fmt::format("{}", m.open_dialog().card_count()); }},
    Value{"folder", [](const ViewerModel& m) { return m.open_dialog().listing().folder.string(); }},
    Value{"knobs", [](const ViewerModel& m) { return knob_text(m.scene().knobs()); }},
    Value{"shown_knobs", shown<[](const PublishedFrame& f) { return knob_text(f.description->knobs); }>},
    Value{"roughness",
          [](const ViewerModel& m) {
              const auto index = m.scene().selected_material();
              return fmt::format("{:.3f}", index ? m.scene().materials().now()[*index].roughness : 0.0f);
          }},
    Value{"kernel", shown<[](const PublishedFrame& f) { return f.snapshot.kernel; }>},
    Value{"zoom", [](const ViewerModel& m) { return fmt::format("{:.4g}", m.window().zoom.scale()); }},
    Value{"pixel", pointed_at},
    Value{"pixel_value", pointed_value},
    Value{"magnifier", [](const ViewerModel& m) { return word(m.window().magnifier); }},
    Value{"values_shown", [](const ViewerModel& m) { return word(m.window().values_shown); }},
    Value{"histograms", [](const ViewerModel& m) { return fmt::format("{}", m.exposure().times_made()); }},
    Value{"auto_exposure", [](const ViewerModel& m) { return word(m.exposure().is_on()); }},
    Value{"bookmarks", [](const ViewerModel& m) { return fmt::format("{}", m.bookmarks().list().size()); }},
    Value{"bookmark",
          [](const ViewerModel& m) {
              const auto current = m.bookmarks().current();
              return current ? fmt::format("{}", *current + 1) : std::string("none");
          }},
    Value{"flying", [](const ViewerModel& m) { return word(m.flight().is_flying()); }},
    Value{"writing", [](const ViewerModel& m) { return word(m.sequence().progress().has_value()); }},
    Value{"written",
          [](const ViewerModel& m) {
              const auto progress = m.sequence().progress();
              return fmt::format("{}", progress ? progress->written : 0);
          }},
    Value{"picked",
          [](const ViewerModel& m) {
              const auto& picked = m.selection().picked();
              return picked ? comma_text(picked->position) : std::string("none");
          }},
    Value{"diagnostics", diagnostics_found},
    Value{"searching", [](const ViewerModel& m) { return word(m.diagnostics().share().has_value()); }},
    Value{"selftest_shown", [](const ViewerModel& m) { return word(m.self_test().is_shown()); }},
    Value{"selftest", [](const ViewerModel& m) { return std::string(name_of(m.self_test().run().outcome())); }},
    Value{"checks", [](const ViewerModel& m) { return fmt::format("{}", m.self_test().run().checks().size()); }},
    Value{"invalid", shown<[](const PublishedFrame& f) { return fmt::format("{}", f.snapshot.counters.invalid_samples); }>},
};

const ScriptValue* find_value(std::string_view name) {
    for (const std::span<const ScriptValue> values : {std::span<const ScriptValue>(kValues), overlay_values()})
        if (const auto value = std::ranges::find(values, name, &ScriptValue::name); value != values.end())
            return &*value;
    return nullptr;
}

}  // namespace

bool is_script_value(std::string_view name) { return find_value(name) != nullptr; }

std::string script_value_names() {
    std::string text;
    for (const std::span<const ScriptValue> values : {std::span<const ScriptValue>(kValues), overlay_values()})
        for (const ScriptValue& value : values) text += (text.empty() ? "" : ", ") + std::string(value.name);
    return text;
}

std::string script_value(const ViewerModel& model, std::string_view name) {
    const ScriptValue* const value = find_value(name);
    return value != nullptr ? value->read(model) : "";
}

}  // namespace pl::ui
