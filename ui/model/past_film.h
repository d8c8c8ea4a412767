// The past of a learned field as a film: the window as it is at each key frame.
#pragma once

#include <filesystem>
#include <optional>

#include "core/io/image.h"
#include "ui/model/field_flowers.h"
#include "ui/model/file_names.h"

namespace pl::ui {

/// Shows one key frame after the other, and writes the pixels of the window when all of it is drawn.
class PastFilm {
public:
    static constexpr int kFramesPerSecond = 5;  ///< as LearningTime plays them

    PastFilm(const ModelServices& services, const ViewedScene& scene, LearningTime& time, const FieldFlowers& flowers)
        : options_(services.options), messages_(services.messages), jobs_(services.jobs), scene_(scene), time_(time),
          flowers_(flowers) {}

    /// From the first key frame on; says why if there is none.
    void begin();
    /// Frames that are written stay.
    void stop();
    /// Frames written so far; empty while none is.
    std::optional<int> written() const { return is_writing_ ? std::optional(written_) : std::nullopt; }
    /// Once per frame of the window. Stops when something else changes the shown time.
    void update();

    /// Whether the frame of the window that is drawn now is the next one of the film, to be given to add().
    bool wants_pixels() const { return is_ready_; }
    void add(ByteImage pixels);

private:
    void show_next();
    void finish();

    const ViewerOptions& options_;
    Messages& messages_;
    Jobs& jobs_;
    const ViewedScene& scene_;
    LearningTime& time_;
    const FieldFlowers& flowers_;
    NumberedNames names_;
    std::filesystem::path folder_;
    int written_ = 0;
    std::uint64_t passes_ = 0;  ///< of the key frame that is shown
    bool is_writing_ = false;
    bool is_ready_ = false;
};

}  // namespace pl::ui
