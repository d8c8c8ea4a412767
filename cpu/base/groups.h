// The operands of the lane kernels: paths, their vertices, volumes and light samples in groups of 16, as structures of arrays, and what
// kernels read of scenes and fields, as plain pointers. Paths keep their lanes from vertex to vertex, so that each step reads and writes
// whole vectors.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "core/kernel/base/math.h"
#include "core/kernel/film/vertex_sequence.h"
#include "core/kernel/guiding/table_field.h"
#include "core/kernel/guiding/vertex_network.h"
#include "core/kernel/integrator/steps.h"
#include "core/kernel/scene/instances.h"
#include "core/kernel/shading/lights.h"
#include "cpu/base/ray_batch.h"

namespace pl {

/// The arguments of Rng::draw, and of vertex_uniforms(), that a batch has in common.
struct DrawKey {
    std::uint64_t seed = 0;
    Stream stream = Stream::Picture;
    Purpose purpose = Purpose::Scatter;
    VertexSequences sequences{};
};

/// The remaining arguments of Rng::draw, per lane.
struct alignas(64) CounterGroup {
    std::uint32_t pixel[kGroupSize] = {}, sample[kGroupSize] = {}, vertex[kGroupSize] = {};
};

/// Four uniform numbers in [0, 1) per lane.
struct alignas(64) UniformGroup {
    float rows[4][kGroupSize] = {};

    Vec4f get(std::uint32_t lane) const { return {rows[0][lane], rows[1][lane], rows[2][lane], rows[3][lane]}; }
};

/// 16 vectors as a structure of arrays.
struct alignas(64) VectorGroup {
    float x[kGroupSize] = {}, y[kGroupSize] = {}, z[kGroupSize] = {};

    void set(std::uint32_t lane, Vec3f v) {
        x[lane] = v.x;
        y[lane] = v.y;
        z[lane] = v.z;
    }
    Vec3f get(std::uint32_t lane) const { return {x[lane], y[lane], z[lane]}; }
};

/// 16 vertices of paths at Lambert reflectors, with the random numbers of each.
struct alignas(64) VertexGroup {
    VectorGroup position, geometric_normal, shading_normal;
    float position_error[kGroupSize] = {};
    std::uint32_t primitive[kGroupSize] = {};
    VectorGroup albedo;
    VectorGroup throughput;  ///< of the path before the roulette at the vertex
    VectorGroup scatter;     ///< x, y, z of ScatterUniforms::u
    UniformGroup light;      ///< VertexUniforms::light
};

/// A scene and the volumes placed in it, as plain pointers; without volumes only the first three members are needed.
struct PlacementRows {
    const Triangle* triangles = nullptr;
    const TrianglePlane* planes = nullptr;
    const Vec3f* positions = nullptr;
    const Material* materials = nullptr;
    std::uint32_t sided_triangles = 0;   ///< triangles with sides in the grid
    const VolumePlace* sides = nullptr;  ///< members as in VolumeGridView
    const SideGrid* grids = nullptr;
    const VolumeCell* cells = nullptr;
    const KdNode* nodes = nullptr;
};

/// Whether the lanes may look up surface points: a single position makes no triangle that a ray could hit.
inline bool has_surfaces(const SceneView& scene) { return !scene.triangles.empty() && scene.positions.count > 1; }

/// The surface points at the hits of 16 rays, and the places of their volumes. Lanes of rays that miss are arbitrary.
struct alignas(64) PointGroup {
    VectorGroup position, geometric_normal;
    float position_error[kGroupSize] = {};
    std::uint32_t material[kGroupSize] = {};
    std::int32_t front[kGroupSize] = {};                           ///< 0: the back is seen
    VolumePlace place[kGroupSize];                                 ///< VolumeGridView::place_of()
    std::uint32_t nodes[VolumeCell::kMostNodes][kGroupSize] = {};  ///< of the cell at the place
    std::int32_t volume[kGroupSize] = {};                          ///< the nearest of the nodes' volumes
    std::uint32_t node[kGroupSize] = {};                           ///< and its node
    std::uint32_t wanted = 0;                                      ///< one bit per lane: its volume is looked up
    std::uint32_t cells = 0;  ///< one bit per lane in `wanted`: its place is a cell, once that is read one with nodes

