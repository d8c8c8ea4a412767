#include "app/report/plot.h"

#include <algorithm>
#include <limits>

namespace pl {
namespace {

struct Range {
    double low = std::numeric_limits<double>::infinity();
    double high = 0.0;

    void add(double value) {
        if (!(value > 0.0)) return;
        low = std::min(low, value);
        high = std::max(high, value);
    }
};

}  // namespace

LogAxis Plot::x_axis() const {
    Range range;
    for (const PlotSeries& one : series) {
        for (const PlotPoint& point : one.line) range.add(point.x);
        for (const BandPoint& point : one.band) range.add(point.x);
    }
    return {range.low, range.high};
}

LogAxis Plot::y_axis() const {
    Range range;
    for (const PlotSeries& one : series) {
        for (const PlotPoint& point : one.line) range.add(point.y);
        for (const BandPoint& point : one.band) {
            range.add(point.low);
            range.add(point.high);
        }
    }
    return {range.low, range.high};
}

Rgb method_color(const std::string& method) {
    if (method == "default") return {0, 114, 178};
    if (method == "precomputed") return {230, 159, 0};
    if (method == "reinforcement") return {0, 158, 115};
    return {204, 121, 167};
}

}  // namespace pl
