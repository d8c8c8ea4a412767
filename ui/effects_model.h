// The effects of what is rendered, as the panel shows them: needed or not, why, forced or not, and what they cost.
#pragma once

#include <string>
#include <vector>

#include "ui/worker/published_frame.h"

namespace pl {

struct EffectRow {
    Feature feature;
    std::string name;
    std::string reason;  ///< why it is needed; empty if it is not
    std::string kernel;  ///< that would serve what is needed, and this

    bool needed() const { return !reason.empty(); }
    FeatureSet with() const { return FeatureSet{}.with(feature); }
};

class EffectsModel {
public:
    /// Costs that were measured elsewhere, or of what another kernel served, are forgotten.
    void update(const PublishedFrame& frame, const std::optional<EffectCost>& measured);

    const std::vector<EffectRow>& rows() const { return rows_; }
    /// That serves what is needed, with nothing forced.
    const std::string& kernel() const { return kernel_; }
    std::string kernel_with(FeatureSet forced) const;
    /// What forcing these costs, measured for any effects that the same kernel serves; null if that is not known.
    const EffectCost* cost_of(FeatureSet forced) const;

private:
    /// What a cost was measured on.
    struct Place {
        std::shared_ptr<const HostScene> scene;
        FeatureSet needed;
        FilmSlot slot;
        LearningSettings learning{};
        std::string backend;
        int width = 0;
        int height = 0;

        friend bool operator==(const Place&, const Place&) = default;
    };

    Place place_;
    std::vector<EffectRow> rows_;
    std::string kernel_;
    std::vector<EffectCost> costs_;
};

}  // namespace pl
