// Rendering until a picture is good enough: its error against a reference, or without one its own noise.
#pragma once

#include <memory>
#include <optional>

#include "app/measure/reference_store.h"
#include "core/measure/measure_budget.h"
#include "core/session/session.h"

namespace pl {

/// Looks at a picture now and then, while that takes no more than its share of the time that is charged.
class ErrorTarget {
public:
    /// `target` is a relMSE. A null reference: of the noise that the picture's two halves tell (Noise::relmse).
    ErrorTarget(double target, std::shared_ptr<const Reference> reference)
        : target_(target), reference_(std::move(reference)) {}

    /// After each sample per pixel: whether the target is met as far as was looked at. Noise is not trusted below
    /// kFewestSamples: a picture that has not found its light yet is black without any noise.
    bool is_met(const Session& session, FilmSlot slot);
    /// Looks once more, whatever it takes: at the end of a rendering.
    void look_at_last(const Session& session, FilmSlot slot);
    /// When it was last looked at.
    bool is_low_enough() const { return measured_ && *measured_ <= target_; }

    double target() const { return target_; }
    /// When it was last looked at; empty if that told nothing: no two halves, or no pixel that is finite.
    std::optional<double> measured() const { return measured_; }
    bool has_reference() const { return reference_ != nullptr; }
    /// "noise" or "error".
    const char* word() const { return has_reference() ? "error" : "noise"; }
    /// How much of the time to the target is over, if errors fall as one over the samples.
    double share_done() const;

    static constexpr std::uint32_t kFewestSamples = 16;

private:
    void measure(const Session& session, FilmSlot slot);

    double target_;
    std::shared_ptr<const Reference> reference_;
    MeasureBudget budget_;
    std::optional<double> measured_;
    std::uint32_t measured_passes_ = 0;
    std::uint32_t next_passes_ = 2;
};

}  // namespace pl
