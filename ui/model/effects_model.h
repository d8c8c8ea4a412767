// The effects of the rendered scene as the panel shows them: whether and why each is needed, and its measured cost.
#pragma once

#include <string>
#include <vector>

#include "ui/worker/published_frame.h"

namespace pl {

struct EffectRow {
    Feature feature;
    std::string name;
    std::string reason;  ///< why it is needed; empty if it is not
    std::string kernel;  ///< that serves the needed effects and this one

    bool needed() const { return !reason.empty(); }
    FeatureSet with() const { return FeatureSet{}.with(feature); }
};

class EffectsModel {
public:
    /// Drops costs that were measured on another picture, back end or kernel.
    void update(const PublishedFrame& frame, const std::optional<EffectTrialCost>& measured);

    const std::vector<EffectRow>& rows() const { return rows_; }
    /// The kernel that serves the needed effects, with none forced.
    const std::string& kernel() const { return kernel_; }
    std::string kernel_with(FeatureSet forced) const;
    /// The cost of forcing these effects, measured for any effects that the same kernel serves; null if unknown.
    const EffectTrialCost* cost_of(FeatureSet forced) const;

private:
    /// The picture, back end and kernel of a measured cost.
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
    std::vector<EffectTrialCost> costs_;
};

}  // namespace pl
