#include "ui/model/thumbnail.h"

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/hash.h"
#include "core/io/picture_file.h"
#include "core/scene/scene_hash.h"
#include "core/session/session.h"

namespace pl::ui {
namespace {

/// Grows when the same scene gets another picture.
constexpr std::uint64_t kThumbnailVersion = 1;
constexpr std::uint32_t kThumbnailSamples = 64;
constexpr std::uint32_t kDraftSamples = 4;
/// The PNG decoder does not check the bytes of the picture.
constexpr const char* kPixelsKey = "pixels";

std::string hash_text(std::uint64_t value) { return fmt::format("{:016x}", value); }

std::string pixels_hash(const ByteImage& image) {
    Fnv1a hash;
    hash.add(std::string_view(reinterpret_cast<const char*>(image.rgb.data()), image.rgb.size()));
    return hash_text(hash.value());
}

}  // namespace

std::string thumbnail_name(const SceneDescription& scene) {
    Fnv1a hash;
    hash.add(kThumbnailVersion);
    hash.add(std::string_view(scene_hash(scene)));
    const CameraDescription& camera = scene.camera;
    for (const glm::vec3& point : {camera.eye, camera.target, camera.up})
        for (int i = 0; i < 3; ++i) hash.add(point[i]);
    for (const float value :
         {camera.fov_deg, camera.aperture_radius, camera.focus_distance, camera.shift.x, camera.shift.y})
        hash.add(value);
    return hash_text(hash.value()) + ".png";
}

std::optional<ByteImage> read_thumbnail(const std::filesystem::path& file) {
    try {
        ImageMetadata metadata;
        ByteImage image = read_png8(file, &metadata);
        const bool is_whole = image.width == kThumbnailWidth && image.height == kThumbnailHeight &&
                              text_of(metadata, kPixelsKey) == pixels_hash(image);
        return is_whole ? std::optional(std::move(image)) : std::nullopt;
    } catch (const Error&) {
        return std::nullopt;
    }
}

void write_thumbnail(const std::filesystem::path& file, const ByteImage& image) {
    write_png8(file, image, {{"Software", "pathlight " PL_VERSION}, {kPixelsKey, pixels_hash(image)}});
}

std::optional<ByteImage> render_thumbnail(std::shared_ptr<const SceneDescription> scene,
                                          const BackendFactory& make_backend, bool is_draft, const StopFlag* stop) {
    RenderSettings settings;
    settings.method = is_draft ? MethodId::Default : learning_method();
    settings.next_event = true;
    settings.width = kThumbnailWidth;
    settings.height = kThumbnailHeight;
    settings.camera = scene->camera;
    const FilmSlot slot = slot_of(settings);
    Session session(make_backend("cpu"), std::move(scene), settings);
    while (session.passes(slot) < (is_draft ? kDraftSamples : kThumbnailSamples))
        if (session.advance(slot, stop) == Progress::Stopped) return std::nullopt;
    return display_image(session.snapshot(slot), {});
}

}  // namespace pl::ui
