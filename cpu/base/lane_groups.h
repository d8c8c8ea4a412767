// The operands of the lane kernels: rays, paths and their vertices in groups of 16, as structures of arrays, and scenes as plain
// pointers.
#pragma once

#include <algorithm>
#include <cstdint>

#include "core/kernel/base/math.h"
#include "core/kernel/film/vertex_sequence.h"
#include "core/kernel/guiding/table_field.h"
#include "core/kernel/scene/instances.h"
#include "core/kernel/shading/lights.h"
#include "cpu/base/ray_batch.h"
#include "cpu/rays/wide_hierarchy.h"

namespace pl {

inline constexpr std::uint32_t kMaxDenseTriangles = 64;
inline constexpr std::uint32_t kMaxDensePositions = 3 * kMaxDenseTriangles;

struct DenseTriangle {
    std::uint32_t a, b, c;    ///< indices into DenseView::positions
    std::uint32_t primitive;  ///< index of the triangle in the scene
};

/// A small scene as plain pointers: files compiled for one instruction set must not instantiate inline functions of
/// containers, which the linker would merge with those of other files.
struct DenseView {
    const Vec3f* positions;  ///< without duplicates
    std::uint32_t position_count;
    const DenseTriangle* triangles;  ///< in ascending order of primitive
    std::uint32_t triangle_count;
};

/// A scene and its wide hierarchy as plain pointers.
struct WideView {
    BvhNode root;           ///< the bounds of the scene
    const WideNode* nodes;  ///< at least one
    const BvhTriangle* triangles;
    const LeafBlock* blocks;  ///< nullptr: the scene exceeds the caches, and leaves are its triangles
};

/// The instances of a scene and their wide hierarchies as plain pointers.
struct WideInstances {
    BvhNode root;           ///< the bounds of all
    const WideNode* nodes;  ///< over `order`, at least one; an instance to a leaf
    const std::uint32_t* order;
    const Instance* list;
    const BvhNode* mesh_bounds;  ///< [Instance::root]
    const std::uint32_t* roots;  ///< [instance]: of its mesh, in mesh_nodes
    const WideNode* mesh_nodes;
    const BvhTriangle* mesh_triangles;
};

/// The arguments of Rng::draw, and of vertex_numbers(), that a batch has in common.
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
struct alignas(64) NumberGroup {
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
    VectorGroup scatter;     ///< x, y, z of ScatterNumbers::u
    NumberGroup light;       ///< VertexNumbers::light
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

/// The paths of a VertexGroup, scattered into sampled directions.
struct alignas(64) ScatteredGroup {
    std::int32_t is_lit[kGroupSize] = {};  ///< 0: f cos is 0 in the direction, or its density is
    VectorGroup weight;                    ///< f cos / pdf
    VectorGroup origin;                    ///< of the ray in the direction
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

/// A light sample for each of a VertexGroup: members as in ChosenLight, LightPoint and DirectLight, and the results of weighing it.
struct alignas(64) LightSampleGroup {
    std::uint32_t light[kGroupSize] = {};  ///< this and the next two: by a tree
    float pdf_area[kGroupSize] = {};
    std::uint32_t cluster[kGroupSize] = {};
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

}  // namespace pl