    /// All but the place, which a lookup finds.
    void set(std::uint32_t lane, const SurfacePoint& point) {
        position.set(lane, point.position);
        geometric_normal.set(lane, point.geometric_normal);
        position_error[lane] = point.position_error;
        material[lane] = point.material;
        front[lane] = point.front ? 1 : 0;
    }
};

/// The volumes of a VertexGroup for a method guided by tables. Lanes that were never set have no volume.
struct alignas(64) GuidedGroup {
    std::int32_t volume[kGroupSize];
    VectorGroup site, volume_normal;
    float inverse_reach[kGroupSize] = {}, bsdf_fraction[kGroupSize] = {};

    GuidedGroup() { std::fill_n(volume, kGroupSize, kNoVolume); }

    void set_volume(std::uint32_t lane, const ServedPoint<One>& point, float fraction) {
        volume[lane] = point.volume;
        site.set(lane, pack(point.site));
        volume_normal.set(lane, pack(point.normal));
        inverse_reach[lane] = point.inverse_reach;
        bsdf_fraction[lane] = fraction;
    }
};

/// Intermediate results of a GuidedGroup, before the evaluation of pdfs.
struct alignas(64) SampledGroup {
    std::int32_t row[kGroupSize];  ///< of the table, per lane
    VectorGroup direction;
    float square_x[kGroupSize], square_y[kGroupSize], cosine[kGroupSize], jacobian[kGroupSize];  ///< TableDirection
};

/// Sampled directions of a VertexGroup; members as in DirectionSample.
struct alignas(64) DirectionGroup {
    VectorGroup wi;
    float pdf_sa[kGroupSize] = {}, bsdf_pdf_sa[kGroupSize] = {};
    std::int32_t bin[kGroupSize] = {};

    DirectionSample get(std::uint32_t lane) const {
        return {wi.get(lane), pdf_sa[lane], bsdf_pdf_sa[lane], bin[lane]};
    }
    void set(std::uint32_t lane, const DirectionSample& sample) {
        wi.set(lane, sample.wi);
        pdf_sa[lane] = sample.pdf_sa;
        bsdf_pdf_sa[lane] = sample.bsdf_pdf_sa;
        bin[lane] = sample.bin;
    }
};

/// An emissive triangle with all that a light sample on it needs, next to each other.
struct LightRecord {
    Vec3f corners[3];
    Vec3f normal{0.0f};  ///< TrianglePlane::normal, position_error
    float position_error = 0.0f;
    Vec3f emission{0.0f};         ///< emitted_radiance() of the front
    Vec3f back_emission{0.0f};    ///< and of the back
    std::uint32_t primitive = 0;  ///< Light::primitive, cumulative_probability
    float cumulative_probability = 0.0f;
};

/// The lights of a scene as plain pointers.
struct LightRows {
    const LightRecord* lights;
    std::uint32_t count;
    float power;  ///< SceneView::light_power
};

/// The far lights of a scene.
struct FarRows {
    const FarLights* lights;
    float probability;  ///< SceneView::far_probability
};

/// Samples of far lights, one for each of a VertexGroup: members as in FarSample. Only of groups in which a lane chooses far lights.
struct alignas(64) FarSampleGroup {
    VectorGroup wi, radiance;
    float pdf_sa[kGroupSize] = {};

    FarSample get(std::uint32_t lane) const { return {wi.get(lane), radiance.get(lane), pdf_sa[lane]}; }
};

/// A light tree as plain pointers, and the choices among its clusters that were learned.
struct LightTreeRows {
    const LightNode* nodes;
    const LightPlace* of_light;
    const std::uint32_t* clusters;
    std::uint32_t cluster_count;
    const float* learned;  ///< LearnedLights::cdf of all points, one after the other; null: nothing is learned
};

/// For each of 16 points the first number of its LearnedLights::cdf in LightTreeRows::learned.
struct alignas(64) LearnedLightsGroup {
    static constexpr std::int32_t kNone = -1;  ///< nothing is learned

    std::int32_t first[kGroupSize];

    LearnedLightsGroup() { std::fill_n(first, kGroupSize, kNone); }

