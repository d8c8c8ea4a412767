#include "ui/worker/backend_switch.h"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/session/backend.h"

namespace pl::ui {
namespace {

bool has_learned(Session& session) {
    const auto methods = all_methods();
    return std::any_of(methods.begin(), methods.end(),
                       [&](const MethodInfo& method) { return session.backend_access().has_field(method.id); });
}

/// Moves the session, if need be without the tables of the old back end. True if nothing was lost.
bool leave(Session& session, const std::shared_ptr<RenderBackend>& next) {
    if (has_learned(session)) {
        try {
            session.apply(EditBackend{.backend = next, .forget_old = true});
            return true;
        } catch (const std::exception&) {
            // The old one cannot return its tables, or the new one fails: then so does the second try.
        }
    }
    session.apply(EditBackend{.backend = next, .abandon_old = true});
    return false;
}

}  // namespace

bool is_fault_of_backend(const std::exception& error) {
    const auto* known = dynamic_cast<const Error*>(&error);
    return known == nullptr || (known->kind() != ErrorKind::Usage && known->kind() != ErrorKind::Input);
}

std::string back_end_label(const std::string& name) {
    std::string label = name;
    for (char& c : label) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return label;
}

std::string reason_of(const std::exception& error, const std::string& backend) {
    const std::string text = error.what();
    const std::string label = back_end_label(backend) + ": ";
    return text.starts_with(label) ? text.substr(label.size()) : text;
}

BackendSwitch::BackendSwitch(Make make, BackendChoices choices, std::string first)
    : make_(std::move(make)), choices_(std::make_shared<const BackendChoices>(std::move(choices))),
      current_(std::move(first)) {}

std::unique_ptr<Session>
BackendSwitch::start(const std::function<std::unique_ptr<Session>(std::shared_ptr<RenderBackend>)>& make,
                     const std::function<void(const WorkerMessage&)>& told) {
    const auto start_on = [&](const std::string& name) {
        const std::shared_ptr<RenderBackend> backend = get(name);
        std::unique_ptr<Session> session = make(backend);
        adopt(name, backend);
        return session;
    };
    if (on_fallback()) return start_on(current_);
    try {
        return start_on(current_);
    } catch (const std::exception& error) {
        const std::string failed = current_;
        std::unique_ptr<Session> session = start_on(std::string(kFallback));
        const std::string reason = reason_of(error, failed);
        give_up(failed, reason);
        told({true,
              fmt::format("{} failed: {}. {} takes over", back_end_label(failed), reason, back_end_label(current_))});
        return session;
    }
}

WorkerMessage BackendSwitch::switch_to(Session& session, const std::string& name) {
    if (const std::string reason = choice(name).unavailable; !reason.empty())
        throw Error(ErrorKind::Unavailable, reason);
    const std::shared_ptr<RenderBackend> next = get(name);
    try {
        session.apply(EditBackend{.backend = next});
    } catch (const std::exception& error) {
        if (name == kFallback) return take_over(session, error);
        made_.erase(name);  // made anew on the next request: its contents are unknown
        throw;
    }
    adopt(name, next);
    return {false, fmt::format("{}: {}", back_end_label(name), choice(name).device)};
}

WorkerMessage BackendSwitch::take_over(Session& session, const std::exception& error) {
    const std::string failed = current_;
    const std::string reason = reason_of(error, failed);
    const bool learned = has_learned(session);
    const std::shared_ptr<RenderBackend> next = get(std::string(kFallback));
    const bool kept = leave(session, next);
    adopt(std::string(kFallback), next);
    give_up(failed, reason);
    const char* loss = !learned ? "" : (kept ? " with the learned fields" : "; the learned fields are lost");
    return {true, fmt::format("{} failed: {}. {} takes over{}", back_end_label(failed), reason,
                              back_end_label(current_), loss)};
}

std::shared_ptr<RenderBackend> BackendSwitch::get(const std::string& name) {
    const auto known = made_.find(name);
    return known != made_.end() ? known->second : std::shared_ptr<RenderBackend>(make_(name));
}

/// The session now uses this back end. Only adopted ones are kept: one that fails to take the scene frees its memory.
void BackendSwitch::adopt(const std::string& name, std::shared_ptr<RenderBackend> backend) {
    BackendChoice known = choice(name);
    known.device = device_text(backend->info());
    known.failed.clear();
    change_choice(known);
    made_[name] = std::move(backend);
    current_ = name;
}

void BackendSwitch::give_up(const std::string& name, const std::string& reason) {
    made_.erase(name);
    BackendChoice failed = choice(name);
    failed.failed = reason;
    change_choice(failed);
}

BackendChoice BackendSwitch::choice(const std::string& name) const {
    const auto known = std::ranges::find(*choices_, name, &BackendChoice::name);
    return known != choices_->end() ? *known : BackendChoice{.name = name, .device = "", .unavailable = ""};
}

void BackendSwitch::change_choice(const BackendChoice& changed) {
    auto choices = std::make_shared<BackendChoices>(*choices_);
    const auto known = std::ranges::find(*choices, changed.name, &BackendChoice::name);
    if (known != choices->end())
        *known = changed;
    else
        choices->push_back(changed);
    choices_ = std::move(choices);
}

}  // namespace pl::ui
