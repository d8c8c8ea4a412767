// What one method has learned, taken out of a session: what files hold and what moves between back ends.
#pragma once

#include <memory>
#include <string>

#include "core/fields/refine_placement.h"
#include "core/scene/description.h"
#include "core/session/methods.h"

namespace pl {

/// How far a method's learning has come. Exact: work that was interrupted goes on where it ended.
struct FieldProgress {
    std::uint64_t passes = 0;  ///< that were learned from
    std::uint64_t records = 0;
    std::uint64_t clamped_records = 0;  ///< of them
    std::uint64_t lookup_misses = 0;
    std::uint32_t precomputed_slices = 0;  ///< complete ones
    std::uint32_t next_probe = 0;          ///< where the running slice goes on
    double precompute_seconds = 0.0;
    bool has_part = false;  ///< tables hold a part of a pass that is not complete, and its random numbers are used up

    /// As it is for a picture that does not go on with that pass: numbers that tables were learned from are not drawn again,
    /// because paths would meet what they taught, and weigh it too low.
    FieldProgress without_part() const {
        FieldProgress progress = *this;
        progress.passes += has_part ? 1u : 0u;
        progress.has_part = false;
        return progress;
    }

    friend bool operator==(const FieldProgress&, const FieldProgress&) = default;
};

struct LearnedField {
    MethodId method = MethodId::Reinforcement;
    std::string scene_hash;  ///< of the scene it was learned in
    FieldSettings settings;
    FieldShape shape;
    std::shared_ptr<const HostVolumes> volumes;
    Refinement refinement{};  ///< of the volumes
    HostTables tables;
    FieldProgress progress;
};

/// Throws Error(Input) if the field was learned in another scene.
void require_learned_in(const SceneDescription& scene, const LearnedField& field);

/// Adapts a field of an earlier run to this one: clocks start at zero, and the lookup is that of `settings`.
void fit_to_run(LearnedField& field, const FieldSettings& settings);

/// "reinforcement, 1000 volumes, 256 directions, 12 passes, 34567 records"
std::string summary_of(const LearnedField& field);

}  // namespace pl
