// A session: settings, scene, back end, films and learned fields. Viewer, command line, tests and benchmarks drive
// the same one. It has no current film: every call names its method and view. Not thread safe: one thread owns it.
#pragma once

#include <array>
#include <memory>

#include "core/session/backend.h"
#include "core/session/edits.h"
#include "core/session/learned_field.h"
#include "core/session/pass_replay.h"
#include "core/session/placement.h"
#include "core/session/served_kernel.h"
#include "core/session/session_films.h"
#include "core/session/session_scene.h"
#include "core/session/session_state.h"
#include "core/session/shown_range.h"

namespace pl {

/// Outcome of one call of Session::advance.
enum class Progress {
    Precomputed,  ///< a slice of the radiance map; the film has not changed
    Rendered,     ///< one more sample per pixel, or several
    Stopped,      ///< the stop flag was seen; the next call resumes there
};

/// A film in transfer to a window, with the range of values of its colors.
struct ShownFilm {
    DisplayFrame frame;
    ShownRange range;
};

/// The film of a front end's settings: their method and view.
inline FilmSlot slot_of(const RenderSettings& settings) { return {settings.method, settings.view}; }

class Session {
public:
    /// The scene must be valid. `load_seconds` goes into the clocks. Of the settings, `method` and `view` have no meaning
    /// here.
    Session(std::shared_ptr<RenderBackend> backend, std::shared_ptr<const SceneDescription> scene,
            const RenderSettings& settings, double load_seconds = 0.0);

    /// Applies a change and clears the parts of invalidated_by(). Throws Error if a back end fails; if it is the new
    /// one of EditBackend, the session keeps the old one, unchanged, and a second try uploads everything to the new
    /// one again. EditLearned throws as import_field() does, EditMaterial Error(Input) for materials refused by
    /// validate_material(), EditLearning and EditForgetVolume Error(Usage) for methods that do not learn; then nothing has changed.
    void apply(const SessionEdit& edit);

    /// Does the next piece of work on a film: a slice of precomputation if the method still needs it, else one sample for
    /// every pixel, followed by an update of the field if the method learns. Up to `most_passes` of these if the back end renders
    /// several at once and nothing but samples changes between them: the same bits as one after the other.
    Progress advance(FilmSlot slot, const StopFlag* stop = nullptr, std::uint32_t most_passes = 1);
    /// Does the work before the path of one pixel in the next pass, for pass_replay(): a slice of precomputation if the method still
    /// needs it, else the choice of guidance and, within the first pass of a learner, the parts before the pixel's with their
    /// updates. Rendered: the path is the next to be traced in the pixel's part. advance() completes the pass. The film must not
    /// be beyond the pixel.
    Progress advance_to_path(FilmSlot slot, std::uint32_t pixel, const StopFlag* stop = nullptr);

    /// Copy of a film and all statistics.
    Snapshot snapshot(FilmSlot slot) const;
    /// The same, and the film's two halves, from which its noise is estimated.
    Snapshot snapshot_with_halves(FilmSlot slot) const;
    /// The same without the pixels, at little cost.
    Snapshot summary(FilmSlot slot) const;
    /// A film for display in a window; black before the first pass.
    ShownFilm show_film(FilmSlot slot, const DisplaySettings& display);

    /// The passes of a film, to trace its paths again. Throws Error(Usage) if the view traces no paths.
    PassReplay pass_replay(FilmSlot slot) const;

    /// The hemisphere learned by a method at a volume. Throws Error(Usage) if it has no tables.
    VolumeInspection inspect_volume(MethodId method, std::int32_t volume) const;
    /// The learned field of a method. Throws Error(Usage) if it has no tables.
    LearnedField export_field(MethodId method) const;
    /// Continues from a learned field: takes its settings and volumes, and clears all films and the tables of other
    /// methods. Throws Error(Input) if it was learned in another scene or if the lengths of its arrays disagree.
    void import_field(LearnedField field);
    /// Bytes of save_state(), nearly.
    std::uint64_t state_bytes() const;
    /// All state that decides later bits, between two pieces of work or within a pass. Throws Error(Unavailable) if the back end's
    /// films cannot be taken out, see exact().
    SessionState save_state() const;
    /// Continues from the state of another session; to be called before the first piece of work. Throws Error(Input) if that had
    /// another scene, another kind of back end or other settings.
    void restore_state(SessionState state);
    /// Volume that serves a point; kNoVolume if none. Places the volumes if they are not placed yet.
    std::int32_t find_volume_at(Vec3f position, Vec3f normal);
    /// First surface under a point of the film, in pixels of the present size; empty where rays hit nothing.
    std::optional<PickedPoint> pick(Vec2f film);

