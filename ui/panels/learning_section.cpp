#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

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
    constexpr std::array kRates{LearningRate::SampleMean, LearningRate::Forgetful};
    int rate = static_cast<int>(std::ranges::find(kRates, settings.rate) - kRates.begin());
    int target = static_cast<int>(settings.learning.target);
    int light = static_cast<int>(settings.learning.light);
    bool changed =
        choice_row("Learning rate",
                   "Step of an update with n training samples so far. Mean: 1/(1+n). Forgetful: discounts early "
                   "training samples.",
                   &rate, "Mean\0Forgetful\0");
    changed |=
        choice_row("Learns from",
                   "The target of a training sample. Expected Sarsa: the expected reflected radiance at the next "
                   "vertex. Sarsa: the learned radiance of the next direction. Monte Carlo: the radiance of "
                   "the rest of the path. Only tables learn from the last two.",
                   &target, "Expected Sarsa\0Sarsa\0Monte Carlo\0");
    changed |= choice_row("Light",
                          "With light samples: learn all incident radiance, or only the part without light samples.",
                          &light, "All\0Indirect\0");
    if (!changed) return;
    settings.rate = kRates[static_cast<std::size_t>(rate)];
    settings.learning = {static_cast<LearningTarget>(target), static_cast<LearnedLight>(light)};
    model.render().set_field(settings);
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
    auto representation = static_cast<int>(index_of(settings.representation));
    if (choice_row(
            "Field",
            "How a method that learns represents directions. Table: cells of each volume. SD-tree: quadtrees at the "
            "leaves of a tree over space. Lobes: a mixture of smooth peaks in each volume. Neural: a network that "
            "gives each vertex a mixture of smooth peaks. SD-tree and lobes on the CPU alone; precomputed maps are "
            "tables.",
            &representation, "Table\0SD-tree\0Lobes\0Neural\0")) {
        settings.representation = kAllRepresentations[static_cast<std::size_t>(representation)];
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
    int side = static_cast<int>(std::lround(std::sqrt(settings.bins))) - 2;
    if (choice_row("Directions", "Cells of the hemisphere of a volume.", &side,
                   "4\0009\00016\00025\00036\00049\00064\00081\000100\000121\000144\000169\000196\000225\0002"
                   "56\000")) {
        settings.bins = (side + 2) * (side + 2);
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
