#include "tests/bench/trimmed_errors.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace pl::benchmarks {
namespace {

/// A pixel of a trimmed mean: the least `rank` stay.
struct RankedTerm {
    double rank = 0.0;
    double term = 0.0;
};

/// 0 for none.
double trimmed_mean(std::vector<RankedTerm> terms, double left_out) {
    if (terms.empty()) return 0.0;
    const auto kept = static_cast<std::size_t>(std::ceil((1.0 - left_out) * static_cast<double>(terms.size())));
    std::sort(terms.begin(), terms.end(), [](const RankedTerm& a, const RankedTerm& b) { return a.rank < b.rank; });
    double sum = 0.0;
    for (std::size_t i = 0; i < kept; ++i) sum += terms[i].term;
    return sum / static_cast<double>(kept);
}

}  // namespace

TrimmedErrors measure_trimmed(Pixels picture, const PictureHalves& reference, double left_out) {
    std::vector<RankedTerm> squares;
    std::vector<RankedTerm> relative_squares;
    for (std::size_t i = 0; i < picture.size(); ++i) {
        if (!is_finite(picture[i]) || !is_finite(reference.first[i]) || !is_finite(reference.second[i])) continue;
        const Vec3d x{picture[i]};
        const Vec3d r1{reference.first[i]};
        const Vec3d r2{reference.second[i]};
        const Vec3d r = 0.5 * (r1 + r2);
        RankedTerm square;
        RankedTerm relative;
        for (int c = 0; c < 3; ++c) {
            const double distance = (x[c] - r[c]) * (x[c] - r[c]);
            const double product = (x[c] - r1[c]) * (x[c] - r2[c]);
            const double weight = 1.0 / (r[c] * r[c] + kEpsilon);
            square.rank += distance;
            square.term += product / 3.0;
            relative.rank += distance * weight;
            relative.term += product * weight / 3.0;
        }
        squares.push_back(square);
        relative_squares.push_back(relative);
    }
    return {trimmed_mean(std::move(squares), left_out), trimmed_mean(std::move(relative_squares), left_out)};
}

}  // namespace pl::benchmarks
