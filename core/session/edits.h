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
/// Replaces one material as a whole. The hierarchy stays. Also clears the placement if volumes would move: see
/// same_placement().
struct EditMaterial {
    std::uint32_t index;
    MaterialDescription material;
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

/// Of a method that learns, between passes.
enum class LearningControl {
    Freeze,    ///< the field stays as it is after the pass under way; sampling goes on
    Step,      ///< one more pass trains it, with its update
    Continue,  ///< every pass trains it again
};
struct EditLearning {
    MethodId method;
    LearningControl control;
};
/// One volume of a method that learns begins anew. The film stays: its passes are unbiased with any field.
struct EditForgetVolume {
    MethodId method;
    std::int32_t volume;
};

using SessionEdit =
    std::variant<EditCamera, EditSize, EditSeed, EditEstimator, EditMixture, EditField, EditScene, EditMaterial,
                 EditBackend, EditRestart, EditForget, EditLearned, EditLearning, EditForgetVolume>;

/// The parts of a session that an edit clears. Display settings clear nothing: they are no part of a session.
struct Invalidation {
    bool films = false;    ///< all films
    bool tables = false;   ///< the learned tables of all methods
    bool volumes = false;  ///< placement of the volumes
    bool scene = false;    ///< packed scene and hierarchy

    friend bool operator==(const Invalidation&, const Invalidation&) = default;
};

/// Copies the new values of an edit, if it has any, into the settings. Returns the parts that it clears.
Invalidation take_over(const SessionEdit& edit, RenderSettings& settings);

}  // namespace pl
