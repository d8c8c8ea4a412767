// The learned field of one method, taken out of a session: the content of files.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/fields/refine_placement.h"
#include "core/scene/description.h"
#include "core/session/methods.h"

namespace pl {

/// Progress of a method's learning. Exact: interrupted work continues where it stopped.
struct FieldProgress {
    std::uint64_t passes = 0;  ///< of the method, unguided ones included: each has random numbers of its own
    std::uint64_t untrained_passes =
        0;  ///< passes since the field was made or loaded that were not guided or made no training samples
    std::uint64_t updates = 0;          ///< changes of the tables by which later paths are sampled
    std::uint64_t records = 0;          ///< training samples
    std::uint64_t clamped_records = 0;  ///< of them
    std::uint64_t lookup_misses = 0;
    std::uint32_t precomputed_slices = 0;  ///< complete ones
    std::uint32_t next_probe = 0;          ///< of the running slice
    double precompute_seconds = 0.0;
    bool is_well_trained = false;  ///< had enough training samples per volume at the last update, see is_trained_by()
    bool has_part = false;         ///< the field was updated within a pass that is incomplete
    std::vector<std::int32_t> forgotten{};  ///< volumes that begin anew before the next pass
    bool was_edited =
        false;  ///< was stepped, continued after a freeze, or has forgotten volumes: no command line repeats it

    /// The progress for a picture that does not continue that pass: it skips the pass's random numbers, because paths
    /// would sample densities that were trained by the same numbers, a bias.
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
    HostField field;
    FieldProgress progress;
};

/// The representation of a method's field by these settings: probes fill tables only.
inline Representation representation_of(const FieldSettings& settings, MethodId method) {
    return info_of(method).learns ? settings.representation : Representation::Table;
}

/// Throws Error(Input) if the field was learned in another scene.
void require_learned_in(const std::string& scene_hash, const LearnedField& field);

/// "reinforcement, 1000 volumes, 256 directions, 12 passes, 34567 records"; of an SD-tree its leaves and nodes in place of directions.
std::string summary_of(const LearnedField& field);

}  // namespace pl
