#include <fmt/format.h>

#include "core/fields/field_choices.h"
#include "core/scene/needed_effects.h"
#include "ui/draw/value_text.h"
#include "ui/draw/widgets.h"
#include "ui/panels/panels.h"

namespace pl::ui {
namespace {

std::string count_text(std::uint64_t count) { return short_number(static_cast<double>(count)); }

std::string share_text(std::uint64_t part, std::uint64_t whole) {
    return whole > 0 ? fmt::format("{:.2f} %", 100.0 * static_cast<double>(part) / static_cast<double>(whole)) : "-";
}

void clock_row(const char* name, double seconds, double total, const char* tip) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(name);
    tooltip(tip);
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(short_seconds(seconds).c_str());
    ImGui::TableNextColumn();
    const float share = total > 0.0 ? static_cast<float>(seconds / total) : 0.0f;
    ImGui::ProgressBar(share, {-1.0f, em(1.1f)}, fmt::format("{:.0f} %", 100.0f * share).c_str());
}

void draw_clocks(const Clocks& clocks) {
    if (!section("Time", true)) return;
    if (!ImGui::BeginTable("clocks", 3, ImGuiTableFlags_SizingStretchProp)) return;
    ImGui::TableSetupColumn("clock", ImGuiTableColumnFlags_WidthFixed);
    ImGui::TableSetupColumn("seconds", ImGuiTableColumnFlags_WidthFixed);
    ImGui::TableSetupColumn("share", ImGuiTableColumnFlags_WidthStretch);
    const double total = clocks.total();
    clock_row("Load", clocks.load, total, "Reading and checking the scene's files.");
    clock_row("Build", clocks.build, total, "Packing the scene and building its hierarchy.");
    clock_row("Upload", clocks.upload, total, "Sending the scene to the back end.");
    clock_row("Place volumes", clocks.place, total, "Placing radiance volumes and building their tree.");
    clock_row("Precompute", clocks.precompute, total, "Probes that fill the precomputed radiance map.");
    clock_row("Learn", clocks.learn, total, "Updates of the field from the training samples of the passes.");
    clock_row("Render", clocks.render, total, "Passes of this picture, including their training samples.");
    ImGui::EndTable();
}

void draw_paths(const ViewerModel& model, const Snapshot& snapshot) {
    if (!section("Paths of this picture", true)) return;
    const PassCounters& c = snapshot.counters;
    const double per_path = c.paths > 0 ? 1.0 / static_cast<double>(c.paths) : 0.0;
    text_row("Speed", fmt::format("{:.3f} Mpaths/s", model.link().throughput().mpaths_per_second()));
    text_row("Paths", count_text(c.paths), "Camera paths.");
    text_row("Segments", count_text(c.path.segments), "Path rays, without shadow rays.");
    text_row("Mean length", fmt::format("{:.3f}", static_cast<double>(c.path.segments) * per_path),
             "Segments per path.");
    text_row("Shadow rays", count_text(c.path.shadow_rays));
    text_row("Emission rays", count_text(c.path.emission_rays),
             "Further camera rays, for the emission of lights whose border crosses a pixel.");
    text_row("Dark paths", share_text(c.zero_contribution_paths, c.paths), "Paths that brought no light.");
    text_row("Escaped", count_text(c.path.escaped), "Paths that left the scene. 0 in a closed one.");
    text_row("Truncated", count_text(c.path.truncated), "Paths that ended at the largest depth.");
    if (c.path.method.cut_returns > 0)
        text_row("Cut returns", count_text(c.path.method.cut_returns),
                 "Paths too long for Monte-Carlo targets: the radiance of their rest is taken from the field.");
    text_row("Lost rays", count_text(c.path.zero_directions), "Sampled directions with a BSDF value of zero.");
    text_row("Invalid", count_text(c.invalid_samples),
             "Samples that were NaN, infinite or negative: dropped and counted.",
             c.invalid_samples > 0 ? colors::kWarning : colors::kText);
}

const char* network_hint(bool is_lost) {
    return is_lost ? "Its loss or weights were not finite: directions are guided by the cosine."
                   : "Gives every vertex the mixture of lobes that guides it.";
}

void draw_field(const std::optional<FieldStatus>& field) {
    if (!section("Learned field", true)) return;
    if (!field) {
        faint_text("This method has no field.");
        return;
    }
    text_row("Volumes", fmt::format("{} x {} directions", field->volumes, field->bins));
    if (field->added_volumes > 0)
        text_row("Added", fmt::format("{} volumes", field->added_volumes), "By refinement after 8 and 16 passes.");
    if (!has_tables(field->representation))
        text_row("Directions", std::string(label_of(field->representation)),
                 choice_tip<Representation>("How the field represents them.").c_str());
    if (field->network)
        text_row("Network",
                 field->network->is_lost
                     ? std::string("lost")
                     : fmt::format("{}B, {} steps", short_number(static_cast<double>(kNetworkBytes)),
                                   field->network->steps),
                 network_hint(field->network->is_lost), field->network->is_lost ? colors::kWarning : colors::kText);
    text_row("Memory", short_number(static_cast<double>(field->bytes)) + "B");
    text_row("Passes", fmt::format("{}", field->passes), "Passes whose training samples the field has learned from.");
    text_row("Samples", count_text(field->records), "Training samples.");
    text_row("Misses", count_text(field->lookup_misses), "Lookups of surface points without a volume.");
}

void draw_scene(const PublishedFrame& frame, const ViewerModel& model) {
    if (!section("Scene and kernel", true)) return;
    text_row("Scene", model.scene().name(), frame.description->source.string().c_str());
    text_row("Triangles", count_text(frame.description->triangles.size()), "Those that are stored.");
    if (!frame.description->instances.empty())
        text_row("Instances", count_text(frame.description->instances.size()),
                 "Each shows a mesh that is stored once.");
    text_row("Lights", count_text(frame.scene->lights.size()), "Triangles that emit.");
    text_row("Materials", count_text(frame.description->materials.size()));
    std::string effects;
    for (const std::string& name : effect_names(needed_effects(*frame.scene)))
        effects += (effects.empty() ? "" : ", ") + name;
    text_row("Effects", effects.empty() ? "none" : effects, "Effects that the scene needs beyond diffuse triangles.");
    text_row("Kernel", frame.snapshot.kernel, "The compiled kernel that serves them.");
    text_row("Rays", frame.backend.intersector);
}

}  // namespace

void draw_statistics_tab(const ViewerModel& model) {
    const PublishedFrame* frame = model.frame();
    if (frame == nullptr) {
        faint_text("Nothing is rendered yet.");
        return;
    }
    draw_clocks(frame->snapshot.clocks);
    draw_paths(model, frame->snapshot);
    draw_field(model.status().field);
    draw_scene(*frame, model);
}

}  // namespace pl::ui
