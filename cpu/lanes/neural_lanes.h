// Loops of the network of neural fields over SIMD lanes; see lanes.h. Elements are lanes and every sum has an order of its own, so that the
// width of vectors changes no bit.
#pragma once

#include "cpu/base/groups.h"
#include "cpu/lanes/lanes.h"

namespace pl {
namespace {

constexpr std::uint32_t kRowBlock = 4;
constexpr std::uint32_t kVectors = 2;  ///< of a block of columns
static_assert(kColumnBlock % (kVectors * kLaneWidth) == 0);

/// kRowBlock rows and kVectors vectors of columns of a product.
PL_INLINE void multiply_block(const MatrixProduct& p, std::uint32_t row, std::uint32_t column) {
    LaneFloat sums[kRowBlock][kVectors];
    float* c = p.c + row * p.c_row + column;
    for (std::uint32_t r = 0; r < kRowBlock; ++r)
        for (std::uint32_t v = 0; v < kVectors; ++v)
            sums[r][v] = p.adds ? load_lanes<LaneFloat>(c + r * p.c_row + v * kLaneWidth) : LaneFloat{};
    const float* a = p.a + row * p.a_row;
    const float* b = p.b + column;
    for (std::uint32_t i = 0; i < p.inner; ++i, a += p.a_inner, b += p.b_row) {
        const LaneFloat first = load_lanes<LaneFloat>(b);
        const LaneFloat second = load_lanes<LaneFloat>(b + kLaneWidth);
        for (std::uint32_t r = 0; r < kRowBlock; ++r) {
            const LaneFloat factor = broadcast(a[r * p.a_row]);
            sums[r][0] += factor * first;
            sums[r][1] += factor * second;
        }
    }
    for (std::uint32_t r = 0; r < kRowBlock; ++r)
        for (std::uint32_t v = 0; v < kVectors; ++v) store_lanes(sums[r][v], c + r * p.c_row + v * kLaneWidth);
}

void multiply(const MatrixProduct& p) {
    for (std::uint32_t column = 0; column < p.columns; column += kVectors * kLaneWidth)
        for (std::uint32_t row = 0; row < p.rows; row += kRowBlock) multiply_block(p, row, column);
}

/// e^x of |x| <= kMostLogarithm, beyond it the value at the limit. Relative error below 1e-6.
PL_INLINE LaneFloat exponential(const LaneFloat& x) {
    constexpr float kMostLogarithm = 20.0f;
    constexpr float kLog2E = 1.44269504f;
    constexpr int kShift = 64;  // above any |x| log2(e), so that truncation rounds down
    const LaneFloat power = larger(smaller(x, broadcast(kMostLogarithm)), broadcast(-kMostLogarithm)) * kLog2E;
    const LaneInt whole = Lanes::truncate(power + (static_cast<float>(kShift) + 0.5f)) - kShift;
    const LaneFloat f = power - Lanes::to_real(whole);
    // Taylor series of 2^f, |f| <= 1/2.
    LaneFloat sum = broadcast(1.54035304e-4f);
    sum = sum * f + 1.33335581e-3f;
    sum = sum * f + 9.61812911e-3f;
    sum = sum * f + 5.55041087e-2f;
    sum = sum * f + 2.40226507e-1f;
    sum = sum * f + 6.93147181e-1f;
    sum = sum * f + 1.0f;
    return sum * Lanes::from_bits((whole + 127) << 23);
}

/// A sum over columns: of every kColumnBlock-th one by itself, and then of these in order.
struct ColumnTotal {
    static constexpr std::uint32_t kParts = kColumnBlock / kLaneWidth;
    LaneFloat parts[kParts] = {};