    /// As given and edited; `method` and `view` are those of the constructor.
    const RenderSettings& settings() const { return settings_; }
    /// The settings of one film.
    RenderSettings settings_for(FilmSlot slot) const;
    const SceneDescription& scene() const { return *scene_.description(); }
    std::shared_ptr<const SceneDescription> shared_scene() const { return scene_.description(); }
    std::shared_ptr<const HostScene> packed_scene() const { return scene_.packed(); }
    BackendInfo backend() const { return backend_->info(); }
    RenderBackend& backend_access() { return *backend_; }
    FeatureSet needed_features(FilmSlot slot) const;
    ServedKernel served_kernel(FilmSlot slot) const;
    std::uint32_t passes(FilmSlot slot) const { return films_[slot].passes; }
    /// Empty for methods without a field, and before the volumes are placed.
    std::optional<FieldStatus> field_status(MethodId method) const;
    /// Empty for films without guided paths, without light samples, and if every pass is guided by setting.
    std::optional<GuidingStatus> guiding_status(FilmSlot slot) const;
    /// Of the placement that all methods share.
    Refinement refinement() const { return placement_.refinement(); }
    /// Of a film and its method; cheap, unlike a snapshot.
    Clocks clocks(FilmSlot slot) const;
    /// Constant while a film is resumed; a cleared film gets a new one.
    FilmOrigin film_origin(FilmSlot slot) const { return films_[slot].origin; }

private:
    std::uint32_t pixel_count() const { return static_cast<std::uint32_t>(settings_.width * settings_.height); }
    std::uint32_t probe_count() const;
    std::uint32_t coarse_probe_count() const;
    bool is_map_complete(MethodId method) const;
    bool coarse_map_suffices(FilmSlot slot) const;
    FieldReport field_report(MethodId method) const;
    FieldProgress& field(MethodId method) { return fields_[static_cast<std::size_t>(method)]; }
    const FieldProgress& field(MethodId method) const { return fields_[static_cast<std::size_t>(method)]; }

    std::vector<std::pair<std::string, std::string>> identity() const;
    void save_film(FilmSlot slot, SessionState& state) const;
    void upload_scene();
    void replace_scene(const EditScene& edit);
    void change_material(const EditMaterial& edit);
    void switch_backend(const EditBackend& edit);
    void clear_films();
    void clear_tables();

    Camera view_camera() const;
    void ensure_volumes() { placement_.ensure(*backend_, *scene_.packed(), settings_.field, view_camera()); }
    void ensure_tables(MethodId method);
    void ensure_film(FilmSlot slot);
    void begin_film(FilmSlot slot);
    void take_pixels(Snapshot& snapshot, FilmReading film) const;

    void prepare_film(FilmSlot slot);
    void prepare_pass(FilmSlot slot);
    bool needs_precompute(FilmSlot slot) const;
    Progress precompute_slice(FilmSlot slot, const StopFlag* stop);
    Progress render_slot(FilmSlot slot, const StopFlag* stop, std::uint32_t most_passes = 1);
    Progress render_passes(FilmSlot slot, const StopFlag* stop, std::uint32_t most);
    void begin_run_if_due(FilmSlot slot);
    std::uint32_t sample_number(FilmSlot slot) const;
    std::uint32_t equal_passes(FilmSlot slot, std::uint32_t most) const;
    void finish_pass(FilmSlot slot);
    bool render_parts_before(FilmSlot slot, std::uint32_t pixel, const StopFlag* stop);
    void render_part(FilmSlot slot, std::uint32_t end, const StopFlag* stop, std::uint32_t most_passes = 1);
    PassRequest pass_request(FilmSlot slot, MethodId method, const StopFlag* stop) const;
    bool first_passes_weigh_less(FilmSlot slot) const;
    bool chooses_guiding(FilmSlot slot) const;
    bool warms_up(FilmSlot slot) const;
    bool choose_guiding(FilmSlot slot, const StopFlag* stop);
    bool warm_up(FilmSlot slot, const StopFlag* stop);
    bool run_trial(FilmSlot slot, Trial trial, const StopFlag* stop);
    bool trains_by(FilmSlot slot, Trial trial) const;
    PassRequest trial_request(FilmSlot slot, Trial trial, const StopFlag* stop) const;
    std::uint32_t trial_step() const;
    void measure_guiding(FilmSlot slot);
    GuidingTerms guiding_terms(FilmSlot slot) const;
    GuidingTerms::Field state_of_field(MethodId method) const;
    std::uint64_t trained_passes(MethodId method) const;
    bool is_frozen(MethodId method) const { return trained_passes(method) >= settings_.learn_passes; }
    void control_learning(const EditLearning& edit);
    void prepare_training(FilmSlot slot);
    void update_trained(MethodId method);
    bool is_trained_by_pass(FilmSlot slot, std::uint32_t pass) const;
    bool is_update_due(FilmSlot slot, std::uint32_t passes) const;
    void forget_volume(const EditForgetVolume& edit);
    void forget_due_volumes(MethodId method);
    std::uint32_t end_of_part(FilmSlot slot) const;
    void finish_learning_part(FilmSlot slot);
    void finish_learning_pass(FilmSlot slot);
    void note_escapes(FilmSlot slot, const PassCounters& counters);

    void refine_if_due(MethodId method);
    void split_volumes(MethodId method, std::size_t most);
    void replace_volumes(MethodId learner, RefinedPlacement refined, HostField learned);

    std::shared_ptr<RenderBackend> backend_;
    RenderSettings settings_;
    SessionScene scene_;
    Placement placement_;
    SessionFilms films_;
    std::array<FieldProgress, kMethodCount> fields_{};
    double load_seconds_ = 0.0;
    double upload_seconds_ = 0.0;
};

}  // namespace pl
