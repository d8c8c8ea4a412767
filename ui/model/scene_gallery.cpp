#include "ui/model/scene_gallery.h"

#include <algorithm>
#include <exception>

#include <fmt/format.h>

#include "core/io/json_file.h"
#include "ui/model/thumbnail.h"

namespace pl::ui {

void SceneGallery::set_shown(bool is_shown) {
    is_shown_ = is_shown;
    if (!is_shown_ && job_) job_->stop();
}

void SceneGallery::update() {
    {
        const std::lock_guard lock(incoming_.mutex);
        pictures_.merge(incoming_.pictures);
        drafts_.merge(incoming_.drafts);
    }
    if (job_) {
        const auto result = job_->take_result();
        if (!result) return;
        job_.reset();
        link_.hold(RenderLink::Hold::Gallery, false);
        is_complete_ = result->value.is_complete;
        if (!result->value.failure.empty()) messages_.note(MessageLevel::Warning, result->value.failure);
    }
    if (is_shown_ && !is_complete_) start();
}

void SceneGallery::start() {
    std::vector<std::string> missing;
    for (const std::string& name : options_.scenes)
        if (!pictures_.contains(name)) missing.push_back(name);
    link_.hold(RenderLink::Hold::Gallery, true);
    job_ = std::make_unique<BackgroundJob<Outcome>>(
        [this, missing, folder = folder_](const JobMonitor& monitor) { return make_all(missing, folder, monitor); });
}

SceneGallery::Outcome SceneGallery::make_all(const std::vector<std::string>& names,
                                             const std::filesystem::path& folder, const JobMonitor& monitor) {
    Outcome outcome;
    show_drafts(names, folder, monitor);
    for (const std::string& name : names) {
        if (*monitor.stop) return outcome;
        try {
            if (auto image = make(name, folder, monitor, outcome))
                hand_over(&Incoming::pictures, name, *std::move(image));
        } catch (const std::exception& error) {
            outcome.failure = fmt::format("no picture of the scene {}: {}", name, error.what());
        }
    }
    outcome.is_complete = !*monitor.stop;
    return outcome;
}

void SceneGallery::show_drafts(const std::vector<std::string>& names, const std::filesystem::path& folder,
                               const JobMonitor& monitor) {
    for (const std::string& name : names) {
        if (*monitor.stop) return;
        try {
            const std::shared_ptr<const SceneDescription> scene = options_.load_scene({name});
            if (auto kept = folder.empty() ? std::nullopt : read_thumbnail(folder / thumbnail_name(*scene)))
                hand_over(&Incoming::pictures, name, *std::move(kept));
            else if (auto draft =
                         render_thumbnail(scene, options_.make_side_backend, ThumbnailQuality::Draft, monitor.stop))
                hand_over(&Incoming::drafts, name, *std::move(draft));
        } catch (const std::exception&) {
            continue;  // the whole picture's failure is told
        }
    }
}

void SceneGallery::hand_over(Pictures Incoming::*kind, const std::string& name, ByteImage image) {
    const std::lock_guard lock(incoming_.mutex);
    (incoming_.*kind).emplace(name, std::make_shared<const ByteImage>(std::move(image)));
}

/// Empty if it was stopped. A picture that cannot be kept is shown all the same.
std::optional<ByteImage> SceneGallery::make(const std::string& name, const std::filesystem::path& folder,
                                            const JobMonitor& monitor, Outcome& outcome) const {
    const std::shared_ptr<const SceneDescription> scene = options_.load_scene({name});
    const std::filesystem::path file = folder / thumbnail_name(*scene);
    if (!folder.empty())
        if (auto kept = read_thumbnail(file)) return kept;
    auto image = render_thumbnail(scene, options_.make_side_backend, ThumbnailQuality::Whole, monitor.stop);
    if (!image || folder.empty()) return image;
    try {
        make_folder(folder);
        write_thumbnail(file, *image);
    } catch (const std::exception& error) {
        outcome.failure = fmt::format("pictures of scenes cannot be kept: {}", error.what());
    }
    return image;
}

std::size_t SceneGallery::shown() const {
    return static_cast<std::size_t>(
        std::ranges::count_if(options_.scenes, [this](const std::string& name) { return picture(name) != nullptr; }));
}

std::shared_ptr<const ByteImage> SceneGallery::picture(const std::string& scene) const {
    for (const Pictures* const pictures : {&pictures_, &drafts_})
        if (const auto found = pictures->find(scene); found != pictures->end()) return found->second;
    return nullptr;
}

}  // namespace pl::ui
