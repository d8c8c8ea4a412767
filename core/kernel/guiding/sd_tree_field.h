// A model of GuidingField on the host: an SD-tree of incident radiance for directions, radiance volumes for irradiance.
// [Mueller et al. 2017; Mueller 2019, "Practical Path Guiding in Production"]
#pragma once

#include "core/kernel/guiding/guiding_field.h"
#include "core/kernel/guiding/sd_tree_view.h"
#include "core/kernel/guiding/volume_irradiance.h"
#include "core/kernel/guiding/volume_lights.h"

namespace pl {

/// The volume and the leaf that serve a surface point.
struct SdTreeLocation {
    std::int32_t volume = kNoVolume;
    SpatialLeaf leaf{};
    Vec3f in_cube{0.0f};  ///< the point in units of the tree's cube

    PL_HD bool is_served() const { return volume != kNoVolume; }
};

/// The sums that a direction trains, and its weights in them.
struct SdTreeEntry {
    std::int32_t volume = kNoVolume;
    std::uint32_t leaf = 0;
    std::uint32_t slot = 0;
    float inverse_pdf = 0.0f;    ///< 1 / q in steradians, clamped
    float cosine_weight = 0.0f;  ///< cos / (pi q) with the volume's normal, clamped

    PL_HD bool is_trained() const { return volume != kNoVolume; }
};

struct SdTreeField : SdTreeView {
    using Location = SdTreeLocation;
    using Entry = SdTreeEntry;

    PL_HD Location locate(const SurfacePoint& surface) const {
        const std::int32_t volume = volume_at(surface);
        if (volume == kNoVolume) return {};
        const Vec3f point = in_cube(surface.position);
        return {volume, leaf_at(point), point};
    }
    PL_HD Vec3f sample(const Location& location, const SurfacePoint&, const ScatterUniforms& uniforms) const {
        return square_to_sphere(sample_square(location.leaf.leaf, {uniforms.u.y, uniforms.u.z}));
    }
    PL_HD FieldDensity density(const Location& location, const SurfacePoint&, Vec3f wi) const {
        const QuadSlot slot = slot_at(location.leaf.leaf, sphere_to_square(wi));
        return {slot_pdf_sa(location.leaf.leaf, slot),
                static_cast<std::int32_t>(slot.depth << kSlotBits | slot.slot)};
    }
    PL_HD float bsdf_fraction_at(const Location& location) const { return bsdf_fraction[location.leaf.leaf]; }
    PL_HD float value_at(const Location& location) const {
        return mean_radiance[static_cast<std::uint32_t>(location.volume)];
    }
    PL_HD float direct_at(const Location& location) const {
        return direct[static_cast<std::uint32_t>(location.volume)];
    }
    PL_HD float radiance_at(const Location& location, std::int32_t bin) const {
        if (bin < 0 || visits[location.leaf.leaf] == 0) return value_at(location);
        return radiance_of(slot_of(bin));
    }
    /// Mean incident radiance of a slot's directions.
    PL_HD float radiance_of(const QuadSlot& slot) const {
        return energy[slot.slot] * (kUniformSpherePdf / (slot.side() * slot.side()));
    }

    /// The leaf contains a random point of the box around the point, of the size of the point's leaf. The slot contains a random
    /// direction of the box around the direction, of the size of its slot. These are box filters, each evaluated at one point.
    /// [Mueller 2019, sections 10.3 and 10.4]
    PL_HD Entry entry_of(const Location& location, const DirectionSample& direction) const {
        if (direction.bin < 0 || !(direction.pdf_sa > 0.0f)) return {};
        const Philox random = filter_bits(location.in_cube, direction.wi);
        const std::uint32_t leaf = leaf_at(filtered_point(location, random)).leaf;
        const float cosine = glm::dot(normals[static_cast<std::uint32_t>(location.volume)], direction.wi);
        return {location.volume, leaf, filtered_slot(leaf, direction, random.v[3]), inverse_density(direction.pdf_sa),
                cosine_weight_of(cosine, direction.pdf_sa)};
    }
    PL_HD void record(const TrainingSample<SdTreeField>& sample, bool learns_fraction) const {
        const Entry& entry = sample.entry;
        atomic_add(pending_count[entry.leaf], 1u, writers);
        count_irradiance(*this, static_cast<std::uint32_t>(entry.volume), entry.cosine_weight);
        add(sample, learns_fraction);
    }
    PL_HD void add(const TrainingSample<SdTreeField>& sample, bool learns_fraction) const {
        if (!(sample.target > 0.0f)) return;
        const Entry& entry = sample.entry;
        const auto volume = static_cast<std::uint32_t>(entry.volume);
        const float target = min_of(sample.target, kMaxRecordedUnits * radiance_unit);
        atomic_add(pending_energy[entry.slot], to_fixed_point(target * entry.inverse_pdf, radiance_unit), writers);
        atomic_add(pending_value[volume], to_fixed_point(target * entry.cosine_weight, radiance_unit), writers);
        if (learns_fraction) record_fraction(*this, entry.leaf, volume, sample.bsdf_ratio, sample.target);
    }
    PL_HD LearnedLights lights_at(const Location& location) const { return lights_of_volume(*this, location.volume); }
    PL_HD void record_light(const LightSample<SdTreeField>& light) const { record_at_volume(*this, light); }
    PL_HD bool is_clamped(float target) const { return pl::is_clamped(target, radiance_unit); }

private:
    /// Random bits that are a function of the sample alone, so that no order of threads changes them.
    static PL_HD Philox filter_bits(Vec3f point, Vec3f wi) {
        const auto bits = [](float x) { return std::bit_cast<std::uint32_t>(x); };
        return philox4x32({{bits(point.x), bits(point.y), bits(wi.x), bits(wi.y)}}, bits(point.z), bits(wi.z));
    }
    static PL_HD Vec3f filtered_point(const Location& location, const Philox& random) {
        Vec3f point = location.in_cube;
        for (std::uint32_t axis = 0; axis < 3; ++axis) {
            const std::uint32_t divisions = (location.leaf.depth + 2 - axis) / 3;
            const float side = 1.0f / static_cast<float>(1u << divisions);
            const auto i = static_cast<int>(axis);
            point[i] = clamp_to(point[i] + side * (to_unit_float(random.v[axis]) - 0.5f), 0.0f, kBelowOne);
        }
        return point;
    }
    static PL_HD QuadSlot slot_of(std::int32_t bin) {
        const auto word = static_cast<std::uint32_t>(bin);
        return {word & ((1u << kSlotBits) - 1), word >> kSlotBits};
    }
    /// The azimuth wraps around; beyond a pole the box is cut off.
    PL_HD std::uint32_t filtered_slot(std::uint32_t leaf, const DirectionSample& direction,
                                      std::uint32_t random) const {
        Vec2f square = sphere_to_square(direction.wi);
        const float side = slot_of(direction.bin).side();
        square.x += side * (to_unit_float(random << 16) - 0.5f);
        square.y += side * (to_unit_float(random & 0xffff0000u) - 0.5f);
        square.y -= std::floor(square.y);
        return slot_at(leaf, {clamp_to(square.x, 0.0f, kBelowOne), clamp_to(square.y, 0.0f, kBelowOne)}).slot;
    }
};
static_assert(RadianceField<SdTreeField>);

}  // namespace pl
