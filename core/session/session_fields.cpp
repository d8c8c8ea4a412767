#include "core/session/session_fields.h"

#include <cmath>

#include "core/base/error.h"
#include "core/base/timer.h"
#include "core/fields/field_choices.h"
#include "core/kernel/integrator/probe.h"
#include "core/session/path_settings.h"
#include "core/session/refinement_schedule.h"
#include "core/session/update_schedule.h"

namespace pl {
namespace {

/// Whether the lengths of all arrays agree with each other and with the scene.
bool fits_together(const LearnedField& field, const HostScene& scene) {
    if (field.volumes == nullptr || field.shape.cells.side < 1) return false;
    if (field.shape.light_clusters != scene.light_clusters.size()) return false;
    const std::size_t volumes = field.volumes->normals.size();
    return field.volumes->sites.size() == volumes && field.volumes->kd_nodes.size() <= volumes &&
           field.refinement.added <= volumes &&
           representation_of(field.field) == representation_of(field.settings, field.method) &&
           fits(field.shape, field.field, volumes);
}

}  // namespace

bool SessionFields::is_warm(MethodId method) const {
    const FieldProgress& learned = progress(method);
    return learned.passes > 0 || learned.has_part || learned.precomputed_slices > 0 || learned.next_probe > 0;
}

std::uint64_t SessionFields::trained_passes(MethodId method) const {
    return progress(method).passes - progress(method).untrained_passes;
}

/// The back end is asked only if nothing follows from the shape, since it may have to wait for a device.
FieldReport SessionFields::report(MethodId method) const {
    const auto report =
        report_by_shape(placement_.shape(), placement_.count(), representation_of(settings(), method));
    return report ? *report : backend().field_report(method);
}

std::optional<FieldStatus> SessionFields::status(MethodId method) const {
    if (!placement_.is_placed() || !info_of(method).uses_field) return std::nullopt;
    const FieldProgress& state = progress(method);
    const FieldReport arrays = report(method);
    FieldStatus status{.volumes = static_cast<int>(placement_.count()),
                       .added_volumes = static_cast<int>(placement_.refinement().added),
                       .bins = placement_.bins(),
                       .representation = representation_of(settings(), method),
                       .bytes = volume_bytes(*placement_.volumes()) + arrays.bytes,
                       .network = arrays.network,
                       .passes = trained_passes(method),
                       .records = state.records,
                       .clamped_records = state.clamped_records,
                       .lookup_misses = state.lookup_misses,
                       .precomputed_share = 1.0,
                       .is_frozen = info_of(method).learns && is_frozen(method),
                       .was_edited = state.was_edited};
    if (info_of(method).precomputes)
        status.precomputed_share =
            (state.precomputed_slices + static_cast<double>(state.next_probe) / probe_count(false)) /
            settings().precompute_samples;
    return status;
}

void SessionFields::require_volume(std::int32_t volume) const {
    if (volume < 0 || static_cast<std::size_t>(volume) >= placement_.count())
        throw Error(ErrorKind::Usage, "radiance volume " + std::to_string(volume) +
                                          " does not exist: expected 0 to " + std::to_string(placement_.count()) +
                                          " (exclusive)");
}

VolumeInspection SessionFields::inspect_volume(MethodId method, std::int32_t volume) const {
    const MethodId owner = field_owner(method);
    if (!has_field(owner))
        throw Error(ErrorKind::Usage, "nothing has been learned yet: render with a method that uses radiance volumes "
                                      "(precomputed, reinforcement) first");
    require_volume(volume);
    HostField field = backend().download_field(owner);
    VolumeInspection inspection =
        pl::inspect_volume(field_view(placement_.shape(), *placement_.volumes(), field), volume);
    const MixtureSettings mixture = mixture_of(inputs_.settings, owner);
    if (mixture.learned == 0) inspection.bsdf_fraction = mixture.bsdf_fraction;
    return inspection;
}

void SessionFields::ensure_volumes() { placement_.ensure(backend(), scene(), settings(), inputs_.camera()); }

void SessionFields::ensure_field(MethodId method) {
    const MethodId owner = field_owner(method);
    if (!backend().has_field(owner)) require_field_memory(settings(), scene().light_clusters.size());
    ensure_volumes();
    if (!backend().has_field(owner))
        backend().upload_field(
            owner, make_field(placement_.shape(), placement_.count(), representation_of(settings(), owner)));
}

void SessionFields::begin_pass(MethodId method) {
    field(method) = field(method).without_part();
    forget_due_volumes(method);
}

/// A field that was edited learns by every pass, so that a forgotten volume learns soon.
bool SessionFields::is_trained_by_pass(MethodId method, std::uint32_t pass) const {
    const FieldProgress& learned = progress(method);
    const bool has_enough_samples = learned.is_well_trained && !learned.was_edited;
    return !is_frozen(method) && is_trained_by(pass, inputs_.settings.next_event, has_enough_samples);
}

/// An edited field is updated soon, however many passes the film has.
bool SessionFields::is_update_due(MethodId method, std::uint32_t passes) const {
    return is_updated_after(passes, inputs_.settings.next_event) ||
           (progress(method).was_edited && passes % kMostTrainingPasses == 0);
}

void SessionFields::count(MethodId method, const PassCounters& counters) {
    FieldProgress& learned = field(method);
    learned.records += counters.path.method.records;
    learned.clamped_records += counters.path.method.clamped_records;
    learned.lookup_misses += counters.path.method.lookup_misses;
}

void SessionFields::set_learner(FieldLearner learner) {
    if (learner && settings().representation != Representation::Table)
        throw Error(ErrorKind::Usage, "a learner fills tables: expected --field table with it, got --field " +
                                          std::string(name_of(settings().representation)));
    learner_ = std::move(learner);
}

void SessionFields::rethrow_failure() {
    if (learner_failure_) std::rethrow_exception(std::exchange(learner_failure_, nullptr));
}

/// Empty if the learner fails.
std::optional<LearnedCells> SessionFields::ask_learner(MethodId method) {
    try {
        const HostField field = backend().download_field(method);
        LearnedCells cells = learner_({placement_.shape(), *placement_.volumes(), tables_of(field)});
        require_cells(placement_.shape(), placement_.count(), cells);
        return cells;
    } catch (...) {
        learner_failure_ = std::current_exception();
        return std::nullopt;
    }
}

/// By the learner, if there is one. Where it fails the table's own probabilities stand.
void SessionFields::update_arrays(MethodId method) {
    const std::optional<LearnedCells> cells = learner_ ? ask_learner(method) : std::nullopt;
    backend().update_field(method);
    if (!cells) return;
    HostField field = backend().download_field(method);
    take_cells(placement_.shape(), tables_of(field), *cells);
    backend().upload_field(method, std::move(field));
}

void SessionFields::update(MethodId method) {
    update_arrays(method);
    FieldProgress& learned = field(method);
    ++learned.updates;
    learned.is_well_trained = learned.records >= kEnoughSamplesPerVolume * placement_.count();
}

void SessionFields::update_within_pass(MethodId method) {
    update_arrays(method);
    ++field(method).updates;
    field(method).has_part = true;
}

bool SessionFields::finish_pass(MethodId method, bool has_trained, bool is_due) {
    FieldProgress& learned = field(method);
    ++learned.passes;
    learned.untrained_passes += has_trained ? 0u : 1u;
    const bool is_updated = has_trained && (is_due || is_frozen(method));
    if (is_updated) update(method);
    learned.has_part = false;
    return is_updated && refine_if_due(method);
}

/// Number of probes of a slice of the map, or of its coarse part.
std::uint32_t SessionFields::probe_count(bool is_coarse) const {
    const int side = placement_.shape().cells.side;
    const auto bins = static_cast<std::uint32_t>(placement_.bins());
    return static_cast<std::uint32_t>(placement_.count()) *
           (is_coarse ? ProbeQuarter::of(side, 0).probes_of_volume() : bins);
}

bool SessionFields::is_map_complete(MethodId method) const {
    return progress(method).precomputed_slices >= static_cast<std::uint32_t>(settings().precompute_samples);
}

bool SessionFields::has_coarse_map(MethodId method) const {
    return progress(method).precomputed_slices > 0 || progress(method).next_probe >= probe_count(true);
}

bool SessionFields::precompute(FilmSlot slot, bool is_coarse, const StopFlag* stop) {
    const Stopwatch watch;
    FieldProgress& map = field(slot.method);
    const auto slices = static_cast<std::uint32_t>(settings().precompute_samples);
    const std::uint32_t end = probe_count(is_coarse);
    const PassCounters counters =
        backend().precompute({.method = slot.method,
                              .features = inputs_.needed_features(slot).with(inputs_.settings.forced_effects),
                              .path = probe_settings(inputs_.settings, slot.method),
                              .sample = map.precomputed_slices,
                              .strata_side = static_cast<std::uint32_t>(std::lround(std::sqrt(slices))),
                              .first_probe = map.next_probe,
                              .end_probe = end,
                              .stop = stop});
    map.records += counters.paths;
    map.clamped_records += counters.path.method.clamped_records;
    map.next_probe += static_cast<std::uint32_t>(counters.paths);
    const bool is_reached = map.next_probe >= end;
    if (is_reached && end == probe_count(false)) {
        map.next_probe = 0;
        ++map.precomputed_slices;
        if (is_map_complete(slot.method)) ++map.passes;
    }
    if (is_reached && (map.next_probe > 0 || is_map_complete(slot.method))) {
        backend().update_field(slot.method);
        ++map.updates;
    }
    map.precompute_seconds += watch.seconds();
    return is_reached;
}

/// Splits volumes by the tables of the learning method. Returns whether there is another placement.
bool SessionFields::refine_if_due(MethodId method) {
    const auto added = volumes_to_add(settings(), placement_.count(), placement_.refinement(), progress(method),
                                      placement_.shape().light_clusters);
    if (!added) return false;
    const bool is_split = *added > 0 && split_volumes(method, *added);
    placement_.count_round();
    return is_split;
}

bool SessionFields::split_volumes(MethodId method, std::size_t most) {
    HostField learned = backend().download_field(method);
    RefinedPlacement refined = placement_.split(backend(), scene(), settings(), inputs_.camera(), learned, most);
    if (refined.parents.empty()) return false;
    replace_volumes(method, std::move(refined), std::move(learned));
    return true;
}

/// A complete radiance map keeps the measured tables of the parents; an incomplete one begins anew, since its slices are counted for
/// all volumes at once.
void SessionFields::replace_volumes(MethodId learner, RefinedPlacement refined, HostField learned) {
    const FieldShape& shape = placement_.shape();
    std::vector<std::pair<MethodId, HostField>> tables;
    tables.emplace_back(learner, split_field(shape, std::move(learned), refined.parents));
    for (const MethodInfo& other : all_methods()) {
        if (other.id == learner || !backend().has_field(other.id)) continue;
        FieldProgress& progress = field(other.id);
        ++progress.updates;
        if (progress.passes > 0)
            tables.emplace_back(other.id, split_field(shape, backend().download_field(other.id), refined.parents));
        else
            progress = {.updates = progress.updates, .precompute_seconds = progress.precompute_seconds};
    }
    placement_.refine(backend(), scene(), std::move(refined));
    try {
        upload(backend(), std::move(tables));
    } catch (...) {  // the contents of the back end are unknown
        placement_.clear();
        clear_tables();
        throw;
    }
}

std::uint64_t SessionFields::control_learning(const EditLearning& edit, bool is_under_way, bool trains) {
    if (!info_of(edit.method).learns)
        throw Error(ErrorKind::Usage, "method '" + std::string(info_of(edit.method).name) +
                                          "' does not learn while it renders: there is nothing to freeze");
    const std::uint64_t trained = trained_passes(edit.method) + (is_under_way && trains ? 1 : 0);
    if (edit.control == LearningControl::Freeze) {
        // As the last pass that trains: its training samples are waiting for an update.
        if (!is_under_way && backend().has_field(edit.method) && !is_frozen(edit.method)) update(edit.method);
        return trained;
    }
    field(edit.method).was_edited = true;
    return edit.control == LearningControl::Step ? trained + 1 : kEveryPass;
}

void SessionFields::forget_volume(const EditForgetVolume& edit, bool is_under_way) {
    if (!info_of(edit.method).learns || !has_field(edit.method))
        throw Error(ErrorKind::Usage, "method '" + std::string(info_of(edit.method).name) +
                                          "' has learned nothing that could be forgotten");
    require_volume(edit.volume);
    FieldProgress& learned = field(edit.method);
    learned.was_edited = true;
    learned.forgotten.push_back(edit.volume);
    if (!is_under_way) forget_due_volumes(edit.method);
}

void SessionFields::forget_due_volumes(MethodId method) {
    FieldProgress& learned = field(method);
    if (learned.forgotten.empty()) return;
    HostField arrays = backend().download_field(method);
    for (const std::int32_t volume : learned.forgotten)
        pl::forget_volume(placement_.shape(), *placement_.volumes(), arrays, static_cast<std::size_t>(volume));
    backend().upload_field(method, std::move(arrays));
    ++learned.updates;
    learned.forgotten.clear();
}

void SessionFields::change_materials(bool is_same) { placement_.change_materials(scene(), settings(), is_same); }

void SessionFields::clear_tables() {
    fields_.fill(FieldProgress{});
    placement_.undo_refinement();
    upload(backend(), {});
}

LearnedField SessionFields::export_field(MethodId method) const {
    if (!has_field(method))
        throw Error(ErrorKind::Usage, "method '" + std::string(info_of(method).name) + "' has learned nothing yet");
    return {.method = method,
            .scene_hash = inputs_.scene.hash(),
            .settings = settings(),
            .shape = placement_.shape(),
            .volumes = placement_.volumes(),
            .refinement = placement_.refinement(),
            .field = backend().download_field(method),
            .progress = progress(method).without_part()};
}

void SessionFields::import_field(LearnedField learned) {
    require_learned_in(inputs_.scene.hash(), learned);
    if (!info_of(learned.method).uses_field || !fits_together(learned, scene()))
        throw Error(ErrorKind::Input, "the field's volumes and tables do not fit together");
    Placement adopted = placement_;
    adopted.adopt(backend(), scene(), *learned.volumes, learned.shape, learned.refinement);
    backend().upload_field(learned.method, std::move(learned.field));
    placement_ = std::move(adopted);
    fields_.fill(FieldProgress{});
    field(learned.method) = std::move(learned.progress);
}

/// Without volumes, tables are left over from others.
std::vector<std::pair<MethodId, HostField>> SessionFields::download() const {
    std::vector<std::pair<MethodId, HostField>> fields;
    for (const MethodInfo& method : all_methods())
        if (has_field(method.id)) fields.emplace_back(method.id, backend().download_field(method.id));
    return fields;
}

void SessionFields::upload(RenderBackend& backend, std::vector<std::pair<MethodId, HostField>> fields) const {
    if (placement_.is_placed()) backend.upload_volumes(placement_.volumes(), placement_.shape());
    for (auto& [method, arrays] : fields) backend.upload_field(method, std::move(arrays));
}

std::uint64_t SessionFields::state_bytes() const {
    std::uint64_t bytes = placement_.is_placed() ? volume_bytes(*placement_.volumes()) : 0;
    for (const MethodInfo& method : all_methods()) bytes += backend().field_report(method.id).bytes;
    return bytes;
}

void SessionFields::save_state(SessionState& state) const {
    if (placement_.is_placed())
        state.placement = SavedPlacement{.settings = settings(),
                                         .shape = placement_.shape(),
                                         .refinement = placement_.refinement(),
                                         .seconds = placement_.seconds(),
                                         .volumes = placement_.volumes()};
    for (const MethodInfo& method : all_methods()) {
        const bool has_arrays = has_field(method.id);
        if (!has_arrays && progress(method.id) == FieldProgress{}) continue;
        state.fields.push_back({.method = method.id,
                                .progress = progress(method.id),
                                .arrays = has_arrays ? backend().download_field(method.id) : HostField{}});
    }
}

void SessionFields::restore_state(SessionState& state) {
    if (state.placement) {
        const SavedPlacement& placed = *state.placement;
        placement_.adopt(backend(), scene(), *placed.volumes, placed.shape, placed.refinement);
        placement_.set_seconds(placed.seconds);
    }
    for (SavedField& saved : state.fields) {
        if (field_bytes(saved.arrays) > 0) backend().upload_field(saved.method, std::move(saved.arrays));
        field(saved.method) = std::move(saved.progress);
    }
}

}  // namespace pl