    /// `all`: LightTreeRows::learned.
    void set(std::uint32_t lane, LearnedLights learned, const float* all) {
        first[lane] = learned.empty() ? kNone : static_cast<std::int32_t>(learned.cdf - all);
    }
};

/// 16 lights of a tree that paths have hit.
struct alignas(64) LightHitGroup {
    VectorGroup from;  ///< the origins of the segments that end there
    std::uint32_t light[kGroupSize] = {};
    LearnedLightsGroup learned;       ///< of the origins
    float pdf_area[kGroupSize] = {};  ///< the result: see light_pdf_area()
};

/// One light sample for each vertex of a VertexGroup: the chosen light, the point on it, and the weight of the sample.
struct alignas(64) LightSampleGroup {
    std::uint32_t light[kGroupSize] = {};  ///< index of the light that the light tree chose
    float pdf_area[kGroupSize] = {};  ///< density of choosing it and the point on it, per area; set by the light tree
    std::uint32_t cluster[kGroupSize] = {};   ///< cluster of the light, see LightTree
    std::int32_t is_behind[kGroupSize] = {};  ///< not 0: its back is seen
    VectorGroup weights;                      ///< barycentric, on the light
    float seen_pdf_sa[kGroupSize] = {};       ///< whichever side of the vertex the light is on; of emissive triangles
    float cos_i[kGroupSize] = {};             ///< this and the next: at Lambert reflectors
    float pdf_sa[kGroupSize] = {};            ///< 0: nothing can be reflected
    VectorGroup wi, emitted;
    std::uint32_t target[kGroupSize] = {};  ///< the light's primitive; kNoPrimitive: a far light
    VectorGroup origin, direction;          ///< of the shadow ray
    float weight[kGroupSize] = {};          ///< the MIS weight over pdf_sa
    VectorGroup reflected;                  ///< f cos times emitted
    VectorGroup contribution;               ///< ShadowRequest::contribution
    float irradiance[kGroupSize] = {};      ///< LightEstimate::irradiance
};

/// 16 paths between the steps of the integrator, besides their rays and the counters of their random numbers: members as in PathState.
struct alignas(64) PathGroup {
    VectorGroup throughput, radiance;
    float direction_pdf_sa[kGroupSize] = {}, survival[kGroupSize] = {};
    std::uint32_t vertices[kGroupSize] = {};
    std::uint32_t specular[kGroupSize] = {};  ///< PathState::specular_vertices
    VectorGroup weight;                       ///< f cos / pdf at the last vertex
    float roulette_weight[kGroupSize] = {};   ///< 1 / survival probability of the roulette there

    /// The path of `lane`, between two vertices, continues in `place` of `to`.
    void move(std::uint32_t lane, PathGroup& to, std::uint32_t place) const {
        to.throughput.set(place, throughput.get(lane));
        to.radiance.set(place, radiance.get(lane));
        to.direction_pdf_sa[place] = direction_pdf_sa[lane];
        to.survival[place] = survival[lane];
        to.vertices[place] = vertices[lane];
        to.specular[place] = specular[lane];
    }
};

/// Calls visit(i) for every bit i that is set.
inline void for_bits(std::uint64_t bits, const auto& visit) {
    for (; bits != 0; bits &= bits - 1) visit(static_cast<std::uint32_t>(std::countr_zero(bits)));
}
/// The lowest `count` bits, at most 64.
inline std::uint64_t first_bits(std::uint32_t count) {
    return count < 64 ? (std::uint64_t{1} << count) - 1 : ~std::uint64_t{0};
}

/// One bit per path of a block: lane i of group g is bit 16 g + i.
struct BlockBits {
    std::uint16_t groups[kBlockGroups] = {};

