#include "ui/model/open_dialog.h"

#include <algorithm>
#include <system_error>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/io/files.h"
#include "core/io/load_scene.h"

namespace pl::ui {
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
    jobs_.push([this, folder, look]() -> JobThread::Report {
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
