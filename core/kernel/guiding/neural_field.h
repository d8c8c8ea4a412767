// A model of GuidingField on the host: one network, evaluated at every vertex, gives the mixture of lobes that guides there. The
// tables of the radiance volumes keep the learned radiance: they teach the network, and hold irradiance, BSDF fractions and the choice
// of lights.   [Dong et al. 2023, "Neural Parametric Mixtures for Path Guiding"]
#pragma once

#include "core/kernel/guiding/network_inputs.h"
#include "core/kernel/guiding/table_field.h"
#include "core/kernel/guiding/vertex_mixture.h"

namespace pl {

/// Tables, and the network that they teach.
struct NetworkField : TableField {
    VertexEvaluator evaluate = nullptr;  ///< of the host
    Span<const float> weights;           ///< as in network_layout.h, the running means
    Span<const std::uint32_t> counts;    ///< by NetworkCount
    Vec3f corner{0.0f};                  ///< lowest corner of the cube that the grids divide
    float edge = 1.0f;                   ///< of the cube, above 0

    /// Directions are then sampled by the cosine alone.
    PL_HD bool is_lost() const { return counts[kNetworkIsLost] != 0; }
    PL_HD NetworkPoint point_of(Vec3f position, Vec3f normal) const { return {(position - corner) / edge, normal}; }
    /// On the host.
    VertexMixture mixture_at(Vec3f position, Vec3f normal) const {
        VertexMixture mixture;
        if (is_lost()) {
            set_cosine(mixture, normal);
            return mixture;
        }
        float inputs[kInputs], outputs[kVertexColumns];
        fill_inputs(point_of(position, normal), weights.data, inputs);
        evaluate(weights.data, inputs, outputs);
        set_mixture(mixture, outputs, normal);
        return mixture;
    }
};

/// The volume that serves a vertex, and the mixture there in the frame of the world, which sampling and density share.
struct NeuralLocation : TableLocation {
    VertexMixture mixture;
};

/// Mixtures in the locations of vertices, where locate() evaluates the network.
struct MixturesInLocations {
    using Location = NeuralLocation;

    static Location locate(const NetworkField& field, const TableLocation& place, const SurfacePoint& surface) {
        return {place, field.mixture_at(surface.position, surface.shading_normal)};
    }
    static const VertexMixture& of(const Location& location) { return location.mixture; }
};

/// `Mixtures`: where the mixtures are.
template <class Mixtures>
struct NeuralFieldOf : NetworkField {
    using Location = typename Mixtures::Location;

    PL_HD Location locate(const SurfacePoint& surface) const {
        const TableLocation place = TableField::locate(surface);
        if (!place.is_served()) return {};
        return Mixtures::locate(*this, place, surface);
    }
    PL_HD Vec3f sample(const Location& location, const SurfacePoint&, const ScatterUniforms& uniforms) const {
        return Mixtures::of(location).sample({uniforms.u.y, uniforms.u.z});
    }
    /// The bin is the cell of the volume, which the direction trains.
    PL_HD FieldDensity density(const Location& location, const SurfacePoint& surface, Vec3f wi) const {
        return {Mixtures::of(location).pdf_sa(wi), cell_of(location, surface, wi)};
    }
    PL_HD void record(const TrainingSample<NeuralFieldOf>& sample, bool learns_fraction) const {
        TableField::record(of_table(sample), learns_fraction);
    }
    PL_HD void add(const TrainingSample<NeuralFieldOf>& sample, bool learns_fraction) const {
        TableField::add(of_table(sample), learns_fraction);
    }
    PL_HD void record_light(const LightSample<NeuralFieldOf>& light) const { record_at_volume(*this, light); }

private:
    static PL_HD TrainingSample<TableField> of_table(const TrainingSample<NeuralFieldOf>& sample) {
        return {{sample.entry, sample.bsdf_ratio, sample.distance}, sample.target};
    }
};
using NeuralField = NeuralFieldOf<MixturesInLocations>;
static_assert(RadianceField<NeuralField>);

}  // namespace pl
