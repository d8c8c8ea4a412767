#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/fields/field_choices.h"
#include "core/fields/field_kernels.h"
#include "ui/draw/value_text.h"
#include "ui/draw/widgets.h"
#include "ui/draw/words.h"
#include "ui/panels/panels.h"

namespace pl::ui {
namespace {

/// Refinement of the placement. Every change restarts pictures and fields.
void draw_refinement(ViewerModel& model, FieldSettings settings) {
    bool is_auto = settings.refine_share == kRefineByRecords;
    if (toggle_row(
            "Refine",
            "A method that learns splits volumes with many lookups whose neighbors disagree: up to twice as many, "
            "given enough training samples, unless the number of volumes is set.",
            &is_auto)) {
        settings.refine_share = is_auto ? kRefineByRecords : 0.0f;
        model.render().set_field(settings);
    }
    if (!is_auto && slider_row("Added share", "Volumes that refinement may add, as a share of the placed ones.",
                               &settings.refine_share, {0.0f, 1.0f, 0.0f, "%.2f"}))
        model.render().set_field(settings);
}

/// The targets of training samples and the learning rate. Every change restarts pictures and fields.
void draw_learning_targets(ViewerModel& model, FieldSettings settings) {
    bool changed = choice_row("Learning rate", "Step of an update.", &settings.rate);
    changed |=
        choice_row("Learns from", "The target of a training sample. Only tables learn from others than the first.",
                   &settings.learning.target);
    changed |= choice_row("Light", "With light samples, what a method learns.", &settings.learning.light);
    if (changed) model.render().set_field(settings);
}

/// Number of passes and training samples of the method on show.
void draw_learned_amount(const ViewerModel& model) {
    const std::optional<FieldStatus>& field = model.status().field;
    if (field) {
        text_row("Learned",
                 fmt::format("{}, {} samples", passes_text(field->passes),
                             short_number(static_cast<double>(field->records))),
                 "Passes and training samples of the field. Camera moves keep it.");
    } else {
        const MethodInfo& method = info_of(model.render().method());
        faint_text(method.uses_field ? "nothing yet" : fmt::format("{} has no field.", method.label).c_str());
    }
}

/// The field and the mixture with the BSDF. Changes of the field restart pictures and fields.
void draw_field(ViewerModel& model) {
    MixtureSettings mixture = model.render().settings().mixture;
    bool learned = mixture.learned != 0;
    if (toggle_row("Learned share", "A method that learns also learns the BSDF fraction of each volume.", &learned)) {
        mixture.learned = learned ? 1 : 0;
        model.render().set_mixture(mixture);
    }
    if (slider_row(
            "BSDF share",
            "BSDF fraction of the mixture: the share of directions sampled from the BSDF instead of the field, for "
            "volumes that have not learned it.",
            &mixture.bsdf_fraction, {kMinBsdfFraction, 1.0f, MixtureSettings{}.bsdf_fraction, "%.2f"}))
        model.render().set_mixture(mixture);
    FieldSettings settings = model.render().settings().field;
    if (choice_row("Field", "How a method that learns represents directions; precomputed maps are tables.",
                   &settings.representation)) {
        if (!has_target(settings.representation, settings.learning.target))
            settings.learning.target = LearningTarget::ExpectedSarsa;
        model.render().set_field(settings);
    }
    int volumes = settings.volumes;
    if (int_row("Volumes",
                "Number of radiance volumes; 0: as many as the memory holds, at most 1000. More volumes learn more "
                "slowly.",
                &volumes, 100, "automatic")) {
        settings.volumes = std::clamp(volumes, 0, 1000000);
        model.render().set_field(settings);
    }
    draw_refinement(model, settings);
    constexpr int kLeastSide = 2, kMostSide = 32;
    std::vector<std::string> squares;
    for (int side = kLeastSide; side <= kMostSide; ++side) squares.push_back(std::to_string(side * side));
    int step = static_cast<int>(std::lround(std::sqrt(settings.bins))) - kLeastSide;
    if (choice_row("Directions", "Cells of the hemisphere of a volume.", &step, squares)) {
        settings.bins = (kLeastSide + step) * (kLeastSide + step);
        model.render().set_field(settings);
    }
    draw_learning_targets(model, settings);
}

}  // namespace

void draw_learning_section(ViewerModel& model) {
    if (!section("Learning", true)) return;
    draw_learned_amount(model);
    if (is_research(model)) draw_field(model);
    if (wide_button("Forget the learned field", "Ctrl+Shift+R: clears pictures and fields.")) model.render().forget();
}

}  // namespace pl::ui
