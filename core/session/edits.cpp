#include "core/session/edits.h"

namespace pl {
namespace {

struct Table {
    Invalidation operator()(const EditCamera&) const { return {.films = true}; }
    Invalidation operator()(const EditSize&) const { return {.films = true}; }
    Invalidation operator()(const EditSeed&) const { return {.films = true, .tables = true}; }
    Invalidation operator()(const EditEstimator&) const { return {.films = true, .tables = true}; }
    Invalidation operator()(const EditMixture&) const { return {.films = true}; }
    Invalidation operator()(const EditField&) const { return {.films = true, .tables = true, .volumes = true}; }
    Invalidation operator()(const EditScene&) const {
        return {.films = true, .tables = true, .volumes = true, .scene = true};
    }
    // Volumes: cleared only if same_placement() is false, which depends on the scene and not on the edit.
    Invalidation operator()(const EditMaterial&) const { return {.films = true, .tables = true}; }
    Invalidation operator()(const EditBackend& edit) const { return {.tables = edit.abandon_old}; }
    Invalidation operator()(const EditRestart&) const { return {.films = true}; }
    Invalidation operator()(const EditForget&) const { return {.films = true, .tables = true}; }
    Invalidation operator()(const EditLearning&) const { return {}; }
    Invalidation operator()(const EditForgetVolume&) const { return {}; }
    // Replaces tables and volumes itself: clearing them here would clear the new ones.
    Invalidation operator()(const EditLearned&) const { return {.films = true}; }
};

}  // namespace

Invalidation invalidated_by(const SessionEdit& edit) { return std::visit(Table{}, edit); }

}  // namespace pl
