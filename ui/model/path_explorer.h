// The paths of a clicked pixel, with and without guidance, traced again in the background while they are shown: as lines in the
// picture, and one by one.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "core/diagnose/pixel_noise.h"
#include "ui/draw/path_lines.h"
#include "ui/model/jobs.h"
#include "ui/model/messages.h"
#include "ui/model/render_link.h"

namespace pl::ui {

/// The noise of the clicked pixel, traced in the background while a panel shows it: paths on a thread of low priority, on a clock of
/// their own.
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

/// The methods whose paths are drawn.
enum class PathSides { Plain, Guided, Both };

struct PathOptions {
    int count = 32;
    diagnose::PassChoice choice = diagnose::PassChoice::Brightest;
    PathSides sides = PathSides::Both;
    bool has_shadow_rays = false;
};

/// The light of all paths, for their colors; those without light are left out.
ValueRange light_range(const diagnose::PixelPaths& paths);

/// The paths of a pixel, as they are drawn.
struct DrawnPaths {
    ValueRange range;  ///< of the light that colors stand for
    PathSides sides = PathSides::Both;
    bool has_shadow_rays = false;
    bool lists_guided = false;              ///< `selected` is one of the guided paths
    std::optional<std::size_t> selected{};  ///< drawn last and wide, with its shadow rays
    float escape_length = 1.0f;             ///< of rays that leave the scene, in scene units
};
/// Darkest first. Those of the baseline are dashed where there are others.
std::vector<PathPiece> lines_of(const diagnose::PixelPaths& paths, const DrawnPaths& drawn);

class PathExplorer {
public:
    static constexpr int kMostPaths = 256;

    PathExplorer(RenderLink& link, Messages& messages) : link_(link), messages_(messages) {}

    /// Hidden, clicks trace nothing and nothing is kept.
    bool is_shown() const { return is_shown_; }
    void set_shown(bool shown);
    /// The pixel under a point of the image, in [0,1)^2 from the top left; its paths come later. Nothing while hidden.
    void pick(Vec2f image_point);
    /// Once per frame of the window: begins and ends work, drops paths with their scene.
    void update();

    PathOptions& options() { return options_; }
    const PathOptions& options() const { return options_; }
    /// Null without a clicked pixel, and until its first paths are traced.
    const diagnose::PixelPaths* paths() const { return paths_.get(); }
    /// Of paths(): pixel under the click, and the method of its guided paths.
    int x() const { return static_cast<int>(paths_->pixel) % passes_->plain.width; }
    int y() const { return static_cast<int>(paths_->pixel) / passes_->plain.width; }
    MethodId guided_method() const { return passes_->guided_method; }
    bool is_tracing() const { return click_.is_asked || job_ != nullptr; }
    /// The noise of the same pixel.
    NoiseTracing& noise() { return noise_; }
    const NoiseTracing& noise() const { return noise_; }

    /// The paths that the table lists and of which one is selected: by the method of the picture, or as drawn.
    bool lists_guided() const;
    const std::vector<diagnose::PathRecord>& listed() const {
        return lists_guided() ? paths_->guided : paths_->plain;
    }
    /// Index into listed(): the brightest one until another is selected.
    std::optional<std::size_t> selected() const;
    void select(std::size_t index) { selected_ = index; }

    /// The light that colors stand for, over all paths of both methods.
    const ValueRange& range() const { return range_; }
    /// The paths as lines, as seen by a camera in this place; made again only when something has changed.
    const std::vector<PathPiece>& pieces(const PublishedFrame& frame);
    /// Number of times that lines were made.
    std::uint64_t times_made() const { return lines_.times_made; }

private:
    using Traced = std::shared_ptr<const diagnose::PixelPaths>;

    /// All that decides the lines.
    struct LinesKey {
        Traced paths;
        std::shared_ptr<const HostScene> scene;
        Vec3f eye{0.0f};
        PathSides sides = PathSides::Both;
        bool has_shadow_rays = false;
        std::optional<std::size_t> selected;

        friend bool operator==(const LinesKey&, const LinesKey&) = default;
    };
    struct Lines {
        LinesKey key{};
        std::vector<PathPiece> pieces{};
        std::uint64_t times_made = 0;
    };
    struct Click {
        bool is_asked = false;  ///< its passes come later
        Vec2f point{0.0f};
    };

    void take_answer();
    void take_paths();
    void drop_with_scene();
    void drop();
    diagnose::PixelPathsRequest wanted() const;
    bool has_two_sides() const;

    RenderLink& link_;
    Messages& messages_;
    bool is_shown_ = false;
    Click click_;
    PathOptions options_;
    std::shared_ptr<diagnose::PassPair> passes_;  ///< only read; the job has a view of its field
    std::uint64_t generation_ = 0;                ///< of the picture of passes_
    diagnose::PixelPathsRequest begun_{.count = 0};
    Traced paths_;
    ValueRange range_;
    std::optional<std::size_t> selected_;
    Lines lines_;
    NoiseTracing noise_;
    std::unique_ptr<BackgroundJob<Traced>> job_;
};

}  // namespace pl::ui
