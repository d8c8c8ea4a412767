#include "core/measure/live_run.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "core/kernel/base/half.h"
#include "core/measure/run_recorder.h"

namespace pl {

HalfPicture half_picture(int width, int height, Pixels pixels) {
    HalfPicture picture{.width = width, .height = height, .rgb = {}};
    picture.rgb.reserve(3 * pixels.size());
    for (const Vec3f& pixel : pixels)
        for (const float value : {pixel.x, pixel.y, pixel.z}) picture.rgb.push_back(to_half(value));
    return picture;
}

std::vector<Vec3f> pixels_of(const HalfPicture& picture) {
    std::vector<Vec3f> pixels(picture.rgb.size() / 3);
    for (std::size_t i = 0; i < pixels.size(); ++i)
        pixels[i] = {from_half(picture.rgb[3 * i]), from_half(picture.rgb[3 * i + 1]),
                     from_half(picture.rgb[3 * i + 2])};
    return pixels;
}

namespace {

struct Droppable {
    bool shows_the_present = false;
    PicturePlace place;
    double gap = 0.0;  ///< logarithm of the time between its neighbors; infinite for the last picture of a run

    bool operator<(const Droppable& other) const {
        const auto key = [](const Droppable& d) {
            return std::make_tuple(d.shows_the_present, d.shows_the_present ? 0 : d.place.run, d.gap, d.place.run,
                                   d.place.point);
        };
        return key(*this) < key(other);
    }
};

void add_droppable(std::vector<Droppable>& pictures, const LiveRun& run, std::size_t index, bool present) {
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < run.points.size(); ++i)
        if (run.points[i].picture) kept.push_back(i);
    for (std::size_t k = 0; k < kept.size(); ++k) {
        double gap = std::numeric_limits<double>::infinity();
        if (k + 1 < kept.size()) {
            const double before = charged_seconds(run.points[kept[k > 0 ? k - 1 : 0]].clocks);
            gap = std::log(charged_seconds(run.points[kept[k + 1]].clocks) / before);
        }
        pictures.push_back({.shows_the_present = present, .place = {index, kept[k]}, .gap = gap});
    }
}

}  // namespace

PicturePlace least_needed_picture(const std::vector<std::shared_ptr<const LiveRun>>& runs, std::uint64_t present) {
    std::vector<Droppable> pictures;
    for (std::size_t i = 0; i < runs.size(); ++i)
        add_droppable(pictures, *runs[i], i, runs[i]->label.picture == present);
    return std::min_element(pictures.begin(), pictures.end())->place;
}

}  // namespace pl
