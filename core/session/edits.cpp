#include "core/session/edits.h"

namespace pl {
namespace {

/// New values, and the parts that are cleared. Edits of the scene and commands have no values.
struct Table {
    RenderSettings& settings;

    Invalidation operator()(const EditCamera& edit) const {
        settings.camera = edit.camera;
        return {.films = true};
    }
    Invalidation operator()(const EditSize& edit) const {
        settings.width = edit.width;
        settings.height = edit.height;
        return {.films = true};
    }
    Invalidation operator()(const EditSeed& edit) const {
        settings.seed = edit.seed;
        return {.films = true, .tables = true};
    }
    Invalidation operator()(const EditEstimator& edit) const {
        settings.max_depth = edit.max_depth;
        settings.next_event = edit.next_event;
        settings.roulette = edit.roulette;
        settings.guiding = edit.guiding;
        return {.films = true, .tables = true};
    }
    Invalidation operator()(const EditMixture& edit) const {
        settings.mixture = edit.mixture;
        return {.films = true};
    }
    Invalidation operator()(const EditField& edit) const {
        settings.field = edit.field;
        return {.films = true, .tables = true, .volumes = true};
    }
    Invalidation operator()(const EditScene& edit) const {
        settings.camera = edit.scene->camera;
        return {.films = true, .tables = true, .volumes = true, .scene = true};
    }
    // Volumes: cleared only if same_placement() is false, which depends on the scene and not on the edit.
    Invalidation operator()(const EditMaterial&) const { return {.films = true, .tables = true}; }
    Invalidation operator()(const EditBackend& edit) const { return {.tables = edit.abandon_old}; }
    Invalidation operator()(const EditRestart&) const { return {.films = true}; }
    Invalidation operator()(const EditForget&) const { return {.films = true, .tables = true}; }
    Invalidation operator()(const EditLearning&) const { return {}; }
    Invalidation operator()(const EditForgetVolume&) const { return {}; }
    // Replaces tables and volumes itself: clearing here would clear the new tables and volumes.
    Invalidation operator()(const EditLearned&) const { return {.films = true}; }
};

}  // namespace

Invalidation take_over(const SessionEdit& edit, RenderSettings& settings) {
    return std::visit(Table{settings}, edit);
}

}  // namespace pl
