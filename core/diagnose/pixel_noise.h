// "Why this pixel?": the noise of a pixel by technique and bounce, and the gain of guidance there, by paths of both methods in turns.
#pragma once

#include "core/diagnose/noise_sums.h"
#include "core/diagnose/pixel_paths.h"

namespace pl::diagnose {

struct PixelNoise {
    std::uint32_t pixel = 0;  ///< row-major
    PixelEstimate plain;
    std::optional<PixelEstimate>
        guided{};  ///< every path guided, whether the picture is or not; empty without a field
    MethodId guided_method = MethodId::Reinforcement;  ///< of `guided`
    std::optional<Gain> gain{};                        ///< of guidance; see pixel_gain()
};

/// Traces paths of one pixel that belong to no pass of the picture, so that they are independent of it and of what the field has
/// learned. The field is that of the replay. The same paths give the same figures, but for their time.
class PixelNoiseTracer {
public:
    PixelNoiseTracer(PassPair passes, std::uint32_t pixel);
    PixelNoiseTracer(const PixelNoiseTracer&) = delete;
    PixelNoiseTracer& operator=(const PixelNoiseTracer&) = delete;

    /// A step: as many paths by each method into one group. They are traced twice: by the kernel's own loop for their time, without
    /// training the field, and again with a record of their vertices. Returns false if `stop` was raised before.
    static constexpr std::uint32_t kPathsPerStep = 8;
    bool advance(const StopFlag* stop = nullptr);

    std::uint32_t paths() const { return steps_ * kPathsPerStep; }
    /// Before every group has paths there is no noise().
    bool has_all_groups() const { return plain_.has_all_groups(); }
    PixelNoise noise() const;

private:
    void trace(const PassReplay& passes, const AnyFieldView& field, NoiseSums& sums) const;

    PassPair passes_;
    AnyFieldView field_;  ///< of passes_.guided
    std::uint32_t pixel_;
    std::uint32_t steps_ = 0;
    NoiseSums plain_;
    NoiseSums guided_;
};

}  // namespace pl::diagnose
