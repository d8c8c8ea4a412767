// The tab that shows a material and changes it.
#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "core/scene/surface_info.h"
#include "ui/draw/widgets.h"
#include "ui/panels/panels.h"

namespace pl::ui {
namespace {

/// Most of a value without bounds that a slider reaches, unless the file has more.
constexpr float kMostOfSlider = 1000.0f;

void draw_list(ViewerModel& model, std::uint32_t selected) {
    const EditedMaterials& materials = model.scene().materials();
    const auto label = [&](std::uint32_t index) {
        return fmt::format("{}{}##{}", shown_name(materials.now()[index], index),
                           materials.is_edited(index) ? " *" : "", index);
    };
    const std::string shown = label(selected);
    if (!begin_choice_row("Material", "Materials of the scene; * is edited. A click in the picture selects one too.",
                          shown.substr(0, shown.rfind("##")).c_str()))
        return;
    for (std::uint32_t i = 0; i < materials.now().size(); ++i)
        if (ImGui::Selectable(label(i).c_str(), i == selected)) model.scene().select_material(i);
    ImGui::EndCombo();
}

/// Reflectance or transmittance: each channel in [0, 1].
bool share_row(const char* label, const char* tip, glm::vec3& color) {
    return color_row(label, fmt::format("{} Linear red, green and blue, from 0 to 1.", tip).c_str(), &color.x);
}

float largest(const glm::vec3& value) { return std::max({value.x, value.y, value.z}); }

/// Rows of a value of at least 0 in each channel: its largest channel, and a color beside it unless it is 0.
struct ScaledColorRows {
    const char* label;
    const char* tip;
    const char* color_label;
    const char* color_tip;
};

bool scaled_color_rows(const ScaledColorRows& rows, glm::vec3& value, const glm::vec3& file) {
    float scale = largest(value);
    glm::vec3 color = scale > 0.0f ? value / scale : glm::vec3{1.0f};
    bool changed = slider_row(
        rows.label, rows.tip, &scale,
        {0.0f, std::max(kMostOfSlider, 2.0f * largest(file)), largest(file), "%.4g", ImGuiSliderFlags_Logarithmic});
    if (scale > 0.0f) changed |= share_row(rows.color_label, rows.color_tip, color);
    if (changed) value = scale * color;
    return changed;
}

bool draw_parameter(const SurfaceParameter& row, MaterialDescription& m, const MaterialDescription& file) {
    const MaterialParameter& parameter = *row.parameter;
    if (row.matters != nullptr && !row.matters(m)) return false;
    if (parameter.number != nullptr)
        return slider_row(row.label, row.tip, &(m.*parameter.number),
                          {parameter.slider_least, parameter.slider_most, file.*parameter.number, parameter.format});
    if (row.color_label == nullptr) return share_row(row.label, row.tip, m.*parameter.color);
    return scaled_color_rows({row.label, row.tip, row.color_label, row.color_tip}, m.*parameter.color,
                             file.*parameter.color);
}

bool draw_emission(MaterialDescription& m, const MaterialDescription& file) {
    bool changed =
        scaled_color_rows({"Emission", "Emitted radiance of the front, in the largest channel. 0: no light.",
                           "Lamp color", "Color of the emitted radiance."},
                          m.emission, file.emission);
    if (largest(m.emission) > 0.0f)
        changed |= toggle_row("Both sides emit", "Otherwise only the front.", &m.two_sided_emission);
    return changed;
}

/// A number that the user has moved is shown as the share that it is.
bool draw_opacity(MaterialDescription& m, const MaterialDescription& file) {
    const bool changed =
        slider_row("Opacity", "Share of the light that meets the surface; the rest goes straight on.", &m.opacity,
                   {0.0f, 1.0f, file.opacity, "%.3f"});
    if (changed) m.opacity_rule = m.opacity < 1.0f ? OpacityRule::Blend : file.opacity_rule;
    return changed;
}

void draw_textures(const TextureUse& use, const SceneDescription& scene) {
    const auto row = [&](const char* label, std::uint32_t texture) {
        if (texture == kNoTexture) return;
        text_row(label, scene.textures[texture].source.filename().string(),
                 "A texture: multiplies the value above, or bends the normals.");
    };
    row("Color map", use.albedo);
    row("Rough map", use.roughness);
    row("Light map", use.emission);
    row("Opacity map", use.opacity);
    row("Normal map", use.normal);
    row("Blend map", use.blend);
}

void draw_restore(ViewerModel& model, std::uint32_t index) {
    ImGui::BeginDisabled(!model.scene().materials().is_edited(index));
    if (wide_button("As in the file", "Undoes the edits of this material.")) model.scene().restore_material(index);
    ImGui::EndDisabled();
    const std::size_t edited = model.scene().materials().edited_names().size();
    if (edited < 2 && (edited == 0 || model.scene().materials().is_edited(index))) return;
    if (wide_button("All as in the file", "Undoes the edits of every material.")) model.scene().restore_materials();
}

}  // namespace

void draw_material_tab(ViewerModel& model) {
    const std::uint32_t index = model.scene().selected_material().value_or(0);
    draw_list(model, index);
    const MaterialDescription& file = model.scene().materials().in_file(index);
    MaterialDescription material = model.scene().materials().now()[index];
    bool changed = choice_row("Kind", "The BSDF of the surface.", &material.kind);
    for (const SurfaceParameter& row : surface_info(material.kind).parameters)
        changed |= draw_parameter(row, material, file);
    changed |= draw_emission(material, file);
    changed |= draw_opacity(material, file);
    if (material.blend.is_any())
        changed |= slider_row("Blend", "Share of the material that this one blends with.", &material.blend.share,
                              {0.0f, 1.0f, file.blend.share, "%.3f"});
    draw_textures(material.textures, *model.scene().materials().file());
    if (changed) model.scene().set_material(index, material);
    draw_restore(model, index);
}

// The tab of effects: which the scene needs and why, and the kernel that serves them.

namespace {

/// With spaces for line breaks between effects.
std::string spaced(const std::string& kernel) {
    std::string text;
    for (const char letter : kernel) text += letter == '+' ? std::string(" + ") : std::string(1, letter);
    return text;
}

}  // namespace

void draw_effects_tab(const ViewerModel& model) {
    const EffectsModel& effects = model.effects();
    if (effects.rows().empty()) {
        faint_text("Nothing is rendered yet.");
        return;
    }
    text_row("Kernel", spaced(effects.kernel()), "The smallest compiled kernel that serves the needed effects.");
    ImGui::Separator();
    for (const EffectRow& row : effects.rows())
        text_row(row.name.c_str(), row.needed() ? row.reason : "not needed", "",
                 row.needed() ? colors::kAccent : colors::kFaint);
}

}  // namespace pl::ui
