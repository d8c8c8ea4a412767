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

namespace {

using SceneCards = std::map<std::string, SceneCard>;

/// A scene without a picture has no card: its name is shown.
SceneCards read_cards(const std::vector<std::string>& scenes, const std::filesystem::path& folder) {
    SceneCards cards;
    for (const std::string& name : scenes) {
        try {
            ImageMetadata metadata;
            ByteImage picture = read_png8(folder / name / (name + ".png"), &metadata);
            cards[name] = {std::make_shared<const ByteImage>(std::move(picture)), text_of(metadata, "summary")};
        } catch (const Error&) {
            continue;
        }
    }
    return cards;
}

}  // namespace

void OpenDialog::toggle() {
    is_shown_ = !is_shown_;
    if (is_shown_ && cards_.empty())
        jobs_.push([this]() -> Jobs::Report {
            const SceneCards cards = read_cards(scenes(), options_.scenes_folder);
            return [this, cards] { cards_ = cards; };
        });
    if (is_shown_) browse(listing_.folder.empty() ? std::filesystem::path(".") : listing_.folder);
}

const SceneCard* OpenDialog::card(const std::string& scene) const {
    const auto found = cards_.find(scene);
    return found != cards_.end() ? &found->second : nullptr;
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
