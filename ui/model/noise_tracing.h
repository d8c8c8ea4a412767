// The noise of the clicked pixel, traced in the background while a panel shows it: paths on a thread of low priority, on a clock of
// their own.
#pragma once

#include <memory>
#include <string>

#include "core/diagnose/pixel_noise.h"
#include "ui/model/background_job.h"

namespace pl::ui {

class NoiseTracing {
public:
    /// Paths by each method after which the noise is not refined any more.
    static constexpr std::uint32_t kMostPaths = 1u << 16;

    /// A panel shows the noise during this frame of the window.
    void show() { is_shown_ = true; }
    /// Once per frame of the window: begins, continues or ends the work. It rests while no panel shows it, and starts over for other
    /// passes or another pixel. `passes` null: no pixel is clicked. They are only read.
    void update(const std::shared_ptr<const diagnose::PassPair>& passes, std::uint32_t pixel);
    /// Ends the work and forgets its result.
    void drop();

    /// Null before every group has paths.
    const diagnose::PixelNoise* noise() const { return noise_.get(); }
    /// Spent on it so far.
    double seconds() const { return seconds_; }
    bool is_working() const { return job_ != nullptr; }
    /// Empty if nothing failed.
    const std::string& failure() const { return failure_; }

private:
    struct Slice {
        std::shared_ptr<diagnose::PixelNoiseTracer> tracer{};
        std::shared_ptr<const diagnose::PixelNoise> noise{};
        double seconds = 0.0;
    };

    void take_slice();
    void begin_slice();
    bool is_complete() const { return tracer_ != nullptr && tracer_->paths() >= kMostPaths; }

    std::shared_ptr<const diagnose::PassPair> passes_;
    std::uint32_t pixel_ = 0;
    std::shared_ptr<diagnose::PixelNoiseTracer>
        tracer_;  ///< only of the job while there is one; null before the first
    std::shared_ptr<const diagnose::PixelNoise> noise_;
    double seconds_ = 0.0;
    bool is_shown_ = false;
    std::string failure_;
    std::unique_ptr<BackgroundJob<Slice>> job_;
};

}  // namespace pl::ui
