#include "ui/model/bookmarks.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/hash.h"
#include "core/io/camera_file.h"
#include "core/io/picture_file.h"
#include "ui/draw/layout.h"
#include "ui/model/file_names.h"
#include "ui/model/programs.h"
#include "ui/model/thumbnail.h"

namespace pl::ui {
namespace {

std::string hash_text(std::string_view text) {
    Fnv1a hash;
    hash.add(text);
    return fmt::format("{:016x}", hash.value());
}

/// Mean color of a part of the frame, 8 bits per channel.
std::array<std::uint8_t, 3> mean_color(const std::uint32_t* argb, int pitch, const Rect& part) {
    std::array<std::uint32_t, 3> sum{};
    const int right = std::max(static_cast<int>(part.x + part.width), static_cast<int>(part.x) + 1);
    const int bottom = std::max(static_cast<int>(part.y + part.height), static_cast<int>(part.y) + 1);
    std::uint32_t count = 0;
    for (int y = static_cast<int>(part.y); y < bottom; ++y)
        for (int x = static_cast<int>(part.x); x < right; ++x, ++count) {
            const std::uint32_t color = argb[static_cast<std::ptrdiff_t>(y) * pitch + x];
            for (std::size_t c = 0; c < 3; ++c) sum[c] += color >> (16 - 8 * c) & 255u;
        }
    return {static_cast<std::uint8_t>(sum[0] / count), static_cast<std::uint8_t>(sum[1] / count),
            static_cast<std::uint8_t>(sum[2] / count)};
}

}  // namespace

ByteImage small_picture(const DisplayFrame& frame) {
    constexpr auto kSize = static_cast<std::size_t>(kThumbnailWidth * kThumbnailHeight);
    ByteImage image{kThumbnailWidth, kThumbnailHeight, std::vector<std::uint8_t>(3 * kSize)};
    const std::uint32_t* pixels = frame.pixels();
    const Rect place = place_image({0.0f, 0.0f, kThumbnailWidth, kThumbnailHeight}, frame.width, frame.height);
    const float across = static_cast<float>(frame.width) / place.width;
    const float down = static_cast<float>(frame.height) / place.height;
    for (int y = 0; y < static_cast<int>(place.height); ++y)
        for (int x = 0; x < static_cast<int>(place.width); ++x) {
            const Rect part{across * static_cast<float>(x), down * static_cast<float>(y), across, down};
            const auto color = mean_color(pixels, frame.width, part);
            const auto at = static_cast<std::size_t>((static_cast<int>(place.y) + y) * kThumbnailWidth +
                                                     static_cast<int>(place.x) + x);
            std::copy(color.begin(), color.end(), image.rgb.begin() + static_cast<std::ptrdiff_t>(3 * at));
        }
    return image;
}

void CameraBookmarks::set_folder(std::filesystem::path folder) {
    folder_ = std::move(folder);
    of_.clear();
}

void CameraBookmarks::update() {
    if (of_ != scene_.lasting_name()) load();
}

std::filesystem::path CameraBookmarks::file() const {
    if (folder_.empty()) return {};
    return folder_ / fmt::format("{}-{}.json", FileNames::stem_of(scene_), hash_text(of_));
}

std::filesystem::path CameraBookmarks::picture_file(const CameraDescription& camera) const {
    return folder_ / (hash_text(of_ + camera_json(camera).dump()) + ".png");
}

void CameraBookmarks::load() {
    of_ = scene_.lasting_name();
    list_.clear();
    current_.reset();
    std::error_code ignored;
    if (folder_.empty() || !std::filesystem::exists(file(), ignored)) {
        for (const NamedCamera& camera : scene_.materials().file()->cameras)
            list_.push_back({.camera = camera.camera});
        return;
    }
    try {
        for (const CameraDescription& camera : load_cameras(file(), camera_.camera())) {
            auto picture = read_thumbnail(picture_file(camera));
            list_.push_back({camera, picture ? std::make_shared<const ByteImage>(*std::move(picture)) : nullptr});
        }
    } catch (const Error& error) {
        messages_.say(MessageLevel::Warning, fmt::format("the bookmarks are not read: {}", error.what()));
    }
}

/// All of them are written again: the file is small, and its order matters.
void CameraBookmarks::save() {
    if (folder_.empty()) return;
    std::vector<std::pair<std::filesystem::path, std::shared_ptr<const ByteImage>>> pictures;
    for (const Bookmark& bookmark : list_)
        if (bookmark.picture) pictures.emplace_back(picture_file(bookmark.camera), bookmark.picture);
    jobs_.push([file = file(), cameras = cameras(), pictures = std::move(pictures)]() -> Jobs::Report {
        make_folder(file.parent_path());
        save_cameras(file, cameras);
        for (const auto& [path, picture] : pictures)
            if (!std::filesystem::exists(path)) write_thumbnail(path, *picture);
        return [] {};
    });
}

void CameraBookmarks::add() {
    Bookmark bookmark{.camera = camera_.camera()};
    if (const auto& frame = link_.frame()) {
        try {
            bookmark.picture = std::make_shared<const ByteImage>(small_picture(frame->picture));
        } catch (const Error&) {
            bookmark.picture = nullptr;  // the device is lost: the render thread reports it
        }
    }
    const std::size_t place = current_ ? *current_ + 1 : list_.size();
    list_.insert(list_.begin() + static_cast<std::ptrdiff_t>(place), std::move(bookmark));
    current_ = place;
    messages_.say(MessageLevel::Info, fmt::format("bookmark {} of {}", place + 1, list_.size()));
    save();
}

void CameraBookmarks::show(std::size_t index) {
    if (index >= list_.size()) return;
    current_ = index;
    camera_.set(list_[index].camera);
}

void CameraBookmarks::step(int steps) {
    if (list_.empty()) {
        messages_.say(MessageLevel::Info, "this scene has no bookmarks: F8 makes one of the camera");
        return;
    }
    const auto count = static_cast<int>(list_.size());
    const int from = current_ ? static_cast<int>(*current_) : (steps > 0 ? -1 : 0);
    show(static_cast<std::size_t>(((from + steps) % count + count) % count));
}

void CameraBookmarks::remove(std::size_t index) {
    if (index >= list_.size()) return;
    const std::filesystem::path picture = picture_file(list_[index].camera);
    list_.erase(list_.begin() + static_cast<std::ptrdiff_t>(index));
    if (current_ && *current_ >= index) {
        if (*current_ == index && index == 0) current_.reset();
        if (current_) --*current_;
    }
    const bool is_shared =
        std::ranges::any_of(list_, [&](const Bookmark& other) { return picture_file(other.camera) == picture; });
    save();
    if (folder_.empty() || is_shared) return;
    jobs_.push([picture]() -> Jobs::Report {
        std::filesystem::remove(picture);
        return [] {};
    });
}

void CameraBookmarks::move(std::size_t index, int places) {
    const auto to = static_cast<std::ptrdiff_t>(index) + places;
    if (index >= list_.size() || to < 0 || to >= static_cast<std::ptrdiff_t>(list_.size())) return;
    std::swap(list_[index], list_[static_cast<std::size_t>(to)]);
    if (current_ == index)
        current_ = static_cast<std::size_t>(to);
    else if (current_ == static_cast<std::size_t>(to))
        current_ = index;
    save();
}

std::vector<CameraDescription> CameraBookmarks::cameras() const {
    std::vector<CameraDescription> cameras;
    for (const Bookmark& bookmark : list_) cameras.push_back(bookmark.camera);
    return cameras;
}

std::optional<CameraPath> CameraBookmarks::path() const {
    if (list_.size() < CameraPath::kFewest) return std::nullopt;
    return CameraPath(cameras());
}

namespace {

constexpr const char* kTooFew = "a path needs at least two bookmarks: F8 makes one of the camera";

}  // namespace

void CameraFlight::toggle() {
    if (is_flying()) return stop();
    path_ = bookmarks_.path();
    start_.reset();
    if (!path_) messages_.say(MessageLevel::Info, kTooFew);
}

void CameraFlight::update(double seconds) {
    if (!path_) return;
    if (start_ && camera_.generation() != generation_) return stop();
    if (!start_) start_ = seconds;
    const double at = (seconds - *start_) / std::max(static_cast<double>(seconds_per_camera_), 0.01);
    camera_.set(path_->at(at));
    generation_ = camera_.generation();
    if (at >= static_cast<double>(path_->size() - 1)) stop();
}

void SequenceWriter::begin() {
    auto path = bookmarks_.path();
    if (!path) return messages_.say(MessageLevel::Info, kTooFew);
    if (wanted_.spp == 0 && !(wanted_.seconds > 0.0f))
        return messages_.say(MessageLevel::Info, "a frame needs a limit: samples or seconds above 0");
    const std::string stem = std::filesystem::path(pictures_.picture().scene.name).stem().string();
    folder_ = names_.next(viewer_.screenshot_dir, file_name_part(stem) + "-sequence", {"", ".mp4"});
    try {
        make_folder(folder_);
        save_cameras(path_file(), bookmarks_.cameras());
    } catch (const Error& error) {
        return messages_.say(MessageLevel::Error, error.what());
    }
    path_ = std::move(path);
    now_ = wanted_;
    limits_before_ = render_.limits();
    render_.set_limits(limits_of_frame());
    written_ = 0;
    show_frame();
}

void SequenceWriter::show_frame() {
    is_saving_ = false;
    camera_.set(path_->frame(written_, now_.frames));
    generation_ = camera_.generation();
}

std::filesystem::path SequenceWriter::file() const { return frame_file(folder_, written_, now_.kind); }

std::filesystem::path SequenceWriter::path_file() const { return folder_ / "cameras.json"; }

SampleLimits SequenceWriter::limits_of_frame() const {
    return {.spp = static_cast<std::uint32_t>(now_.spp), .seconds = static_cast<double>(now_.seconds)};
}

/// The whole picture of the camera, with all of its samples.
bool SequenceWriter::is_frame_done() const {
    const auto& frame = link_.frame();
    const WorkerStatus& status = link_.status();
    return status.state == WorkerState::Done && status.generation >= generation_ && !camera_.is_moving() && frame &&
           frame->generation >= generation_ && frame->divider == 1 && frame->preview == Preview::None &&
           frame->snapshot.passes == status.passes;
}

void SequenceWriter::update() {
    if (!path_) return;
    if (camera_.generation() != generation_) return stop();
    if (!is_saving_) {
        if (!is_frame_done()) return;
        pictures_.save_as(file());
        is_saving_ = true;
    }
    if (pictures_.is_waiting()) return;
    if (++written_ < now_.frames)
        show_frame();
    else
        finish();
}

void SequenceWriter::stop() {
    if (!path_) return;
    path_.reset();
    render_.set_limits(limits_before_);
    messages_.say(MessageLevel::Warning, fmt::format("stopped: {} of {} frames are in {}, the one under way is lost",
                                                     written_, now_.frames, folder_.string()));
}

std::string SequenceWriter::command() const {
    if (!viewer_.command_line) return "";
    ViewerPicture picture = pictures_.picture();
    picture.sequence = {.folder = folder_,
                        .cameras = path_file(),
                        .frames = now_.frames,
                        .kind = now_.kind,
                        .limits = limits_of_frame()};
    return viewer_.command_line(picture);
}

void SequenceWriter::finish() {
    const std::string same = command();
    path_.reset();
    render_.set_limits(limits_before_);
    if (now_.kind == ImageKind::Png)
        jobs_.push([this, folder = folder_]() -> Jobs::Report {
            return [this, text = make_film(folder, kFramesPerSecond)] { messages_.say(MessageLevel::Info, text); };
        });
    else
        messages_.say(MessageLevel::Info, fmt::format("{} frames are in {}", written_, folder_.string()));
    if (!same.empty()) messages_.note(MessageLevel::Info, "the same path without a window: " + same);
}

std::optional<SequenceWriter::Written> SequenceWriter::progress() const {
    return path_ ? std::optional(Written{written_, now_.frames}) : std::nullopt;
}

}  // namespace pl::ui
