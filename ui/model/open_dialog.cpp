#include "ui/model/open_dialog.h"

#include <algorithm>
#include <exception>
#include <system_error>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/io/files.h"
#include "core/io/json_file.h"
#include "core/io/load_scene.h"
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
            else if (auto draft = render_thumbnail(scene, options_.make_side_backend, true, monitor.stop))
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
    auto image = render_thumbnail(scene, options_.make_side_backend, false, monitor.stop);
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

namespace {

bool can_be_opened(const std::filesystem::path& file) {
    const std::string suffix = suffix_of(file);
    return is_scene_suffix(suffix) || suffix == kFieldSuffix;
}

}  // namespace

FolderListing list_folder(const std::filesystem::path& folder) {
    std::error_code error;
    FolderListing listing{.folder = std::filesystem::absolute(folder).lexically_normal(), .folders = {}, .files = {}};
    std::filesystem::directory_iterator entry(folder, error);
    if (error)
        throw Error(ErrorKind::Input,
                    fmt::format("{}: expected a folder or a scene: {}", folder.string(), error.message()));
    for (; !error && entry != std::filesystem::directory_iterator(); entry.increment(error)) {
        const std::string name = entry->path().filename().string();
        std::error_code ignored;
        if (name.starts_with('.')) continue;
        if (entry->is_directory(ignored))
            listing.folders.push_back(name);
        else if (can_be_opened(name))
            listing.files.push_back(name);
    }
    std::ranges::sort(listing.folders);
    std::ranges::sort(listing.files);
    return listing;
}

void OpenDialog::update() {
    gallery_.set_shown(is_shown_);
    gallery_.update();
}

void OpenDialog::toggle() {
    is_shown_ = !is_shown_;
    if (is_shown_) browse(listing_.folder.empty() ? std::filesystem::path(".") : listing_.folder);
}

void OpenDialog::browse(const std::filesystem::path& folder) {
    const std::uint64_t look = ++newest_look_;
    jobs_.push([this, folder, look]() -> Jobs::Report {
        const FolderListing listing = list_folder(folder);
        return [this, listing, look] {
            if (look == newest_look_) listing_ = listing;
        };
    });
}

void OpenDialog::open(const std::string& name) {
    if (name.empty()) return;
    const bool is_scene = std::ranges::find(scenes(), name) != scenes().end();
    if (!is_scene && !can_be_opened(name)) {
        browse(name);
        return;
    }
    files_.open(name);
    is_shown_ = false;
}

}  // namespace pl::ui
