#include "core/fields/neural_model.h"

#include <cmath>

namespace pl {
namespace {

/// A number in [-1, 1) of its own for every index.   [PCG hash: Jarzynski and Olano 2020]
float scattered(std::size_t i) {
    const std::uint32_t state = static_cast<std::uint32_t>(i) * 747796405u + 2891336453u;
    const std::uint32_t word = ((state >> ((state >> 28) + 4)) ^ state) * 277803737u;
    return static_cast<float>((word >> 22) ^ word) * 0x1p-31f - 1.0f;
}

std::size_t network_values(const FieldShape& shape, const HostNeural& field, const void* array) {
    return array == &field.counts ? std::size_t{kNetworkCounts} : layout_of(shape).count;
}

}  // namespace

NetworkLayout layout_of(const FieldShape& shape) {
    return NetworkLayout(static_cast<std::uint32_t>(shape.cells.count()));
}

void reset_network(const NetworkLayout& layout, HostNeural& field) {
    constexpr float kFirstFeature = 0.05f;
    field.weights.assign(layout.count, 0.0f);
    field.slope_mean.assign(layout.count, 0.0f);
    field.slope_square.assign(layout.count, 0.0f);
    field.counts.assign(kNetworkCounts, 0);
    field.counts[kNetworkVersion] = kNetworkLayoutVersion;
    // The last layer stays 0, so that an untrained network changes nothing.
    for (std::size_t i = 0; i < layout.first; ++i) field.weights[i] = kFirstFeature * scattered(i);
    const float first = std::sqrt(6.0f / static_cast<float>(kConstantInput));
    const float second = std::sqrt(6.0f / static_cast<float>(layout.hidden));
    for (std::size_t i = layout.first; i < layout.second; ++i) field.weights[i] = first * scattered(i);
    for (std::size_t i = layout.second; i < layout.second + std::size_t{layout.hidden} * layout.hidden; ++i)
        field.weights[i] = second * scattered(i);
}

HostNeural make_neural(const FieldShape& shape, std::size_t volumes) {
    HostNeural field;
    static_cast<HostTables&>(field) = make_tables(shape, volumes);
    reset_network(layout_of(shape), field);
    return field;
}

bool fits(const FieldShape& shape, const HostNeural& field, std::size_t volumes) {
    bool all = fits(shape, static_cast<const HostTables&>(field), volumes);
    for_each_network_array([&](const auto& spec) {
        all = all && spec.get(field).size() == network_values(shape, field, &spec.get(field));
    });
    return all;
}

std::size_t network_bytes(int bins) {
    const NetworkLayout layout(static_cast<std::uint32_t>(bins));
    return 3 * layout.count * sizeof(float) + kNetworkCounts * sizeof(std::uint32_t);
}

std::size_t field_bytes(const HostNeural& field) {
    return field_bytes(static_cast<const HostTables&>(field)) + status_of(field).bytes;
}

NetworkStatus status_of(const HostNeural& field) {
    NetworkStatus status;
    for_each_network_array(
        [&](const auto& spec) { status.bytes += spec.get(field).size() * sizeof *spec.get(field).data(); });
    if (field.counts.size() != kNetworkCounts) return status;  // of a method without a field
    status.steps = field.counts[kNetworkSteps];
    status.is_lost = field.counts[kNetworkIsLost] != 0;
    return status;
}

HostNeural split_field(const FieldShape& shape, HostNeural field, std::span<const std::uint32_t> parents) {
    HostTables tables = split_field(shape, static_cast<HostTables&&>(field), parents);
    static_cast<HostTables&>(field) = std::move(tables);
    return field;
}

std::optional<std::string> damage_of(const HostNeural& field) {
    if (field.counts[kNetworkVersion] != kNetworkLayoutVersion)
        return "layout " + std::to_string(field.counts[kNetworkVersion]);
    if (field.counts[kNetworkIsLost] > 1) return "mark of loss " + std::to_string(field.counts[kNetworkIsLost]);
    return std::nullopt;
}

}  // namespace pl
