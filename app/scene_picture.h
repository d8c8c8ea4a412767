// Pictures of the learned field and of paths, in the scene: drawn by the viewer's code, which a build without a viewer lacks.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/options.h"
#include "core/diagnose/record_path.h"
#include "core/inspect/guiding_figures.h"
#include "core/io/image.h"
#include "core/measure/gain.h"
#include "core/session/session.h"

namespace pl {

/// Throws Error(Unavailable) in a build without a viewer.
void require_viewer_code(const std::string& option);

/// The first surfaces as the camera sees them, lit by light samples of a few passes, with a volume as Options::drawn says.
ByteImage draw_in_scene(Session& session, std::int32_t volume, const Options& options);

/// The hemisphere of a volume as discs below lines of text, each over its own values: learned radiance, probability and visits. With a `truth`
/// the learned beside the true radiance, and the density of guided paths beside the density that leaves no variance, both relative to cosine
/// sampling: those of a row on one scale.
ByteImage draw_discs(const VolumeInspection& volume, const CameraDescription& camera,
                     const std::vector<std::string>& lines, const LightReport* truth);

/// A film that has a pass, with a mark for each tile.
ByteImage draw_gains(Session& session, FilmSlot slot, const TileGains& gains, const DisplaySettings& display);

/// The same surfaces as draw_in_scene() shows, with paths of a pixel as lines.
ByteImage draw_path_lines(Session& session, const std::vector<diagnose::PathRecord>& paths, const Options& options);

/// A volume at one of the key frames of a field.
struct HistoryPoint {
    std::uint64_t passes = 0;  ///< that trained the field
    GuidingFigures figures;
    double divergence_to_end = 0.0;  ///< Kullback-Leibler, of the last frame from this one, nats; may be infinite
    double variation_to_end = 0.0;   ///< total variation, in [0, 1]
};

/// Key frames of the field that a session trains, see FieldHistoryRecorder.
class FieldPast {
public:
    FieldPast();
    ~FieldPast();
    /// The number of passes for the key frame after the key frame of `passes`.
    static std::uint32_t next(std::uint32_t passes);
    /// After each piece of work.
    void observe(const Session& session, MethodId method);
    std::vector<HistoryPoint> points(const IncidentLight& light, std::int32_t volume, TargetLight target) const;

private:
    struct Kept;
    std::unique_ptr<Kept> kept_;
};

/// Their figures as curves.
ByteImage draw_history(const std::vector<HistoryPoint>& points);

}  // namespace pl
