// The learned fields of a session, one for each method that has one: placement, training, freezing, precomputation and refinement.
// Fields stay as they are while films are cleared; of films they only know the passes that train them.
#pragma once

#include <array>
#include <cstdint>
#include <exception>
#include <optional>
#include <utility>
#include <vector>

#include "core/fields/field_learner.h"
#include "core/session/edits.h"
#include "core/session/learned_field.h"
#include "core/session/placement.h"
#include "core/session/render_inputs.h"
#include "core/session/session_state.h"
#include "core/session/snapshot.h"

namespace pl {

class SessionFields {
public:
    explicit SessionFields(const RenderInputs& inputs) : inputs_(inputs) {}

    /// Shared by all methods.
    const Placement& placement() const { return placement_; }
    const FieldProgress& progress(MethodId method) const { return fields_[static_cast<std::size_t>(method)]; }
    /// Whether a method has begun to learn, or to fill its map.
    bool is_warm(MethodId method) const;
    std::uint64_t trained_passes(MethodId method) const;
    /// Whether further passes leave the field as it is.
    bool is_frozen(MethodId method) const { return trained_passes(method) >= inputs_.settings.learn_passes; }
    /// Empty for methods without a field, and before the volumes are placed.
    std::optional<FieldStatus> status(MethodId method) const;
    /// See Session::inspect_volume().
    VolumeInspection inspect_volume(MethodId method, std::int32_t volume) const;

    /// Places the volumes unless they are placed.
    void ensure_volumes();
    /// Makes the field that guides a method's paths, or that its views show, unless it is made.
    void ensure_field(MethodId method);

    /// The first step of a pass of a method that learns.
    void begin_pass(MethodId method);
    /// Whether the pass of this number trains the field if no update comes before it.
    bool is_trained_by_pass(MethodId method, std::uint32_t pass) const;
    /// Whether so many passes of a film that train are followed by an update.
    bool is_update_due(MethodId method, std::uint32_t passes) const;
    /// Adds the training samples and lookups of paths.
    void count(MethodId method, const PassCounters& counters);
    /// An update after whole passes or a trial. Between two of them nothing decides anew whether passes train.
    void update(MethodId method);
    /// An update within a pass.
    void update_within_pass(MethodId method);
    /// The last step of a pass, with its update if one is due or the field is frozen from now on, and then at most one round of
    /// refinement. Returns whether this has moved the volumes. If a back end fails while it takes these, nothing is left placed.
    bool finish_pass(MethodId method, bool has_trained, bool is_due);

    bool is_map_complete(MethodId method) const;
    /// Whether the probes of a coarse map are traced: the first quarter, which is enough to find out whether guiding pays.
    bool has_coarse_map(MethodId method) const;
    /// Traces the probes of a coarse map, or the remaining probes of a slice. Returns false if it was stopped.
    bool precompute(FilmSlot slot, bool is_coarse, const StopFlag* stop);

    /// See Session::set_learner().
    void set_learner(FieldLearner learner);
    /// Throws what a learner has thrown since the last call, or for what it has returned.
    void rethrow_failure();

    /// Freezes, steps or continues learning. Returns RenderSettings::learn_passes from now on. `is_under_way`: a pass, which is
    /// completed as it was begun, and by which the field `trains`. Throws Error(Usage) for methods that do not learn.
    std::uint64_t control_learning(const EditLearning& edit, bool is_under_way, bool trains);
    /// At once, or before the next pass if one `is_under_way`. Throws Error(Usage) if there is nothing to forget.
    void forget_volume(const EditForgetVolume& edit, bool is_under_way);
    /// The materials of the scene have changed. `is_same`: see same_placement().
    void change_materials(bool is_same);
    /// Drops the placement.
    void clear_volumes() { placement_.clear(); }
    /// Drops what all methods have learned.
    void clear_tables();

    /// The field of a method, for files. Throws Error(Usage) if there is none.
    LearnedField export_field(MethodId method) const;
    /// Continues from a field, and drops what other methods have learned. See Session::import_field().
    void import_field(LearnedField learned);
    /// The arrays of all methods, to be moved to another back end.
    std::vector<std::pair<MethodId, HostField>> download() const;
    /// Gives the volumes and those arrays to a back end.
    void upload(RenderBackend& backend, std::vector<std::pair<MethodId, HostField>> fields) const;

    std::uint64_t state_bytes() const;
    void save_state(SessionState& state) const;
    void restore_state(SessionState& state);

private:
    RenderBackend& backend() const { return *inputs_.backend; }
    const HostScene& scene() const { return *inputs_.scene.packed(); }
    const FieldSettings& settings() const { return inputs_.settings.field; }
    FieldProgress& field(MethodId method) { return fields_[static_cast<std::size_t>(method)]; }
    bool has_field(MethodId method) const { return placement_.is_placed() && backend().has_field(method); }
    FieldReport report(MethodId method) const;
    void require_volume(std::int32_t volume) const;
    void update_arrays(MethodId method);
    std::optional<LearnedCells> ask_learner(MethodId method);
    void forget_due_volumes(MethodId method);

    std::uint32_t probe_count(bool is_coarse) const;
    bool refine_if_due(MethodId method);
    bool split_volumes(MethodId method, std::size_t most);
    void replace_volumes(MethodId learner, RefinedPlacement refined, HostField learned);

    const RenderInputs& inputs_;
    Placement placement_;
    std::array<FieldProgress, kMethodCount> fields_{};
    FieldLearner learner_;  ///< empty: the representation's own
    std::exception_ptr learner_failure_;
};

}  // namespace pl
