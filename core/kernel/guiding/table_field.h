// The first model of GuidingField: one table of cells per radiance volume.
#pragma once

#include "core/kernel/guiding/guiding_field.h"
#include "core/kernel/guiding/mixture.h"
#include "core/kernel/guiding/reach.h"
#include "core/kernel/guiding/table_sampler.h"
#include "core/kernel/guiding/volume_lights.h"

namespace pl {

/// The volume that serves a surface point.
struct TableLocation {
    std::int32_t volume = kNoVolume;
    std::uint32_t node = FoundVolume::kUnknown;  ///< of the search tree, which holds the volume's position and normal

    PL_HD bool is_served() const { return volume != kNoVolume; }
};

/// The cell that a direction trains.
struct TableEntry {
    std::int32_t volume = kNoVolume;
    std::int32_t cell = 0;

    PL_HD bool is_trained() const { return volume != kNoVolume; }
};

struct TableField : TableView {
    using Location = TableLocation;
    using Entry = TableEntry;

    PL_HD Location locate(const SurfacePoint& surface) const {
        const FoundVolume found = find(surface);
        return {found.volume, found.node};
    }
    PL_HD Vec3f sample(const Location& location, const SurfacePoint& surface, const ScatterUniforms& uniforms) const {
        const Real2<One> u{uniforms.u.y, uniforms.u.z};
        const TableSampler tables = sampler();
        const std::int32_t row = sample_row(tables.tables_of<One>(location.volume), u.y);
        return pack(tables.sample<One>(served_point(location, surface), row, u));
    }
    PL_HD FieldDensity density(const Location& location, const SurfacePoint& surface, Vec3f wi) const {
        const TableSampler tables = sampler();
        const TableDirection<One> direction = tables.locate(served_point(location, surface), unpack(wi));
        const TableDensity<One> density = tables.density(location.volume, direction);
        return {density.pdf_sa, density.cell};
    }
    PL_HD float bsdf_fraction_at(const Location& location) const {
        const auto index = static_cast<std::uint32_t>(location.volume);
        return has_records() ? record_of(index).bsdf_fraction : bsdf_fraction[index];
    }
    PL_HD float value_at(const Location& location) const {
        return mean_radiance_of(static_cast<std::uint32_t>(location.volume));
    }
    PL_HD float direct_at(const Location& location) const {
        const auto index = static_cast<std::uint32_t>(location.volume);
        return has_records() ? record_of(index).direct : direct[index];
    }
    PL_HD float radiance_at(const Location& location, std::int32_t cell) const {
        if (cell < 0) return value_at(location);
        const std::uint32_t index = cell_index(location.volume, cell);
        return visits[index] == 0 ? value_at(location) : learned_radiance(*this, index);
    }

    /// The cell of a direction; -1 below the horizon of the volume.
    PL_HD std::int32_t cell_of(const Location& location, const SurfacePoint& surface, Vec3f wi) const {
        const TableDirection<One> direction = sampler().locate(served_point(location, surface), unpack(wi));
        return direction.cosine > 0.0f ? cells.cell_of(direction.square) : -1;
    }
    PL_HD Entry entry_of(const Location& location, const DirectionSample& direction) const {
        if (direction.bin < 0) return {};
        return {location.volume, direction.bin};
    }
    PL_HD void record(const TrainingSample<TableField>& sample, bool learns_fraction) const {
        pl::record(*this, sample.entry.volume, sample.entry.cell, sample.target);
        record_light(sample, learns_fraction);
    }
    PL_HD void add(const TrainingSample<TableField>& sample, bool learns_fraction) const {
        const std::uint32_t index = cell_index(sample.entry.volume, sample.entry.cell);
        atomic_add(pending_sum[index], to_fixed_point(sample.target, radiance_unit), writers);
        record_light(sample, learns_fraction);
    }
    PL_HD LearnedLights lights_at(const Location& location) const { return lights_of_volume(*this, location.volume); }
    PL_HD void record_light(const LightSample<TableField>& light) const { record_at_volume(*this, light); }
    PL_HD bool is_clamped(float target) const { return pl::is_clamped(target, radiance_unit); }

    /// The field must have volumes.
    PL_HD TableSampler sampler() const {
        return {.cells = cells, .row_cdf = row_cdf.data, .column_cdf = column_cdf.data};
    }
    PL_HD ServedPoint<One> served_point(const Location& location, const SurfacePoint& surface) const {
        const auto index = static_cast<std::uint32_t>(location.volume);
        if (has_records()) {
            const VolumeRecord record = record_of(index);
            return {location.volume, unpack(record.position), unpack(record.normal), record.inverse_reach,
                    unpack(surface.position)};
        }
        return {location.volume, unpack(sites[index].position), unpack(normals[index]), inverse_reach[index],
                unpack(surface.position)};
    }

private:
    /// Trains the BSDF fraction and the reach.
    PL_HD void record_light(const TrainingSample<TableField>& sample, bool learns_fraction) const {
        const std::int32_t volume = sample.entry.volume;
        const float weight = light_weight(*this, volume, sample.bsdf_ratio, sample.target);
        record_reach(*this, volume, weight, sample.distance);
        if (learns_fraction) record_mixture(*this, static_cast<std::uint32_t>(volume), sample.bsdf_ratio, weight);
    }
};
static_assert(RadianceField<TableField>);

}  // namespace pl
