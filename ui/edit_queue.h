// Edits on their way to the render thread: of each kind only the newest counts.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "core/session/edits.h"

namespace pl {

class EditQueue {
public:
    /// Replaces an edit of the same kind. The new one goes to the end, so that a camera that follows a scene is
    /// applied after it.
    void push(SessionEdit edit) {
        std::erase_if(edits_, [&](const SessionEdit& other) { return other.index() == edit.index(); });
        edits_.push_back(std::move(edit));
    }

    bool empty() const { return edits_.empty(); }

    /// All edits in order; the queue is empty afterwards.
    std::vector<SessionEdit> take() { return std::exchange(edits_, {}); }

private:
    std::vector<SessionEdit> edits_;
};

}  // namespace pl
