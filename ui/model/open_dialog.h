// The dialog that opens scenes: the known ones, those opened last, and the files of a folder.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/io/image.h"
#include "ui/model/files.h"
#include "ui/model/jobs.h"

namespace pl::ui {

/// What the dialog shows of a known scene.
struct SceneCard {
    std::shared_ptr<const ByteImage> picture;
    std::string summary;  ///< one line
};

/// The entries of a folder, sorted, without hidden files.
struct FolderListing {
    std::filesystem::path folder;  ///< absolute
    std::vector<std::string> folders;
    std::vector<std::string> files;  ///< scenes and learned fields, by their suffixes
};
/// Throws Error(Input) if the folder cannot be read.
FolderListing list_folder(const std::filesystem::path& folder);

class OpenDialog {
public:
    OpenDialog(const ModelServices& services, Files& files)
        : options_(services.options), jobs_(services.jobs), files_(files) {}

    bool& is_shown() { return is_shown_; }
    bool is_shown() const { return is_shown_; }
    /// Opens it, with a new look at the folder that it showed last, at first the working directory; or closes it.
    void toggle();

    const std::vector<std::string>& scenes() const { return options_.scenes; }
    /// Null before it is read, and for scenes without a picture.
    const SceneCard* card(const std::string& scene) const;
    std::size_t card_count() const { return cards_.size(); }
    const FolderListing& listing() const { return listing_; }
    /// Looks into another folder on the helper thread. If it cannot be read, the old one stays, with a message.
    void browse(const std::filesystem::path& folder);

    /// The chosen name or path, opened by Enter.
    std::string& choice() { return choice_; }
    const std::string& choice() const { return choice_; }
    /// Opens the name of a scene or a file and closes the dialog, or browses a folder; a relative path counts from the
    /// working directory.
    void open(const std::string& name);

private:
    const ViewerOptions& options_;
    Jobs& jobs_;
    Files& files_;
    std::map<std::string, SceneCard> cards_;  ///< read at the first look
    bool is_shown_ = false;
    std::string choice_;
    FolderListing listing_;
    std::uint64_t newest_look_ = 0;  ///< an older one that ends later is dropped
};

}  // namespace pl::ui
