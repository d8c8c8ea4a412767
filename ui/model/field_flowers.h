// The distributions of every n-th volume as lobes in the scene, made in the background from the key frame that is shown.
#pragma once

#include <memory>

#include "ui/draw/lobes.h"
#include "ui/model/background_job.h"
#include "ui/model/learning_time.h"

namespace pl::ui {

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

    /// Null before they are made.
    const FlowerField* flowers() const { return flowers_.get(); }
    /// The triangles for a picture in `image`; made again only when field, scene, camera or window have changed: those of another
    /// field in the background, with the field.
    const ScreenMesh& mesh(const PublishedFrame& frame, const Rect& image);
    const FlowerCounts& counts() const { return mesh_.counts; }
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
        ScreenMesh triangles{};
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
    Mesh mesh_;
    std::uint64_t times_made_ = 0;
    std::unique_ptr<BackgroundJob<Made>> job_;
};

/// Flowers of a key frame: every `step`-th volume. `diagonal` of the scene decides their radius.
FlowerField make_flowers(const FieldKeyFrame& frame, int step, float diagonal, const StopFlag* stop = nullptr);

}  // namespace pl::ui