    PL_INLINE float total() const {
        float values[kColumnBlock];
        for (std::uint32_t part = 0; part < kParts; ++part) store_lanes(parts[part], values + part * kLaneWidth);
        float sum = 0.0f;
        for (const float value : values) sum += value;
        return sum;
    }
};

/// Calls body(part of a ColumnTotal, column) for each vector of columns.
template <class Body>
PL_INLINE void for_columns(std::uint32_t columns, Body&& body) {
    for (std::uint32_t column = 0; column < columns; column += kColumnBlock)
        for (std::uint32_t part = 0; part < ColumnTotal::kParts; ++part) body(part, column + part * kLaneWidth);
}

PL_INLINE LaneFloat column(const float* values, std::uint32_t index) { return load_lanes<LaneFloat>(values + index); }

void descend(const DescentStep& step) {
    constexpr float kLeast = 1.0e-8f;
    static_assert(kColumnBlock % kLaneWidth == 0);
    for (std::size_t i = 0; i < step.count; i += kLaneWidth) {
        const auto slope = load_lanes<LaneFloat>(step.slopes + i);
        const LaneFloat mean = kMeanShare * load_lanes<LaneFloat>(step.slope_mean + i) + (1.0f - kMeanShare) * slope;
        const LaneFloat square =
            kSquareShare * load_lanes<LaneFloat>(step.slope_square + i) + (1.0f - kSquareShare) * (slope * slope);
        const LaneFloat weight = load_lanes<LaneFloat>(step.weights + i) -
                                 step.rate * mean / (Lanes::sqrt(square * step.square_scale) + kLeast);
        store_lanes(mean, step.slope_mean + i);
        store_lanes(square, step.slope_square + i);
        store_lanes(weight, step.weights + i);
    }
}

/// Logarithms of the density of each component at a vector of directions, and the largest of them.
struct ComponentLogarithms {
    LaneFloat values[kVertexLobes];
    LaneFloat largest;

    PL_INLINE ComponentLogarithms(const MixtureLight& light, const LaneFloat& x, const LaneFloat& y,
                                  const LaneFloat& z) {
        for (std::uint32_t k = 0; k < kVertexLobes; ++k) {
            values[k] = light.offset[k] + light.axis[0][k] * x + light.axis[1][k] * y + light.axis[2][k] * z;
            largest = k == 0 ? values[0] : larger(largest, values[k]);
        }
    }
};

PL_INLINE LaneFloat logarithms_of(const LaneFloat& values) {
    float each[kLaneWidth];
    store_lanes(values, each);
    for (float& value : each) value = log_of(value);
    return load_lanes<LaneFloat>(each);
}

float attribute(const MixtureLight& light, MixtureShares& shares) {
    ColumnTotal logarithm, weight[kVertexLobes], direction[3][kVertexLobes];
    for_columns(light.columns, [&](std::uint32_t part, std::uint32_t i) {
        const LaneFloat at[3] = {column(light.x, i), column(light.y, i), column(light.z, i)};
        const LaneFloat probability = column(light.probability, i);
        ComponentLogarithms components(light, at[0], at[1], at[2]);
        LaneFloat sum{};
        for (LaneFloat& value : components.values) {
            value = exponential(value - components.largest);
            sum += value;
        }
        logarithm.parts[part] += probability * (components.largest + logarithms_of(sum));
        const LaneFloat scale = probability / sum;
        for (std::uint32_t k = 0; k < kVertexLobes; ++k) {
            const LaneFloat share = scale * components.values[k];
            weight[k].parts[part] += share;
            for (std::uint32_t axis = 0; axis < 3; ++axis) direction[axis][k].parts[part] += share * at[axis];
        }
    });
    for (std::uint32_t k = 0; k < kVertexLobes; ++k) {
        shares.weight[k] = weight[k].total();
        for (std::uint32_t axis = 0; axis < 3; ++axis) shares.direction[axis][k] = direction[axis][k].total();
    }
    return logarithm.total();
}

/// Not a template of the header: the linker would merge its instances for all instruction sets.
void evaluate_in_lanes(const float* weights, const float* inputs, float* outputs) {
    evaluate_vertex<LaneFloat>(weights, inputs, outputs);
}

}  // namespace
}  // namespace pl
