// The distributions of every n-th volume as lobes in the scene, made in the background from the key frame that is shown.
#pragma once

#include <map>
#include <memory>
#include <optional>

#include "ui/draw/lobes.h"
#include "ui/model/jobs.h"
#include "ui/model/render_link.h"

namespace pl::ui {

/// The past of a learned field: key frames of it, and the one that the window shows in place of the present.
class LearningTime {
public:
    static constexpr int kStandardMegabytes = 256;
    static constexpr double kFrameSeconds = 0.2;  ///< of a key frame while they are played

    explicit LearningTime(RenderLink& link) : link_(link), history_(link.worker().history()) {}

    /// Key frames are taken while they are kept. Otherwise none is, and they cost nothing.
    bool keeps() const { return keeps_; }
    void set_keeps(bool keeps);
    int megabytes() const { return megabytes_; }
    void set_megabytes(int megabytes);
    /// The newest key frame is needed for another display, whether the past is kept or not.
    void set_newest_needed(bool needed);

    /// Once per frame of the window, with its clock.
    void update(double seconds);

    /// Never null.
    const std::shared_ptr<const FieldHistory>& history() const { return history_; }
    /// Index of the key frame that is shown; empty: the present.
    std::optional<std::size_t> shown() const { return shown_; }
    void show(std::optional<std::size_t> frame);
    const FieldKeyFrame* frame() const { return shown_ ? history_->frames[*shown_].get() : nullptr; }
    /// The same, to be kept for longer than a frame of the window.
    std::shared_ptr<const FieldKeyFrame> shown_frame() const { return shown_ ? history_->frames[*shown_] : nullptr; }
    /// Plays key frames to the present and back.
    bool is_playing() const { return is_playing_; }
    void set_playing(bool playing);

    /// A volume at the shown time; null for the present, and before there was such a volume.
    std::shared_ptr<const VolumeInspection> inspection(std::int32_t volume);

private:
    void take_history();
    void play(double seconds);
    void send_limit();

    RenderLink& link_;
    std::shared_ptr<const FieldHistory> history_;
    bool keeps_ = false;
    bool newest_needed_ = false;
    int megabytes_ = kStandardMegabytes;
    std::optional<std::size_t> shown_;
    bool is_playing_ = false;
    int direction_ = 1;
    double stepped_ = 0.0;  ///< when the shown frame last changed, seconds
    std::map<std::int32_t, std::shared_ptr<const VolumeInspection>> inspections_;  ///< of the shown frame
};

class FieldFlowers {
public:
    FieldFlowers(RenderLink& link, LearningTime& time) : link_(link), time_(time) {}

    /// Hidden they cost nothing.
    bool is_shown() const { return is_shown_; }
    void set_shown(bool shown);
    /// Every step-th volume, at least as many as leave kMostFlowers.
    int step() const { return step_; }
    void set_step(int step) { step_ = step; }
    /// Once per frame of the window.
    void update();

    /// Hidden, or made of the key frame that is shown.
    bool is_current() const { return !is_shown_ || (!job_ && begun_ == wanted()); }
    /// Null before they are made.
    const FlowerField* flowers() const { return flowers_.get(); }
    /// The triangles for a picture in `image`; made again only when field, scene, camera or window have changed. For
    /// another field they are made in the background, with the field.
    std::shared_ptr<const ScreenMesh> mesh(const PublishedFrame& frame, const Rect& image);
    const FlowerCounts& counts() const { return meshes_[0].counts; }
    /// Number of times that the triangles were made.
    std::uint64_t times_made() const { return times_made_; }

private:
    /// The inputs of the triangles.
    struct MeshKey {
        std::shared_ptr<const FlowerField> flowers{};
        std::shared_ptr<const HostScene> scene{};
        std::array<Vec3f, 3> camera{};
        std::array<float, 7> view{};  ///< field of view, size of the picture, its place in the window

        Projection projection() const;
        friend bool operator==(const MeshKey&, const MeshKey&) = default;
    };
    struct Mesh {
        MeshKey key{};
        std::shared_ptr<const ScreenMesh> triangles = std::make_shared<const ScreenMesh>();
        FlowerCounts counts{};
    };
    /// Null without flowers or scene.
    using Made = std::shared_ptr<const Mesh>;

    static Mesh make_mesh(MeshKey key);

    std::shared_ptr<const FieldKeyFrame> wanted() const;

    RenderLink& link_;
    LearningTime& time_;
    bool is_shown_ = false;
    int step_ = 1;
    std::shared_ptr<const FieldKeyFrame> begun_;
    int begun_step_ = 0;
    std::shared_ptr<const FlowerField> flowers_;
    std::array<Mesh, 2> meshes_{};  ///< the newest first: compared pictures have a place each
    std::uint64_t times_made_ = 0;
    std::unique_ptr<BackgroundJob<Made>> job_;
};

/// Flowers of a key frame: every `step`-th volume. `diagonal` of the scene decides their radius.
FlowerField make_flowers(const FieldKeyFrame& frame, int step, float diagonal, const StopFlag* stop = nullptr);

}  // namespace pl::ui
