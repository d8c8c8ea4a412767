#include "ui/worker/answers.h"

#include "core/base/error.h"

namespace pl::ui {

PickAnswer answer_pick(Session& session, Vec2f image_point) {
    const RenderSettings& settings = session.settings();
    PickAnswer answer;
    answer.value =
        session.pick(image_point * Vec2f{static_cast<float>(settings.width), static_cast<float>(settings.height)});
    return answer;
}

VolumesAnswer answer_volumes(Session& session, const std::vector<SurfacePlace>& places) {
    VolumesAnswer answer;
    for (const SurfacePlace& place : places)
        answer.value.push_back({place, session.find_volume_at(place.position, place.normal)});
    return answer;
}

LearnedAnswer answer_learned(const Session& session, MethodId method) {
    LearnedAnswer answer;
    try {
        answer.value = std::make_shared<const LearnedField>(session.export_field(method));
    } catch (const Error& error) {
        if (error.kind() != ErrorKind::Usage) throw;
        answer.reason = error.what();
    }
    return answer;
}

PathsAnswer answer_paths(const Session& session, FilmSlot slot, std::uint64_t generation) {
    PathsAnswer answer{.generation = generation};
    try {
        answer.value = std::make_shared<diagnose::PassPair>(diagnose::pass_pair(session, slot));
    } catch (const std::exception& error) {
        answer.reason = error.what();
    }
    return answer;
}

GainAnswer answer_gain(const Session& session, FilmSlot slot) {
    const FilmSlot base{baseline_method(), View::Beauty};
    const FilmSlot method{field_owner(slot.method), View::Beauty};
    for (const FilmSlot& needed : {base, method})
        if (session.passes(needed) < 2)
            return {.reason = std::string(info_of(needed.method).label) + " has no picture to compare with yet"};
    return {.value = {std::make_shared<const Snapshot>(session.snapshot_with_halves(base)),
                      std::make_shared<const Snapshot>(session.snapshot_with_halves(method))}};
}

DiagnosticsAnswer answer_diagnostics(const Session& session, FilmSlot slot, std::uint64_t generation) {
    DiagnosticsAnswer answer{.generation = generation};
    try {
        answer.value = diagnose::diagnostics_input(session, slot);
    } catch (const std::exception& error) {
        answer.reason = error.what();
    }
    return answer;
}

}  // namespace pl::ui
