#include "ui/model/path_explorer.h"

#include <algorithm>

#include "core/base/timer.h"

namespace pl::ui {
namespace {

constexpr double kNoiseSliceSeconds = 0.25;

}  // namespace

void NoiseTracing::drop() {
    job_.reset();
    passes_.reset();
    tracer_.reset();
    noise_.reset();
    seconds_ = 0.0;
    failure_.clear();
}

void NoiseTracing::take_slice() {
    if (!job_) return;
    auto result = job_->take_result();
    if (!result) return;
    job_.reset();
    failure_ = result->failure;
    tracer_ = result->value.tracer;
    seconds_ += result->value.seconds;
    if (result->value.noise) noise_ = result->value.noise;
}

void NoiseTracing::begin_slice() {
    job_ = std::make_unique<BackgroundJob<Slice>>(
        [tracer = tracer_, passes = passes_, pixel = pixel_](const JobMonitor& monitor) {
            const Stopwatch watch;
            Slice slice{.tracer = tracer ? tracer : std::make_shared<diagnose::PixelNoiseTracer>(*passes, pixel)};
            while (slice.tracer->paths() < kMostPaths && watch.seconds() < kNoiseSliceSeconds &&
                   slice.tracer->advance(monitor.stop)) {
            }
            if (slice.tracer->has_all_groups())
                slice.noise = std::make_shared<const diagnose::PixelNoise>(slice.tracer->noise());
            slice.seconds = watch.seconds();
            return slice;
        });
}

void NoiseTracing::update(const std::shared_ptr<const diagnose::PassPair>& passes, std::uint32_t pixel) {
    take_slice();
    const bool is_shown = std::exchange(is_shown_, false);
    if (passes != passes_ || pixel != pixel_) {
        drop();
        passes_ = passes;
        pixel_ = pixel;
    }
    if (!is_shown || !passes_) {
        if (job_) job_->stop();
        return;
    }
    if (!job_ && failure_.empty() && !is_complete()) begin_slice();
}

namespace {

void add_side(std::vector<PathPiece>& lines, const diagnose::PixelPaths& paths, bool is_guided,
              const DrawnPaths& drawn) {
    const std::vector<diagnose::PathRecord>& side = is_guided ? paths.guided : paths.plain;
    const std::vector<std::size_t> order = diagnose::by_light(side);
    for (auto i = order.rbegin(); i != order.rend(); ++i) {
        if (is_guided == drawn.lists_guided && *i == drawn.selected) continue;
        add_path(lines, side[*i],
                 {.range = drawn.range,
                  .escape_length = drawn.escape_length,
                  .has_shadow_rays = drawn.has_shadow_rays,
                  .is_dashed = !is_guided && !paths.guided.empty()});
    }
}

}  // namespace

ValueRange light_range(const diagnose::PixelPaths& paths) {
    std::vector<float> light;
    for (const diagnose::PathRecord& path : paths.plain) light.push_back(diagnose::path_light(path));
    for (const diagnose::PathRecord& path : paths.guided) light.push_back(diagnose::path_light(path));
    std::erase(light, 0.0f);  // paths without light have a color of their own
    return range_of(light, {.scale = ColorScale::Logarithmic});
}

std::vector<PathPiece> lines_of(const diagnose::PixelPaths& paths, const DrawnPaths& drawn) {
    std::vector<PathPiece> lines;
    const bool two = !paths.guided.empty();
    if (!two || drawn.sides != PathSides::Guided) add_side(lines, paths, false, drawn);
    if (two && drawn.sides != PathSides::Plain) add_side(lines, paths, true, drawn);
    if (drawn.selected)
        add_path(lines, (drawn.lists_guided ? paths.guided : paths.plain)[*drawn.selected],
                 {.range = drawn.range,
                  .escape_length = drawn.escape_length,
                  .has_shadow_rays = true,
                  .is_dashed = !drawn.lists_guided && two,
                  .is_selected = true});
    return lines;
}

void PathExplorer::set_shown(bool shown) {
    is_shown_ = shown;
    if (!shown) drop();
}

void PathExplorer::drop() {
    job_.reset();
    click_.is_asked = false;
    noise_.drop();
    passes_.reset();
    paths_.reset();
    begun_ = {.count = 0};
    selected_.reset();
    lines_.key = {};
    lines_.pieces.clear();
}

void PathExplorer::pick(Vec2f image_point) {
    if (!is_shown_) return;
    click_.point = image_point;
    click_.is_asked = true;
    link_.worker().request_paths();
}

void PathExplorer::take_answer() {
    std::optional<PathsAnswer> answer = link_.worker().take<PathsAnswer>();
    if (!answer || !click_.is_asked) return;
    drop();
    if (answer->value == nullptr) {
        messages_.say(MessageLevel::Info, answer->reason);
        return;
    }
    passes_ = std::move(answer->value);
    generation_ = answer->generation;
}

/// The pixel of the click, and as many paths as are to be shown.
diagnose::PixelPathsRequest PathExplorer::wanted() const {
    const auto cell = [](float share, int size) {
        return std::clamp(static_cast<int>(share * static_cast<float>(size)), 0, size - 1);
    };
    const int width = passes_->plain.width;
    const int pixel = cell(click_.point.y, passes_->plain.height) * width + cell(click_.point.x, width);
    return {.pixel = static_cast<std::uint32_t>(pixel),
            .count = static_cast<std::uint32_t>(std::clamp(options_.count, 1, kMostPaths)),
            .choice = options_.choice};
}

void PathExplorer::take_paths() {
    if (!job_) return;
    auto result = job_->take_result();
    if (!result) return;
    job_.reset();
    if (!result->failure.empty()) {
        messages_.say(MessageLevel::Error, "tracing the paths of a pixel failed: " + result->failure);
        return;
    }
    paths_ = result->value;
    selected_.reset();
    range_ = light_range(*paths_);
}

/// Paths of another scene would hang in the air. A moved camera leaves them as they are.
void PathExplorer::drop_with_scene() {
    const auto& frame = link_.frame();
    if (passes_ && frame && frame->generation > generation_ && frame->scene != passes_->plain.scene) drop();
}

void PathExplorer::update() {
    take_answer();
    drop_with_scene();
    take_paths();
    noise_.update(passes_, passes_ ? wanted().pixel : 0);
    if (!passes_ || wanted() == begun_) return;
    job_.reset();  // ends the search of before
    begun_ = wanted();
    job_ = std::make_unique<BackgroundJob<Traced>>([passes = passes_, request = begun_](const JobMonitor& monitor) {
        return std::make_shared<const diagnose::PixelPaths>(diagnose::trace_pixel(*passes, request, monitor.stop));
    });
}

bool PathExplorer::has_two_sides() const { return !paths_->guided.empty(); }

bool PathExplorer::lists_guided() const {
    if (!has_two_sides()) return false;
    if (options_.sides == PathSides::Both) return passes_->shows_guided;
    return options_.sides == PathSides::Guided;
}

std::optional<std::size_t> PathExplorer::selected() const {
    if (!paths_ || listed().empty()) return std::nullopt;
    return selected_ && *selected_ < listed().size() ? *selected_ : diagnose::by_light(listed()).front();
}

const std::vector<PathPiece>& PathExplorer::pieces(const PublishedFrame& frame) {
    LinesKey key{.paths = paths_,
                 .scene = frame.scene,
                 .eye = frame.snapshot.camera.eye,
                 .sides = options_.sides,
                 .has_shadow_rays = options_.has_shadow_rays,
                 .selected = selected()};
    if (key == lines_.key) return lines_.pieces;
    lines_.key = std::move(key);
    lines_.pieces.clear();
    if (!paths_) return lines_.pieces;
    ++lines_.times_made;
    const std::vector<PathPiece> lines = lines_of(*paths_, {.range = range_,
                                                            .sides = options_.sides,
                                                            .has_shadow_rays = options_.has_shadow_rays,
                                                            .lists_guided = lists_guided(),
                                                            .selected = selected(),
                                                            .escape_length = frame.facts.diagonal});
    lines_.pieces = split_by_visibility(lines, frame.scene->view(), lines_.key.eye);
    return lines_.pieces;
}

}  // namespace pl::ui
