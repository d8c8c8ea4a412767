// Edits queued for the render thread: of each kind, and of each material and forgotten volume, only the newest is kept.
#pragma once

#include <algorithm>
#include <utility>
#include <variant>
#include <vector>

#include "core/session/edits.h"

namespace pl::ui {

/// Another method or view in the window: the render thread turns to another film of the session.
struct EditMethod {
    MethodId method;
};
struct EditView {
    View view;
};

/// A change to the session, or to the film that is shown.
using WorkerEdit = std::variant<SessionEdit, EditMethod, EditView>;

/// The session edit of this kind, or null.
template <class Edit>
const Edit* find_edit(const WorkerEdit& edit) {
    const auto* change = std::get_if<SessionEdit>(&edit);
    return change != nullptr ? std::get_if<Edit>(change) : nullptr;
}

class EditQueue {
public:
    /// Replaces an edit of the same kind, of materials one of the same material; a scene replaces all edits of materials
    /// before it. The new edit goes to the end, so that a camera that follows a scene is applied after it.
    void push(WorkerEdit edit) {
        std::erase_if(edits_, [&](const WorkerEdit& other) { return replaces(edit, other); });
        edits_.push_back(std::move(edit));
    }

    bool empty() const { return edits_.empty(); }

    /// All edits in order; the queue is empty afterwards.
    std::vector<WorkerEdit> take() { return std::exchange(edits_, {}); }

private:
    static bool replaces(const WorkerEdit& edit, const WorkerEdit& other) {
        if (const auto* old = find_edit<EditMaterial>(other)) {
            const auto* material = find_edit<EditMaterial>(edit);
            return material != nullptr ? material->index == old->index : find_edit<EditScene>(edit) != nullptr;
        }
        if (const auto* old = find_edit<EditForgetVolume>(other)) {
            const auto* forget = find_edit<EditForgetVolume>(edit);
            if (forget != nullptr) return forget->volume == old->volume && forget->method == old->method;
            return find_edit<EditScene>(edit) != nullptr || find_edit<EditForget>(edit) != nullptr;
        }
        if (edit.index() != other.index()) return false;
        const auto* change = std::get_if<SessionEdit>(&edit);
        return change == nullptr || change->index() == std::get<SessionEdit>(other).index();
    }

    std::vector<WorkerEdit> edits_;
};

}  // namespace pl::ui
