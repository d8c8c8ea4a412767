// Key frames of a learned field while it learns, for displays of the past.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/session/session.h"

namespace pl::ui {

/// A learned field as it was after some passes. Immutable.
class FieldKeyFrame {
public:
    /// `passes` have trained it. `bsdf_fraction`: that of the settings, if it is not learned.
    FieldKeyFrame(LearnedField learned, std::uint64_t passes, std::optional<float> bsdf_fraction);
    FieldKeyFrame(const FieldKeyFrame&) = delete;
    FieldKeyFrame& operator=(const FieldKeyFrame&) = delete;

    MethodId method() const { return learned_.method; }
    std::uint64_t passes() const { return passes_; }
    /// Volumes are only ever added: a number means the same volume in all frames of a history.
    std::size_t volumes() const { return learned_.volumes->normals.size(); }
    Vec3f position(std::size_t volume) const { return learned_.volumes->sites[volume].position; }
    Vec3f normal(std::size_t volume) const { return learned_.volumes->normals[volume]; }
    int bins() const { return learned_.shape.cells.count(); }
    int side() const { return learned_.shape.cells.side; }  ///< of a table of cells
    const std::string& scene_hash() const { return learned_.scene_hash; }
    std::size_t bytes() const { return bytes_; }

    /// `volume` < volumes().
    VolumeInspection inspect(std::int32_t volume) const;
    std::vector<float> probabilities(std::int32_t volume) const { return cell_probabilities(view_, volume); }

private:
    LearnedField learned_;
    std::uint64_t passes_;
    std::optional<float> bsdf_fraction_;
    AnyFieldView view_;  ///< of `learned_`
    std::size_t bytes_ = 0;
};

/// Frames in the order of their passes.
struct FieldHistory {
    std::vector<std::shared_ptr<const FieldKeyFrame>> frames{};
    std::size_t bytes = 0;    ///< of all frames
    std::size_t evicted = 0;  ///< frames given up for others
};

/// The frame to give up: that whose neighbors are nearest to each other in proportion of their passes, the earlier of equal ones,
/// never the first or the last. Frames so stay spread evenly over the logarithm of the passes. `passes`: at least three, ascending.
std::size_t frame_to_evict(const std::vector<std::uint64_t>& passes);

/// Passes after which a key frame follows one that was taken after `passes`, where passes come one by one.
std::uint64_t next_key_frame(std::uint64_t passes);

/// Takes key frames: after each of the first 16 passes that train the field, then whenever the passes have grown by a quarter.
class FieldHistoryRecorder {
public:
    /// Memory for frames; 0 gives all up and takes none. The first and the last frame are kept in any case.
    void set_limit(std::size_t bytes);
    std::size_t limit() const { return limit_; }
    /// After each piece of work: takes a frame of the field that `method` shows if it is due. A field that began anew, or is another
    /// method's, begins a new history. Returns whether the history changed.
    bool observe(const Session& session, MethodId method);

    /// Never null.
    std::shared_ptr<const FieldHistory> history() const { return history_; }

private:
    bool is_due(std::uint64_t passes) const;
    void add(std::shared_ptr<const FieldKeyFrame> frame);

    std::size_t limit_ = 0;
    std::shared_ptr<const FieldHistory> history_ = std::make_shared<const FieldHistory>();
};

}  // namespace pl::ui
