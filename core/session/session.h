// A session: settings, scene, back end, films and learned fields. Viewer, command line, tests and benchmarks drive
// the same one. Not thread safe: one thread owns it.
#pragma once

#include <array>
#include <memory>

#include "core/scene/enclosure.h"
#include "core/session/backend.h"
#include "core/session/edits.h"
#include "core/session/learned_field.h"
#include "core/session/pass_replay.h"
#include "core/session/served_kernel.h"
#include "core/session/shown_range.h"

namespace pl {

/// What one call of Session::advance did.
enum class Progress {
    Precomputed,  ///< a slice of the radiance map; the picture has not changed
    Rendered,     ///< one more sample per pixel
    Stopped,      ///< the stop flag was seen; the next call goes on where this one ended
};

/// A film on its way to a window, and what its darkest and lightest colors stand for.
struct ShownFilm {
    DisplayFrame frame;
    ShownRange range;
};

class Session {
public:
    /// The scene must be valid. `load_seconds` goes into the clocks.
    Session(std::shared_ptr<RenderBackend> backend, std::shared_ptr<const SceneDescription> scene,
            const RenderSettings& settings, double load_seconds = 0.0);

    /// Applies a change and clears what invalidated_by() says. Throws Error if a back end fails; if it is the new one
    /// of EditBackend, the session stays with the old one, unchanged, and the new one has to be given everything anew
    /// when it is tried again. EditLearned throws as import_field() does, EditMaterial Error(Input) for what
    /// validate_material() refuses; then nothing has changed.
    void apply(const SessionEdit& edit);

    /// Does the next piece of work: a slice of precomputation if the method still needs it, else one sample for
    /// every pixel, followed by publication if the method learns.
    Progress advance(const StopFlag* stop = nullptr);

    /// Copy of the current film and all statistics.
    Snapshot snapshot() const;
    /// The same, and the film's two halves: they tell its noise.
    Snapshot snapshot_with_halves() const;
    /// The same without the pixels: costs nothing.
    Snapshot summary() const;
    /// The current film as a window shows it.
    ShownFilm show_film(const DisplaySettings& display);

    /// The passes of the current picture, for tracing their paths again. Throws Error(Usage) if the view shows no paths.
    PassReplay pass_replay() const;

    /// What the current method learned at a volume. Throws Error(Usage) if it learns nothing.
    VolumeInspection inspect_volume(std::int32_t volume) const;
    /// What the current method has learned. Throws Error(Usage) if it has no tables.
    LearnedField export_field() const;
    /// Goes on from a learned field: takes its settings and volumes, and empties all pictures and the tables of other
    /// methods. Throws Error(Input) if it was learned in another scene or does not fit together.
    void import_field(LearnedField field);
    /// Volume that serves a point; kNoVolume if none. Places the volumes if they are not placed yet.
    std::int32_t find_volume_at(Vec3f position, Vec3f normal);
    /// First surface under a point of the film, in pixels of the current size; empty where nothing is hit.
    std::optional<PickedPoint> pick(Vec2f film);

    const RenderSettings& settings() const { return settings_; }
    const SceneDescription& scene() const { return *scene_; }
    std::shared_ptr<const SceneDescription> shared_scene() const { return scene_; }
    std::shared_ptr<const HostScene> packed_scene() const { return packed_; }
    BackendInfo backend() const { return backend_->info(); }
    RenderBackend& backend_access() { return *backend_; }
    FeatureSet needed_features() const;
    ServedKernel served_kernel() const;
    std::uint32_t passes() const { return film().passes; }
    std::optional<FieldStatus> field_status() const;
    /// Of the placement that all methods share; nothing before the volumes are placed.
    Refinement refinement() const { return refinement_; }
    /// Of the current film and method; cheap, unlike a snapshot.
    Clocks clocks() const;
    /// Of the current film. A picture that is resumed keeps its origin; one that was emptied gets another.
    FilmOrigin film_origin() const { return film().origin; }

private:
    struct FilmState {
        FilmOrigin origin;
        bool allocated = false;
        std::uint32_t passes = 0;      ///< complete ones
        std::uint32_t next_pixel = 0;  ///< where the running pass goes on
        PassCounters counters{};
        double render_seconds = 0.0;
        double learn_seconds = 0.0;
    };
    using FilmStates = std::array<FilmState, FilmSlot::kCount>;
    /// A back end that was left, with its pictures and the scene that it knows.
    struct ParkedBackend {
        std::shared_ptr<RenderBackend> backend;
        FilmStates films{};
        std::shared_ptr<const HostScene> scene;
    };

    FilmSlot slot() const { return {settings_.method, settings_.view}; }
    std::uint32_t pixel_count() const { return static_cast<std::uint32_t>(settings_.width * settings_.height); }
    std::uint32_t probe_count() const;
    const FilmState& film() const { return films_[static_cast<std::size_t>(slot().index())]; }
    FilmState& film() { return films_[static_cast<std::size_t>(slot().index())]; }
    FieldProgress& field() { return fields_[static_cast<std::size_t>(settings_.method)]; }
    const FieldProgress& field() const { return fields_[static_cast<std::size_t>(settings_.method)]; }

    void load_scene();
    void begin_film(FilmSlot slot);
    void take_pixels(Snapshot& snapshot, FilmReading film) const;
    void change_material(const EditMaterial& edit);
    void switch_backend(const EditBackend& edit);
    ParkedBackend unpark(const std::shared_ptr<RenderBackend>& backend);
    void ensure_volumes();
    std::shared_ptr<const HostVolumes> with_lookup(HostVolumes volumes, Lookup lookup) const;
    void ensure_tables();
    void ensure_film(FilmSlot slot);
    void clear_films();
    void clear_tables();
    bool needs_precompute() const;
    Progress precompute_slice(const StopFlag* stop);
    Progress render_slot(FilmSlot slot, const StopFlag* stop);
    Progress render_pass(FilmSlot slot, FilmState& state, const StopFlag* stop);
    void render_part(FilmSlot slot, FilmState& state, std::uint32_t end, const StopFlag* stop);
    std::uint32_t end_of_part(FilmSlot slot, const FilmState& state) const;
    void finish_learning_part(FilmState& state);
    void finish_learning_pass(FilmState& state);
    void refine_if_due();
    void split_volumes(std::size_t most);
    void replace_volumes(RefinedPlacement refined, HostField learned);
    void clear_cell_films();
    void note_escapes(const PassCounters& counters);
    PathSettings path_settings() const;
    MixtureSettings mixture_of(MethodId method) const;

    std::shared_ptr<RenderBackend> backend_;
    std::vector<ParkedBackend> parked_;
    std::shared_ptr<const SceneDescription> scene_;
    RenderSettings settings_;
    std::shared_ptr<const HostScene> packed_;
    std::optional<Enclosure> enclosure_;  ///< of the scene, once a path has escaped
    std::optional<bool> is_closed_;       ///< it contains the camera; unknown before a path has escaped
    std::shared_ptr<const HostVolumes> volumes_;
    Refinement refinement_;  ///< of volumes_; forgotten with what was learned
    FieldShape shape_;
    FilmStates films_{};
    std::array<FieldProgress, kMethodCount> fields_{};
    double load_seconds_ = 0.0;
    double build_seconds_ = 0.0;
    double upload_seconds_ = 0.0;
    double place_seconds_ = 0.0;
    std::uint64_t films_begun_ = 0;
    std::uint64_t film_generation_ = 0;
};

}  // namespace pl
