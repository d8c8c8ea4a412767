// Immutable copies of what a session has produced: what display, saving and inspection read.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/session/backend.h"
#include "core/session/settings.h"

namespace pl {

/// Seconds by what they were spent on. Waiting, display and saving are in none of them.
struct Clocks {
    double load = 0.0;        ///< reading and checking files; set by whoever loads
    double build = 0.0;       ///< packing the scene, building the hierarchy
    double upload = 0.0;      ///< sending the scene to a back end; in a switch of back ends, also what was learned
    double place = 0.0;       ///< placing volumes, building their tree, sending both; 0 where nothing uses them
    double precompute = 0.0;  ///< filling the precomputed radiance map
    double learn = 0.0;       ///< publishing learned tables
    double render = 0.0;      ///< passes, including the records they make

    double total() const { return load + build + upload + place + precompute + learn + render; }
};

/// How a picture began: what tells one run of a method from the next.
struct FilmOrigin {
    std::uint64_t number = 0;      ///< of one session, counting up; 0 before the first piece of work
    std::uint64_t generation = 0;  ///< grows when all pictures are emptied
    bool warm = false;             ///< its method had learned something before the first sample
    double place_seconds = 0.0;    ///< of the clocks, what had been spent before
    double precompute_seconds = 0.0;
    FeatureSet forced{};  ///< effects that any of its passes was forced to be able to do: they cost time
};

/// What is known about the learned field of the session's method.
struct FieldStatus {
    int volumes = 0;
    int added_volumes = 0;  ///< of these, by refining
    int bins = 0;
    std::size_t bytes = 0;
    std::uint64_t passes = 0;  ///< publications
    std::uint64_t records = 0;
    std::uint64_t clamped_records = 0;
    std::uint64_t lookup_misses = 0;
    double precomputed_share = 0.0;  ///< of the radiance map, in [0, 1]; 1 for methods that need none
};

struct Snapshot {
    FilmSlot slot;
    int width = 0;
    int height = 0;
    std::vector<Vec3f> pixels;  ///< mean radiance or view values, linear; row 0 at the top
    FilmHalves halves{};        ///< only of Session::snapshot_with_halves()
    std::uint32_t passes = 0;   ///< samples per pixel
    PassCounters counters;      ///< of this film
    /// Closed surfaces surround the camera, so that paths that escaped were lost. Known once one has (in
    /// large scenes after the first pass); false before, and where there is light from far away.
    bool is_closed = false;
    Clocks clocks;
    std::optional<FieldStatus> field;
    int bins = 0;  ///< directions per volume; 0 before volumes are placed
    CameraDescription camera;
    std::string kernel;
};

/// The hemisphere that a method learned at one volume.
struct VolumeInspection {
    std::int32_t volume = kNoVolume;
    Vec3f position{0.0f};
    Vec3f normal{0.0f, 0.0f, 1.0f};
    int side = 0;                    ///< cells are side x side, DirectionCells layout
    std::vector<float> radiance;     ///< learned incident radiance Q, luminance
    std::vector<float> probability;  ///< of sampling the cell from the table
    std::vector<std::uint32_t> visits;
    float mean_radiance = 0.0f;  ///< irradiance / pi
};

/// The first surface under a pixel.
struct PickedPoint {
    Vec3f position{0.0f};
    Vec3f normal{0.0f, 0.0f, 1.0f};  ///< geometric, towards the camera
    std::uint32_t primitive = kNoPrimitive;
    std::uint32_t material = 0;
    float distance = 0.0f;
    std::int32_t volume = kNoVolume;
};

}  // namespace pl
