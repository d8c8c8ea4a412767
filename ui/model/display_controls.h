// How the picture is displayed: exposure, tone curve, tint by radiance volume, resolution in motion. Nothing here
// restarts a picture.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "core/kernel/base/math.h"
#include "core/plot/value_scale.h"
#include "ui/model/render_link.h"
#include "ui/worker/render_worker.h"

namespace pl::ui {

class DisplayControls {
public:
    static constexpr float kMaxExposureEv = 16.0f;
    static constexpr float kStandardOpacity = 0.4f;

    DisplayControls(const DisplaySettings& settings, RenderWorker& worker) : settings_(settings), worker_(worker) {}

    const DisplaySettings& settings() const { return settings_; }
    void set_exposure(float ev);  ///< in stops
    void set_curve(ToneCurve curve);

    /// The tint that shows which radiance volume serves a pixel.
    bool cells() const { return cells_; }
    void set_cells(bool on);
    float cells_opacity() const { return cells_opacity_; }
    void set_cells_opacity(float opacity);
    /// Whether the selected volume's outline is drawn, which needs the image of the volumes' cells like the tint.
    void set_outline(bool on);

    /// Colors of heat maps. One pixel in a hundred may be an outlier.
    RangeRule& heat_rule() { return heat_rule_; }
    /// Of a frame that shows_heat(); found once for each frame and rule.
    const ValueRange& heat_range(const PublishedFrame& frame) const;

    /// Coarser pictures while the camera moves.
    bool low_resolution() const { return low_resolution_; }
    void set_low_resolution(bool allowed);
    /// Then also a preview in place of a picture without light samples; see MotionPreview.
    bool preview() const { return preview_; }
    void set_preview(bool allowed);
    /// Frames of few samples are shown denoised, see DenoisedPreview.
    bool denoises() const { return denoises_; }
    void set_denoises(bool on) { denoises_ = on; }

private:
    DisplaySettings settings_;
    RenderWorker& worker_;
    bool cells_ = false;
    bool outline_ = false;
    float cells_opacity_ = kStandardOpacity;
    RangeRule heat_rule_{.scale = ColorScale::Linear, .high_percent = 99.0f};
    mutable ValueRange heat_range_{};
    mutable RangeRule ranged_by_{};           ///< the rule of heat_range_
    mutable std::uint64_t ranged_frame_ = 0;  ///< serial of its frame
    bool low_resolution_ = true;
    bool preview_ = true;
    bool denoises_ = true;
};

// The distribution of a picture's luminance, on a logarithmic scale.

/// Counts of pixels by the binary logarithm of their luminance.
struct LuminanceHistogram {
    static constexpr float kLow = -14.0f;  ///< binary logarithm of the luminance at the lower end of bin 0
    static constexpr float kHigh = 14.0f;  ///< at the upper end of the last bin
    static constexpr int kBins = 112;      ///< a quarter of a stop each

    std::array<std::uint32_t, kBins> counts{};
    std::uint32_t pixels = 0;   ///< looked at
    std::uint32_t dark = 0;     ///< of these, black or below the lowest bin
    std::uint32_t bright = 0;   ///< above the highest bin
    std::uint32_t invalid = 0;  ///< NaN or infinite

    /// Of pixels with a place in the counts.
    std::uint32_t counted() const { return pixels - dark - bright - invalid; }
    /// Binary logarithm of the luminance below which a share of the counted pixels lies, by linear interpolation inside its bin.
    /// Empty if none is counted.
    std::optional<float> percentile(float share) const;
    /// Mean of the logarithm over the counted pixels between two percentiles; empty if none is counted.
    std::optional<float> mean(float low_share, float high_share) const;
};

/// Looks at no more than `most` pixels, evenly spread.
LuminanceHistogram make_histogram(std::span<const Vec3f> pixels, std::size_t most = 1u << 16);

/// The exposure in stops at which the mean logarithm of the luminance, without the darkest and the brightest twentieth of the
/// pixels, equals the logarithm of a gray of 0.18. Empty for a black picture.
/// [Reinhard et al. 2002, "Photographic Tone Reproduction for Digital Images", eq. 1, 2]
std::optional<float> automatic_exposure(const LuminanceHistogram& histogram);

/// The histogram of the picture in the window, and an exposure that follows it. Both look at values that were copied from the film.
class AutoExposure {
public:
    /// The exposure stays while it is nearer to the wanted one, in stops: the noise of a picture must not make it flicker.
    static constexpr float kRest = 0.1f;

    AutoExposure(RenderLink& link, DisplayControls& display) : link_(link), display_(display) {}

    bool is_on() const { return is_on_; }
    void set_on(bool on);
    /// Once per frame of the window. With every new frame of the picture the exposure goes half of the way to
    /// automatic_exposure(), and all of it from half a stop on. An exposure that anything else has set switches it off.
    void update();

    /// Of the newest frame; null without values, which only frames have that were asked for them. Made once per frame, and only
    /// when it is called for.
    const LuminanceHistogram* histogram();
    /// Number of times that a histogram was made.
    std::uint64_t times_made() const { return times_made_; }
    /// Frames must carry the values of the film.
    bool needs_values() const { return is_on_; }

private:
    RenderLink& link_;
    DisplayControls& display_;
    bool is_on_ = false;
    float set_to_ = 0.0f;         ///< the exposure that it set last
    std::uint64_t followed_ = 0;  ///< serial of the frame that it followed last
    std::uint64_t made_of_ = 0;   ///< serial of the frame of histogram_
    LuminanceHistogram histogram_{};
    std::uint64_t times_made_ = 0;
};

}  // namespace pl::ui