    std::uint64_t bits() const {
        std::uint64_t all = 0;
        for (std::uint32_t group = 0; group < kBlockGroups; ++group)
            all |= std::uint64_t{groups[group]} << (group * kGroupSize);
        return all;
    }
    void set(std::uint64_t bits) {
        for (std::uint32_t group = 0; group < kBlockGroups; ++group)
            groups[group] = static_cast<std::uint16_t>(bits >> (group * kGroupSize));
    }
};

/// The ends of the segments of a block's paths.
struct SegmentMarks {
    BlockBits hit;         ///< a surface
    BlockBits emits;       ///< which emits light towards the path, if it is one
    BlockBits scatters;    ///< and which reflects
    BlockBits is_deepest;  ///< the vertex is the last one that the settings allow
};

/// The surfaces of a scene as plain pointers, as Lambert reflectors without images.
struct SurfaceRows {
    const Material* materials;
    const TrianglePlane* planes;
    const TriangleNormals*
        triangle_normals;  ///< [primitive], indices into `normals`; null: shading normals are the geometric ones
    const Vec3f* normals;
};

/// Primitives of instances have no entry in the arrays of the scene.
template <FeatureSet F>
bool shows_instances(const SceneView& scene) {
    return F.has(Feature::Instances) && !scene.instances.empty();
}

template <FeatureSet F>
SurfaceRows surface_rows(const SceneView& scene) {
    const bool is_smooth =
        F.has(Feature::SmoothNormals) && !scene.triangle_normals.empty() && !shows_instances<F>(scene);
    return {.materials = scene.materials.data,
            .planes = scene.planes.data,
            .triangle_normals = is_smooth ? scene.triangle_normals.data : nullptr,
            .normals = scene.normals.data};
}

/// Rows of a block of paths. Groups of arrays have one entry per group.
struct BlockRows {
    const HitGroup* hits;
    PointGroup* points;  ///< at the hits
    const UniformGroup* scatter;
    const UniformGroup* light;  ///< null: lights are not sampled
    CounterGroup* counters;
    PathGroup* paths;
    VertexGroup* vertices;
    std::uint32_t groups;
};

/// A field of tables as plain pointers, of at least one volume.
struct VolumeRows {
    const KdNode* nodes;
    const float* mean_radiance;  ///< this and the next three: [volume]
    const float* direct;
    const float* inverse_reach;
    const float* bsdf_fraction;  ///< null: it is `fraction` everywhere
    float fraction;
    const float* row_cdf;
    std::int32_t side;  ///< of a table
};

/// Values of the volumes of 16 vertices; 0 at vertices without one.
struct alignas(64) ValueGroup {
    float value[kGroupSize] = {}, direct[kGroupSize] = {};  ///< value_at() and direct_at() of the field
};

/// The method's part of 16 paths: members as in OpenSample, and Guided::Expectation.
struct alignas(64) OpenGroup {
    std::int32_t volume[kGroupSize], cell[kGroupSize] = {};
    float bsdf_ratio[kGroupSize] = {};
    float first[kGroupSize] = {};

    OpenGroup() { std::fill_n(volume, kGroupSize, kNoVolume); }

    void start(std::uint32_t lane) {
        volume[lane] = kNoVolume;
        first[lane] = 0.0f;
    }
    void set(std::uint32_t lane, const OpenSample<TableField>& sample) {
        volume[lane] = sample.entry.volume;
        cell[lane] = sample.entry.cell;
        bsdf_ratio[lane] = sample.bsdf_ratio;
    }
    void move(std::uint32_t lane, OpenGroup& to, std::uint32_t place) const {
        to.volume[place] = volume[lane];
        to.cell[place] = cell[lane];
        to.bsdf_ratio[place] = bsdf_ratio[lane];
        to.first[place] = first[lane];
    }
};

/// Numbers per path of a block.
struct alignas(64) BlockFloats {
    float of[kPathBlock];
};

/// Rows of a block whose paths learn. `served`: the vertices that have a volume.
struct LearningRows {
    BlockRows block;
    BlockBits served;
    GuidedGroup* guided;
    ValueGroup* values;
    OpenGroup* open;
};

/// c = a b, or c + a b if it `adds`, each element summed in ascending order of the inner index. Element (row, i) of `a` is
/// a[row * a_row + i * a_inner]; rows of `b` and `c` lie `b_row` and `c_row` apart. `rows` is a multiple of 4, `columns` one of
/// kColumnBlock.
struct MatrixProduct {
    const float* a;
    std::size_t a_row, a_inner;
    const float* b;
    std::size_t b_row;
    float* c;
    std::size_t c_row;
    std::uint32_t rows, inner, columns;
    bool adds;
};

/// The light of one volume in directions of its cells, and the mixture that learns it. Component k has the density exp(offset_k + axis_k
/// w) over directions w, not normalized. Arrays of directions: [column]; directions behind the cells have no
/// probability.
struct MixtureLight {
    const float* probability;  ///< of the light; the sum is 1
    const float *x, *y, *z;    ///< of unit directions
    float offset[kVertexLobes];
    float axis[3][kVertexLobes];
    std::uint32_t columns;
};

/// Expectations over the light: of the responsibility of each component, and of the responsibility times the
/// direction.
struct MixtureShares {
    float weight[kVertexLobes];
    float direction[3][kVertexLobes];
};

/// Shares of the old in the running means of slopes and their squares.
inline constexpr float kMeanShare = 0.9f;
inline constexpr float kSquareShare = 0.99f;

/// One step of Adam.   [Kingma and Ba 2015]
struct DescentStep {
    float* weights;
    float* slope_mean;
    float* slope_square;
    const float* slopes;
    std::size_t count;
    float rate;          ///< with the correction of both means for their start at 0
    float square_scale;  ///< of the square's
};

}  // namespace pl
