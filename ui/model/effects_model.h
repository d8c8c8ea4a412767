// The effects of the rendered scene as the window shows them: whether and why each is needed, and the kernel that serves them.
#pragma once

#include <string>
#include <vector>

#include "core/scene/needed_effects.h"
#include "ui/worker/published_frame.h"

namespace pl::ui {

class EffectsModel {
public:
    void update(const PublishedFrame& frame);

    const std::vector<EffectRow>& rows() const { return rows_; }
    /// The kernel that serves the needed effects.
    const std::string& kernel() const { return kernel_; }

private:
    /// All that decides rows and kernels.
    struct Place {
        std::shared_ptr<const HostScene> scene;
        FeatureSet needed;
        FilmSlot slot;
        LearningSettings learning{};
        std::string backend;

        friend bool operator==(const Place&, const Place&) = default;
    };

    Place place_;
    std::vector<EffectRow> rows_;
    std::string kernel_;
};

}  // namespace pl::ui
