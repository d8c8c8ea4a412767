// The changes to a running session, and the one table of the parts that each of them clears.
#pragma once

#include <memory>
#include <variant>

#include "core/session/settings.h"

namespace pl {

class RenderBackend;
struct LearnedField;

struct EditCamera {
    CameraDescription camera;
};
struct EditSize {
    int width;
    int height;
};
struct EditSeed {
    std::uint64_t seed;
};
struct EditEstimator {
    int max_depth;
    bool next_event;
    RouletteRule roulette = RouletteRule::Spare;
    GuidingRule guiding = GuidingRule::Paying;
};  ///< length, light sampling, roulette and guiding of paths
struct EditMixture {
    MixtureSettings mixture;
};
struct EditField {
    FieldSettings field;
};  ///< number of volumes, bins, rates
struct EditScene {
    std::shared_ptr<const SceneDescription> scene;
};
/// Replaces one material as a whole. The hierarchy stays. Clears the placement, too, if volumes would move: see
/// same_placement().
struct EditMaterial {
    std::uint32_t index;
    MaterialDescription material;
};
/// Effects that kernels have to cover, needed or not. Changes no picture.
struct EditEffects {
    FeatureSet forced;
};
/// Another back end continues with the learned fields. The films of the old one are parked with it, for its return.
struct EditBackend {
    std::shared_ptr<RenderBackend> backend;
    bool abandon_old = false;  ///< the old one is broken: its tables are lost
    bool forget_old = false;   ///< the old one has failed: its tables move, but it is not parked
};
struct EditRestart {};  ///< clear the films, keep the fields
struct EditForget {};   ///< clear films and fields
/// Continues from a field learned in another session. Clears the tables of other methods and replaces the volumes.
struct EditLearned {
    std::shared_ptr<const LearnedField> field;
};

using SessionEdit = std::variant<EditCamera, EditSize, EditSeed, EditEstimator, EditMixture, EditField, EditScene,
                                 EditMaterial, EditEffects, EditBackend, EditRestart, EditForget, EditLearned>;

/// The parts of a session that an edit clears. Display settings clear nothing: they are no part of a session.
struct Invalidation {
    bool films = false;    ///< all films
    bool tables = false;   ///< the learned tables of all methods
    bool volumes = false;  ///< placement of the volumes
    bool scene = false;    ///< packed scene and hierarchy

    friend bool operator==(const Invalidation&, const Invalidation&) = default;
};

Invalidation invalidated_by(const SessionEdit& edit);

}  // namespace pl
