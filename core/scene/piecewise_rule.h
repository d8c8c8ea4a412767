// Quadrature of functions that are smooth but for kinks at known places: intervals cut there, and a rule for each piece.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include <glm/gtc/constants.hpp>

namespace pl {

/// Nodes and weights on [0, 1].
template <std::size_t N>
struct QuadratureRule {
    std::array<double, N> at, weight;
};

/// A root of a Legendre polynomial, with the derivative there.
struct LegendreRoot {
    double x = 0.0;
    double derivative = 0.0;
};
/// Root `i` of the polynomial of degree `n`, by Newton's method.   [Press et al., Numerical Recipes, 3rd ed., 4.6]
inline LegendreRoot legendre_root(std::size_t n, std::size_t i) {
    const auto degree = static_cast<double>(n);
    LegendreRoot root{.x = std::cos(glm::pi<double>() * (static_cast<double>(i) + 0.75) / (degree + 0.5))};
    for (int step = 0; step < 6; ++step) {
        double below = 0.0;
        double value = 1.0;
        for (std::size_t k = 0; k < n; ++k) {
            const auto order = static_cast<double>(k);
            const double next = ((2.0 * order + 1.0) * root.x * value - order * below) / (order + 1.0);
            below = value;
            value = next;
        }
        root.derivative = degree * (root.x * value - below) / (root.x * root.x - 1.0);
        root.x -= value / root.derivative;
    }
    return root;
}

/// The rule of Gauss and Legendre, after a substitution that removes square roots at the ends at which there is a kink.
template <std::size_t N>
QuadratureRule<N> make_piece_rule(bool kink_at_begin, bool kink_at_end) {
    QuadratureRule<N> rule;
    for (std::size_t i = 0; i < N; ++i) {
        const LegendreRoot root = legendre_root(N, i);
        const double t = 0.5 + 0.5 * root.x;
        double x = t;
        double slope = 1.0;
        if (kink_at_begin && kink_at_end) {
            x = t * t * (3.0 - 2.0 * t);
            slope = 6.0 * t * (1.0 - t);
        } else if (kink_at_begin) {
            x = t * t;
            slope = 2.0 * t;
        } else if (kink_at_end) {
            x = t * (2.0 - t);
            slope = 2.0 * (1.0 - t);
        }
        rule.at[i] = x;
        rule.weight[i] = slope / ((1.0 - root.x * root.x) * root.derivative * root.derivative);
    }
    return rule;
}
template <std::size_t N>
const QuadratureRule<N>& piece_rule(bool kink_at_begin, bool kink_at_end) {
    static const std::array<QuadratureRule<N>, 4> rules{
        make_piece_rule<N>(false, false), make_piece_rule<N>(true, false), make_piece_rule<N>(false, true),
        make_piece_rule<N>(true, true)};
    return rules[(kink_at_begin ? 1u : 0u) + (kink_at_end ? 2u : 0u)];
}

/// An interval in pieces, that meet at kinks.
class Pieces {
public:
    Pieces(double begin, double end) : ends_{begin, end} {}
    /// Cuts at `x` if it is within the interval; at most kMostCuts times.
    void cut(double x) {
        if (!(x > ends_[0]) || !(x < ends_[count_])) return;
        std::size_t i = count_++;
        for (ends_[i + 1] = ends_[i]; ends_[i - 1] > x; --i) ends_[i] = ends_[i - 1];
        ends_[i] = x;
    }
    std::size_t count() const { return count_; }
    double begin(std::size_t piece) const { return ends_[piece]; }
    double length(std::size_t piece) const { return ends_[piece + 1] - ends_[piece]; }
    bool is_first(std::size_t piece) const { return piece == 0; }
    bool is_last(std::size_t piece) const { return piece + 1 == count_; }

private:
    static constexpr std::size_t kMostCuts = 6;

    std::array<double, kMostCuts + 2> ends_;
    std::size_t count_ = 1;
};

}  // namespace pl
