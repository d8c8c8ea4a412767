#include "cpu/learning/mixture_slopes.h"

#include <cmath>

namespace pl {
namespace {

/// A lobe of the network, and its product with the cosine.
struct TaughtLobe {
    VmfLobe lobe;
    Vec3f axis;            ///< v
    float offset;          ///< b, without constants
    float log_integral;    ///< b + A(|v|)
    Vec3f mean_direction;  ///< r(|v|) v / |v|
};

TaughtLobe taught_lobe(const float* outputs, Vec3f normal, std::uint32_t k) {
    TaughtLobe taught;
    taught.lobe = vertex_lobe(outputs_of(outputs, k), normal, k);
    const float kappa = taught.lobe.kappa;
    taught.axis = kappa * taught.lobe.mean + kCosineKappa * normal;
    taught.offset = outputs[kLobeLogit * kVertexLobes + k] + std::log(vmf_peak(kappa)) - kappa;
    const float length = glm::length(taught.axis);
    taught.log_integral = taught.offset - std::log(vmf_peak(length)) + length;
    taught.mean_direction = length > 0.0f ? taught.axis * (vmf_mean_cosine(length) / length) : Vec3f{0.0f};
    return taught;
}

/// Slopes by the outputs of one lobe, of those by b and by v.
void lobe_slopes(const TaughtLobe& taught, const float* outputs, Vec3f normal, std::uint32_t k, float by_offset,
                 Vec3f by_axis, float* slopes) {
    const float kappa = taught.lobe.kappa;
    const Vec3f mean = taught.lobe.mean;
    const float along = glm::dot(by_axis, mean);
    const float by_kappa = along - by_offset * vmf_mean_cosine(kappa);
    const float narrowness = kFirstNarrowness + outputs[kLobeNarrowness * kVertexLobes + k];
    const bool is_free = narrowness > kLeastNarrowness && narrowness < kMostNarrowness;
    const float length = max_of(glm::length(vertex_axis(outputs_of(outputs, k).shift, normal, k)), 1.0e-6f);
    const Vec3f across = (kappa / length) * (by_axis - along * mean);
    slopes[kLobeLogit * kVertexLobes + k] = by_offset;
    slopes[kLobeX * kVertexLobes + k] = across.x;
    slopes[kLobeY * kVertexLobes + k] = across.y;
    slopes[kLobeZ * kVertexLobes + k] = across.z;
    // Beyond a bound a lobe may only come back.
    const float by_narrowness = kappa * by_kappa;
    const bool comes_back = narrowness >= kMostNarrowness ? by_narrowness > 0.0f : by_narrowness < 0.0f;
    slopes[kLobeNarrowness * kVertexLobes + k] = is_free || comes_back ? by_narrowness : 0.0f;
}

}  // namespace

float mixture_slopes(const LaneKernels& kernels, const TaughtLight& light, const float* outputs, float scale,
                     float* slopes) {
    const Frame frame = make_frame(light.normal);
    MixtureLight mixture{light.probability, light.x, light.y, light.z, {}, {}, light.columns};
    TaughtLobe lobes[kVertexLobes];
    float largest = -kInfinity;
    for (std::uint32_t k = 0; k < kVertexLobes; ++k) {
        lobes[k] = taught_lobe(outputs, light.normal, k);
        largest = max_of(largest, lobes[k].log_integral);
        const Vec3f local = frame.to_local(lobes[k].axis);
        mixture.offset[k] = lobes[k].offset;
        for (int axis = 0; axis < 3; ++axis) mixture.axis[axis][k] = local[axis];
    }
    MixtureShares shares;
    const float logarithm = kernels.attribute(mixture, shares);
    float integral = 0.0f;
    for (const TaughtLobe& lobe : lobes) integral += std::exp(lobe.log_integral - largest);
    for (std::uint32_t k = 0; k < kVertexLobes; ++k) {
        const float share = std::exp(lobes[k].log_integral - largest) / integral;
        const Vec3f direction{shares.direction[0][k], shares.direction[1][k], shares.direction[2][k]};
        lobe_slopes(lobes[k], outputs, light.normal, k, scale * (share - shares.weight[k]),
                    scale * (share * lobes[k].mean_direction - frame.to_world(direction)), slopes);
    }
    return largest + std::log(integral) - logarithm;
}

}  // namespace pl
