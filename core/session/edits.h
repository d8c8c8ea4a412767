// What a person may change while a session runs, and the one table that says what each change clears.
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
struct EditMethod {
    MethodId method;
};
struct EditView {
    View view;
};
struct EditSeed {
    std::uint64_t seed;
};
struct EditEstimator {
    int max_depth;
    bool next_event;
    RouletteRule roulette = RouletteRule::Spare;
};  ///< what paths may do
struct EditMixture {
    MixtureSettings mixture;
};
struct EditField {
    FieldSettings field;
};  ///< number of volumes, bins, rates
struct EditScene {
    std::shared_ptr<const SceneDescription> scene;
};
/// Another material in the place of one, as a whole. The hierarchy stays. Volumes that it moves are placed anew: then this
/// clears them too, see same_placement().
struct EditMaterial {
    std::uint32_t index;
    MaterialDescription material;
};
/// Effects that kernels must be able to do, needed or not: no picture changes by it.
struct EditEffects {
    FeatureSet forced;
};
/// Another back end goes on with what was learned. The pictures of the old one are parked with it, for the way back.
struct EditBackend {
    std::shared_ptr<RenderBackend> backend;
    bool abandon_old = false;  ///< the old one is broken: what it held is lost
    bool forget_old = false;   ///< the old one has failed: what it learned moves, but it is not kept for the way back
};
struct EditRestart {};  ///< clear the pictures, keep what was learned
struct EditForget {};   ///< clear the pictures and what was learned
/// Go on from what was learned elsewhere, with its method. It empties the tables of the others and replaces the volumes.
struct EditLearned {
    std::shared_ptr<const LearnedField> field;
};

using SessionEdit =
    std::variant<EditCamera, EditSize, EditMethod, EditView, EditSeed, EditEstimator, EditMixture, EditField,
                 EditScene, EditMaterial, EditEffects, EditBackend, EditRestart, EditForget, EditLearned>;

/// What has to go when an edit is applied. Display settings are not here: they are no part of a session.
struct Invalidation {
    bool films = false;    ///< all accumulated pictures
    bool tables = false;   ///< everything learned
    bool volumes = false;  ///< placement of the volumes
    bool scene = false;    ///< packed scene and hierarchy

    friend bool operator==(const Invalidation&, const Invalidation&) = default;
};

Invalidation invalidated_by(const SessionEdit& edit);

}  // namespace pl
