// The light that reaches the selected volume, traced in the background while a panel shows it: paths on a thread of low priority,
// on a clock of their own.
#pragma once

#include <memory>
#include <optional>

#include "core/inspect/guiding_figures.h"
#include "ui/model/jobs.h"
#include "ui/worker/field_history.h"
#include "ui/worker/published_frame.h"

namespace pl::ui {

/// Figures of a field that so many passes had trained.
struct FigurePoint {
    std::uint64_t passes = 0;
    GuidingFigures figures;
};

/// Of the key frames that have the volume, compared with its light.
std::vector<FigurePoint> past_figures(const IncidentLight& light, const FieldHistory& history, std::int32_t volume,
                                      TargetLight target);

class LightTracing {
public:
    /// A panel shows the light during this frame of the window.
    void show() { is_shown_ = true; }
    /// Once per frame of the window: begins, continues or ends the work. `volume` null: nothing is selected. Work rests while no
    /// panel shows it, and starts over for another volume, scene, BSDF or seed.
    void update(const std::shared_ptr<const PublishedFrame>& frame, const VolumeInspection* volume,
                const std::shared_ptr<const FieldHistory>& history = nullptr);

    /// The light so far, compared with the densities of a moment ago; null before every group has paths, and without a volume.
    const LightReport* report() const { return report_.get(); }
    /// The figures over the passes that trained the field: of its key frames, all by the light so far, and of the newest report. Without
    /// key frames, the figures of past reports.
    const std::vector<FigurePoint>& curve() const { return curve_; }
    /// Spent on paths and figures so far.
    double seconds() const { return seconds_; }
    bool is_working() const { return job_ != nullptr; }
    /// Empty if nothing failed.
    const std::string& failure() const { return failure_; }

    /// Paths of one volume after which the light is not refined any more: that many directions of a lamp fit into memory.
    static constexpr std::uint64_t kMostPaths = 1u << 19;

private:
    /// All that decides the light of a volume.
    struct Subject {
        std::shared_ptr<const HostScene> scene;
        std::int32_t volume = kNoVolume;
        int side = 0;
        Vec3f position{0.0f};
        Vec3f wo{0.0f};
        std::uint64_t seed = 0;
        std::uint32_t max_depth = 0;

        friend bool operator==(const Subject&, const Subject&) = default;
    };
    struct Slice {
        std::shared_ptr<const LightReport> report{};
        std::uint64_t passes = 0;         ///< of the field in the report
        std::vector<FigurePoint> past{};  ///< of key frames
        double seconds = 0.0;
    };

    static Subject subject_of(const PublishedFrame& frame, const LightReceiver& receiver);
    void take_slice();
    void start_over(const PublishedFrame& frame, const LightReceiver& receiver);
    void begin_slice(const PublishedFrame& frame, const std::shared_ptr<const FieldHistory>& history);
    void extend_curve(const Slice& slice);
    bool is_complete() const;

    Subject subject_;
    std::shared_ptr<LightGatherer> gatherer_;  ///< only of the job while there is one
    std::shared_ptr<const VolumeInspection> compared_;
    std::shared_ptr<const LightReport> report_;
    std::vector<FigurePoint> curve_;
    std::shared_ptr<const FieldHistory> past_;  ///< key frames whose figures are known
    double seconds_ = 0.0;
    bool is_shown_ = false;
    std::string failure_;
    std::unique_ptr<BackgroundJob<Slice>> job_;
};

}  // namespace pl::ui
