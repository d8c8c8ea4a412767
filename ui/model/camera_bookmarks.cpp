#include "ui/model/camera_bookmarks.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/hash.h"
#include "core/io/camera_file.h"
#include "ui/draw/layout.h"
#include "ui/model/file_names.h"
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
    jobs_.push([file = file(), cameras = cameras(), pictures = std::move(pictures)]() -> JobThread::Report {
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
    jobs_.push([picture]() -> JobThread::Report {
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

}  // namespace pl::ui
