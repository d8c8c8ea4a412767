// Edits on their way to the render thread: of each kind, and of each material, only the newest counts.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "core/session/edits.h"

namespace pl {

class EditQueue {
public:
    /// Replaces an edit of the same kind, of materials one of the same material; a scene replaces all that was asked of
    /// materials before. The new one goes to the end, so that a camera that follows a scene is applied after it.
    void push(SessionEdit edit) {
        std::erase_if(edits_, [&](const SessionEdit& other) { return replaces(edit, other); });
        edits_.push_back(std::move(edit));
    }

    bool empty() const { return edits_.empty(); }

    /// All edits in order; the queue is empty afterwards.
    std::vector<SessionEdit> take() { return std::exchange(edits_, {}); }

private:
    static bool replaces(const SessionEdit& edit, const SessionEdit& other) {
        const auto* old = std::get_if<EditMaterial>(&other);
        if (old == nullptr) return edit.index() == other.index();
        const auto* material = std::get_if<EditMaterial>(&edit);
        return material != nullptr ? material->index == old->index : std::holds_alternative<EditScene>(edit);
    }

    std::vector<SessionEdit> edits_;
};

}  // namespace pl
