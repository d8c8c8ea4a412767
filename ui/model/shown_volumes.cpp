#include "ui/model/shown_volumes.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace pl::ui {
namespace {

std::vector<float> normalized(std::vector<float> values) {
    float total = 0.0f;
    for (const float value : values) total += value;
    if (total > 0.0f)
        for (float& value : values) value /= total;
    return values;
}

/// As the newest frame has it; null if it has none, or none with cells.
std::shared_ptr<const VolumeInspection> present(const PublishedFrame& frame, std::int32_t volume) {
    const auto fits = [&](const auto& read) { return read && read->volume == volume && read->side > 0; };
    if (fits(frame.volume)) return frame.volume;
    const auto pin = std::ranges::find_if(frame.pins, fits);
    return pin != frame.pins.end() ? *pin : nullptr;
}

/// The true light in the quantity of the learned disc, without values as long as it is not known: the discs beside it would jump
/// away from under the pointer. Nothing where a quantity has no truth.
std::optional<ShownDisc> true_disc(const LightReport* report, CellQuantity quantity) {
    if (quantity == CellQuantity::Visits) return std::nullopt;
    const bool is_product = quantity == CellQuantity::Density;
    ShownDisc disc{is_product ? "light x BSDF" : "true", {}};
    if (report == nullptr) return disc;
    if (is_product)
        disc.values = relative_to_cosine(report->product_shares);
    else
        disc.values = quantity == CellQuantity::Radiance ? report->light.target : normalized(report->light.target);
    return disc;
}

/// The learned disc beside the true one.
ShownDisc learned_disc(const VolumeInspection& volume, const LightReport* report, CellQuantity quantity) {
    if (report == nullptr || quantity == CellQuantity::Visits) return {"learned", cell_values(volume, quantity)};
    if (quantity == CellQuantity::Density) return {"guided paths", relative_to_cosine(report->mixture_shares)};
    return {quantity == CellQuantity::Radiance ? "learned" : "table", cell_values(volume, quantity)};
}

}  // namespace

std::vector<ShownVolume> shown_volumes(ViewerModel& model) {
    std::vector<ShownVolume> shown;
    if (model.frame() == nullptr) return shown;
    const Selection& selection = model.selection();
    const auto& places = selection.pins().places();
    const auto add = [&](std::int32_t volume, std::uint32_t color) {
        if (volume == kNoVolume) return;
        auto read = model.time().inspection(volume);
        if (read == nullptr) read = present(*model.frame(), volume);
        if (read != nullptr) shown.push_back({std::move(read), color, volume == selection.volume()});
    };
    if (!selection.pins().contains(selection.volume())) add(selection.volume(), 0xffffffffu);
    for (std::size_t i = 0; i < places.size(); ++i) add(places[i], PinnedVolumes::kColors[i]);
    return shown;
}

std::vector<ShownDisc> shown_discs(const ViewerModel& model, const VolumeInspection& selected) {
    const CellDisplay& display = model.window().cell_display;
    const LightReport* report = display.truth ? model.selection().light().report() : nullptr;
    if (report != nullptr && report->mixture_shares.size() != selected.radiance.size()) report = nullptr;
    std::vector<ShownDisc> discs;
    if (const FieldKeyFrame* frame = model.time().frame()) {
        discs.push_back({fmt::format("pass {}", frame->passes()), cell_values(selected, display.quantity)});
        if (const VolumeInspection* now = model.selection().inspection();
            now != nullptr && now->side == selected.side)
            discs.push_back({"now", cell_values(*now, display.quantity)});
    } else {
        discs.push_back(learned_disc(selected, report, display.quantity));
    }
    if (!display.truth) return discs;
    if (auto disc = true_disc(report, display.quantity)) discs.push_back(*std::move(disc));
    return discs;
}

ValueRange shown_range(const ViewerModel& model, const std::vector<ShownVolume>& volumes) {
    const CellDisplay& display = model.window().cell_display;
    std::vector<float> all;
    const auto add = [&](const std::vector<float>& values) { all.insert(all.end(), values.begin(), values.end()); };
    for (const ShownVolume& shown : volumes) {
        if (shown.is_selected)
            for (const ShownDisc& disc : shown_discs(model, *shown.volume)) add(disc.values);
        else
            add(cell_values(*shown.volume, display.quantity));
    }
    return range_of(all, display.range);
}

ShareDifference difference(const std::vector<float>& now, const std::vector<float>& then) {
    ShareDifference result;
    for (std::size_t cell = 0; cell < std::min(now.size(), then.size()); ++cell) {
        const double p = now[cell];
        const double q = then[cell];
        if (p > 0.0) result.divergence += p * std::log(p / q);
        result.total_variation += 0.5 * std::fabs(p - q);
    }
    return result;
}

}  // namespace pl::ui
