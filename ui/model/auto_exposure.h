// The histogram of the picture in the window, and an exposure that follows it. Both look at values that were copied from the film.
#pragma once

#include <memory>

#include "ui/model/display_controls.h"
#include "ui/model/luminance_histogram.h"
#include "ui/model/render_link.h"

namespace pl::ui {

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
