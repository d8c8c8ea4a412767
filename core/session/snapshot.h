// Copies of a session's films, statistics and learned values, for display, files and inspection.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/fields/inspect_field.h"
#include "core/session/backend.h"
#include "core/session/settings.h"

namespace pl {

/// Seconds of each kind of work. Waiting, display and saving are in none of them.
struct Clocks {
    double load = 0.0;        ///< reading and checking files
    double build = 0.0;       ///< packing the scene, building the hierarchy
    double upload = 0.0;      ///< sending the scene to a back end; in a switch of back ends, also volumes and tables
    double place = 0.0;       ///< placing volumes, building their tree, sending both; 0 for films without volumes
    double precompute = 0.0;  ///< filling the precomputed radiance map
    double learn = 0.0;       ///< updates of learned tables
    double render = 0.0;      ///< passes, including their training samples

    double total() const { return load + build + upload + place + precompute + learn + render; }
};

/// The beginning of a film, by which runs of a method are distinguished.
struct FilmOrigin {
    std::uint64_t number = 0;      ///< see FilmNumbers; 0 before the first piece of work
    std::uint64_t generation = 0;  ///< grows when all films are emptied
    bool warm = false;             ///< its method had a learned field before the first sample
    double place_seconds = 0.0;    ///< on the clocks before the film began
    double precompute_seconds = 0.0;
};

/// Size and progress of a method's learned field.
struct FieldStatus {
    int volumes = 0;
    int added_volumes = 0;  ///< of the volumes, by refinement
    int bins = 0;
    Representation representation = Representation::Table;
    std::size_t bytes = 0;
    std::optional<NetworkStatus> network{};  ///< of a neural field; its bytes are among those above
    std::uint64_t passes = 0;                ///< that trained it
    std::uint64_t records = 0;
    std::uint64_t clamped_records = 0;
    std::uint64_t lookup_misses = 0;
    double precomputed_share = 0.0;  ///< of the radiance map, in [0, 1]; 1 for methods that need none
    bool is_frozen = false;          ///< further passes of a method that learns do not train it
    bool was_edited = false;         ///< FieldProgress::was_edited
};

/// The choice between guided passes and passes of the baseline method, see GuidingChoice.
struct GuidingStatus {
    bool pays = true;                      ///< the next passes are guided, as far as is known
    std::optional<double> variance_ratio;  ///< GuidingChoice::variance_ratio()
    double ratio_factor = 1.0;             ///< GuidingChoice::ratio_factor()
    std::uint32_t unguided_passes = 0;     ///< of the film
    double guided_share = 0.0;             ///< of the time of the film's passes; NaN before the first
};

struct Snapshot {
    FilmSlot slot;
    int width = 0;
    int height = 0;
    std::vector<Vec3f> pixels;  ///< mean radiance or view values, linear; row 0 at the top
    FilmHalves halves{};        ///< only of Session::snapshot_with_halves()
    std::uint32_t passes = 0;   ///< samples per pixel
    bool warm = false;          ///< FilmOrigin::warm
    PassCounters counters;      ///< of this film
    /// Closed surfaces surround the camera, so that paths that escaped were lost. Known once a path has escaped (in large
    /// scenes after the first pass); false before, and in scenes with light from far away.
    bool is_closed = false;
    Clocks clocks;
    std::optional<FieldStatus> field;
    std::optional<GuidingStatus> guiding;  ///< see Session::guiding_status()
    int bins = 0;                          ///< directions per volume; 0 before volumes are placed
    CameraDescription camera;
    std::string kernel;
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
