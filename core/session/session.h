// A session: the door to scene, settings and back end, which edits change, and to the fields and films that are made by them. Viewer,
// command line, tests and benchmarks drive the same one. It has no current film: every call names its method and view. Not thread
// safe: one thread owns it.
#pragma once

#include <memory>

#include "core/session/film_renderer.h"
#include "core/session/served_kernel.h"

namespace pl {

/// The film of a front end's settings: their method and view.
inline FilmSlot slot_of(const RenderSettings& settings) { return {settings.method, settings.view}; }

class Session {
public:
    /// The scene must be valid. `load_seconds` goes into the clocks. Of the settings, `method` and `view` have no meaning
    /// here.
    Session(std::shared_ptr<RenderBackend> backend, std::shared_ptr<const SceneDescription> scene,
            const RenderSettings& settings, double load_seconds = 0.0);
    /// A session beside another one, to compare their films: it shares the packed scene and numbers films in the same sequence, so
    /// that one observer can follow both. Edits that clear films are to be given to both before the next piece of work.
    Session(const Session& other, std::shared_ptr<RenderBackend> backend, const RenderSettings& settings);

    /// Applies a change and clears the parts that take_over() names. Throws Error if a back end fails; if it is the new
    /// one of EditBackend, the session keeps the old one, unchanged, and a second try uploads everything to the new
    /// one again. EditLearned throws as import_field() does, EditMaterial Error(Input) for materials refused by
    /// validate_material(), EditLearning and EditForgetVolume Error(Usage) for methods that do not learn; then nothing has changed.
    void apply(const SessionEdit& edit);

    /// Does the next piece of work on a film: a slice of precomputation if the method still needs it, else one sample for
    /// every pixel, followed by an update of the field if the method learns. Up to `most_passes` of these if the back end renders
    /// several at once and nothing but samples changes between them: the same bits as one after the other.
    /// What a learner has thrown, or Error(Input) for what it has returned, is thrown at the end of the work: its update kept the table's
    /// own probabilities, and the next call goes on.
    Progress advance(FilmSlot slot, const StopFlag* stop = nullptr, std::uint32_t most_passes = 1) {
        const Progress done = films_->advance(slot, stop, most_passes);
        fields_->rethrow_failure();
        return done;
    }
    /// Does the work before the path of one pixel in the next pass, for pass_replay(): a slice of precomputation if the method still
    /// needs it, else the choice of guidance and, within the first pass of a learner, the parts before the pixel's with their
    /// updates. Rendered: the path is the next to be traced in the pixel's part. advance() completes the pass. The film must not
    /// be beyond the pixel.
    Progress advance_to_path(FilmSlot slot, std::uint32_t pixel, const StopFlag* stop = nullptr) {
        return films_->advance_to_path(slot, pixel, stop);
    }

    /// The learner of all later updates of methods that learn, in one process; empty: the table's own update. Its time counts as
    /// time of updates. Throws Error(Usage) if the field is not represented by tables.
    void set_learner(FieldLearner learner) { fields_->set_learner(std::move(learner)); }

    /// Copy of a film and all statistics.
    Snapshot snapshot(FilmSlot slot) const;
    /// The same, and the film's two halves, from which its noise is estimated.
    Snapshot snapshot_with_halves(FilmSlot slot) const;
    /// The same without the pixels, at little cost.
    Snapshot summary(FilmSlot slot) const;
    /// A film for display in a window; black before the first pass.
    ShownFilm show_film(FilmSlot slot, const DisplaySettings& display) { return films_->show(slot, display); }

    /// The passes of a film, to trace its paths again. Throws Error(Usage) if the view traces no paths.
    PassReplay pass_replay(FilmSlot slot) const;

    /// The hemisphere learned by a method at a volume. Throws Error(Usage) if it has no tables.
    VolumeInspection inspect_volume(MethodId method, std::int32_t volume) const {
        return fields_->inspect_volume(method, volume);
    }
    /// The learned field of a method. Throws Error(Usage) if it has no tables.
    LearnedField export_field(MethodId method) const { return fields_->export_field(method); }
    /// Continues from a learned field: takes its settings and volumes, and clears all films and the tables of other
    /// methods. Throws Error(Input) if it was learned in another scene or if the lengths of its arrays disagree.
    void import_field(LearnedField field);
    /// Bytes of save_state(), nearly.
    std::uint64_t state_bytes() const { return fields_->state_bytes() + films_->state_bytes(); }
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

    /// As given and edited; `method` and `view` are as given to the constructor.
    const RenderSettings& settings() const { return inputs_->settings; }
    /// The settings of one film.
    RenderSettings settings_for(FilmSlot slot) const { return inputs_->settings_for(slot); }
    const SceneDescription& scene() const { return *inputs_->scene.description(); }
    std::shared_ptr<const SceneDescription> shared_scene() const { return inputs_->scene.description(); }
    const std::string& scene_hash() const { return inputs_->scene.hash(); }
    std::shared_ptr<const HostScene> packed_scene() const { return inputs_->scene.packed(); }
    BackendInfo backend() const { return inputs_->backend->info(); }
    RenderBackend& backend_access() { return *inputs_->backend; }
    FeatureSet needed_features(FilmSlot slot) const { return inputs_->needed_features(slot); }
    ServedKernel served_kernel(FilmSlot slot) const;
    std::uint32_t passes(FilmSlot slot) const { return films_->progress(slot).passes; }
    /// Empty for methods without a field, and before the volumes are placed.
    std::optional<FieldStatus> field_status(MethodId method) const { return fields_->status(method); }
    /// Empty for films without guided paths, without light samples, and if every pass is guided by setting.
    std::optional<GuidingStatus> guiding_status(FilmSlot slot) const { return films_->guiding_status(slot); }
    /// The volumes of all methods; null before they are placed.
    const std::shared_ptr<const HostVolumes>& volumes() const { return fields_->placement().volumes(); }
    /// Of the placement that all methods share.
    Refinement refinement() const { return fields_->placement().refinement(); }
    /// Of a film and its method; cheap, unlike a snapshot.
    Clocks clocks(FilmSlot slot) const;
    /// Constant while a film is resumed; a cleared film gets a new one.
    FilmOrigin film_origin(FilmSlot slot) const { return films_->progress(slot).origin; }

private:
    Session(std::shared_ptr<RenderBackend> backend, SessionScene scene, const RenderSettings& settings,
            std::shared_ptr<FilmNumbers> numbers, double load_seconds);

    std::vector<std::pair<std::string, std::string>> identity() const;
    void upload_scene();
    void change_material(const EditMaterial& edit);
    void switch_backend(const EditBackend& edit);
    void control_learning(const EditLearning& edit);
    void clear_tables();

    // On the heap, because each of these refers to the objects before it, and a session may move.
    std::unique_ptr<RenderInputs> inputs_;
    std::unique_ptr<SessionFields> fields_;
    std::unique_ptr<FilmRenderer> films_;
    double load_seconds_ = 0.0;
    double upload_seconds_ = 0.0;
};

}  // namespace pl
