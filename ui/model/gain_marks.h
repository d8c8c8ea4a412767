// Where in the picture its method gains or loses against default: measured from the pictures of both so far, again and again while marks
// are shown.
#pragma once

#include <array>
#include <memory>
#include <string>

#include "core/measure/gain.h"
#include "ui/model/jobs.h"
#include "ui/model/render_link.h"

namespace pl::ui {

class GainMarks {
public:
    explicit GainMarks(RenderLink& link) : link_(link) {}

    /// Hidden, nothing is measured or kept.
    bool is_shown() const { return is_shown_; }
    void set_shown(bool shown);
    /// Once per frame of the window, with its clock. Measures at most once a second and a twentieth of the time, and only new pictures.
    void update(double seconds);

    /// Of the picture that is shown; null without marks.
    const TileGains* gains() const;
    /// Whether the picture has many samples more than those that the gains were measured from.
    bool is_old() const;
    /// Compared with default.
    MethodId method() const { return result_->method; }
    /// For the lack of gains; empty until there is one.
    const std::string& reason() const { return reason_; }

private:
    struct Result {
        TileGains gains;
        MethodId method = MethodId::Reinforcement;
        std::array<std::uint32_t, 2> passes{};  ///< of default and of the method
        double seconds = 0.0;                   ///< that the comparison took
    };
    using Comparison = BackgroundJob<std::shared_ptr<const Result>>;

    void take_answer();
    void take_result(double seconds);
    void drop();

    RenderLink& link_;
    bool is_shown_ = false;
    bool is_asked_ = false;
    double next_seconds_ = 0.0;       ///< not asked again before
    std::uint64_t asked_serial_ = 0;  ///< newest frame when it was asked
    std::uint64_t picture_ = 0;       ///< WorkerStatus::picture of the pictures compared
    std::string reason_;
    std::shared_ptr<const Result> result_;
    std::unique_ptr<Comparison> job_;
};

}  // namespace pl::ui
