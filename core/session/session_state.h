// The state of a session between two pieces of work, taken out to the bit: the content of checkpoints.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/fields/field_model.h"
#include "core/fields/refine_placement.h"
#include "core/session/learned_field.h"
#include "core/session/session_films.h"

namespace pl {

struct SavedFilm {
    FilmSlot slot;
    FilmProgress progress{};
    std::vector<FilmPixel> pixels{};  ///< [row][column]; none if the film is not allocated
};

struct SavedField {
    MethodId method = MethodId::Default;
    FieldProgress progress{};
    HostField arrays{};  ///< empty if there is none
};

struct SavedPlacement {
    FieldSettings settings{};
    FieldShape shape{};
    Refinement refinement{};
    double seconds = 0.0;
    std::shared_ptr<const HostVolumes> volumes;
};

struct SessionState {
    /// Scene, kind of back end and settings, by name and value: these have to be the same where the state is put back.
    std::vector<std::pair<std::string, std::string>> identity;
    std::optional<SavedPlacement> placement;
    std::vector<SavedField> fields;
    std::vector<SavedFilm> films;
    std::optional<bool> is_closed;  ///< see SessionScene
};

}  // namespace pl
