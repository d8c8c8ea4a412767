// The part of Session by which learning is frozen, stepped, and forgotten for single volumes.
#include "core/base/error.h"
#include "core/session/session.h"
#include "core/session/update_schedule.h"

namespace pl {

std::uint64_t Session::trained_passes(MethodId method) const {
    return field(method).passes - field(method).untrained_passes;
}

/// Between passes: a pass under way is completed as it was begun.
void Session::control_learning(const EditLearning& edit) {
    if (!info_of(edit.method).learns)
        throw Error(ErrorKind::Usage, "method '" + std::string(info_of(edit.method).name) +
                                          "' does not learn while it renders: there is nothing to freeze");
    const FilmProgress& film = films_[{edit.method, View::Beauty}];
    const bool is_under_way = film.next_pixel > 0;
    const std::uint64_t trained = trained_passes(edit.method) + (is_under_way && film.trains ? 1 : 0);
    switch (edit.control) {
    case LearningControl::Freeze:
        // As the last pass that trains: its training samples are waiting for an update.
        if (!is_under_way && backend_->has_field(edit.method) && !is_frozen(edit.method)) update_trained(edit.method);
        settings_.learn_passes = trained;
        return;
    case LearningControl::Step: settings_.learn_passes = trained + 1; break;
    case LearningControl::Continue: settings_.learn_passes = kEveryPass; break;
    }
    field(edit.method).was_edited = true;
}

/// Decides whether the pass that begins trains the field.
void Session::prepare_training(FilmSlot slot) {
    films_[slot].trains = is_trained_by_pass(slot, films_[slot].passes);
    forget_due_volumes(slot.method);
}

/// An update after whole passes or a trial. Between two of them nothing decides anew whether passes train.
void Session::update_trained(MethodId method) {
    backend_->update_field(method);
    FieldProgress& learned = field(method);
    ++learned.updates;
    learned.is_well_trained = learned.records >= kEnoughSamplesPerVolume * placement_.count();
}

/// Whether the pass of this number trains the field if no update comes before it. A field that was edited learns by every pass, so
/// that a forgotten volume learns soon.
bool Session::is_trained_by_pass(FilmSlot slot, std::uint32_t pass) const {
    const FieldProgress& learned = field(slot.method);
    return !is_frozen(slot.method) && is_trained_by(pass, learned.is_well_trained && !learned.was_edited);
}

/// Whether so many passes of a film that train are followed by an update: of an edited field soon, however many passes the film has.
bool Session::is_update_due(FilmSlot slot, std::uint32_t passes) const {
    return is_updated_after(passes) || (field(slot.method).was_edited && passes % kMostTrainingPasses == 0);
}

void Session::forget_volume(const EditForgetVolume& edit) {
    if (!info_of(edit.method).learns || !placement_.is_placed() || !backend_->has_field(edit.method))
        throw Error(ErrorKind::Usage, "method '" + std::string(info_of(edit.method).name) +
                                          "' has learned nothing that could be forgotten");
    if (edit.volume < 0 || static_cast<std::size_t>(edit.volume) >= placement_.count())
        throw Error(ErrorKind::Usage, "radiance volume " + std::to_string(edit.volume) +
                                          " does not exist: expected 0 to " + std::to_string(placement_.count()) +
                                          " (exclusive)");
    FieldProgress& learned = field(edit.method);
    learned.was_edited = true;
    learned.forgotten.push_back(edit.volume);
    if (films_[{edit.method, View::Beauty}].next_pixel == 0) forget_due_volumes(edit.method);
}

/// The films stay: tables only guide the sampling.
void Session::forget_due_volumes(MethodId method) {
    FieldProgress& learned = field(method);
    if (learned.forgotten.empty()) return;
    HostField arrays = backend_->download_field(method);
    for (const std::int32_t volume : learned.forgotten)
        pl::forget_volume(placement_.shape(), *placement_.volumes(), arrays, static_cast<std::size_t>(volume));
    backend_->upload_field(method, std::move(arrays));
    ++learned.updates;
    learned.forgotten.clear();
}

}  // namespace pl
