// The dialog that opens scenes: the known ones, those opened last, and the files of a folder.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "core/io/image.h"
#include "ui/model/files.h"
#include "ui/model/jobs.h"
#include "ui/model/render_link.h"

namespace pl::ui {

/// Small pictures of the known scenes for the dialog that opens them: read from a folder, or rendered once, one scene
/// after the other, on a thread of low priority.
class SceneGallery {
public:
    explicit SceneGallery(const ModelServices& services)
        : options_(services.options), messages_(services.messages), link_(services.link) {}

    /// The folder of the files; empty: pictures last as long as the viewer.
    void set_folder(std::filesystem::path folder) { folder_ = std::move(folder); }

    /// Pictures are made while somebody looks at them, and the picture in the window rests meanwhile: its clocks would
    /// count the time that these take from it.
    void set_shown(bool is_shown);
    /// Takes finished pictures; once per frame of the window.
    void update();

    /// A draft as long as the whole picture is not there. Null before it is made, and for scenes that cannot be rendered.
    std::shared_ptr<const ByteImage> picture(const std::string& scene) const;
    /// Number of scenes with a picture, be it a draft.
    std::size_t shown() const;
    /// Number of whole pictures.
    std::size_t size() const { return pictures_.size(); }
    bool is_working() const { return job_ != nullptr; }

private:
    using Pictures = std::map<std::string, std::shared_ptr<const ByteImage>>;

    /// Filled by the thread that makes pictures.
    struct Incoming {
        std::mutex mutex;
        Pictures pictures;
        Pictures drafts;
    };
    struct Outcome {
        std::string failure{};  ///< the newest one; empty without
        bool is_complete = false;
    };

    void start();
    Outcome make_all(const std::vector<std::string>& names, const std::filesystem::path& folder,
                     const JobMonitor& monitor);
    /// Kept pictures, and drafts of the others: a gallery without pictures helps nobody to choose.
    void show_drafts(const std::vector<std::string>& names, const std::filesystem::path& folder,
                     const JobMonitor& monitor);
    std::optional<ByteImage> make(const std::string& name, const std::filesystem::path& folder,
                                  const JobMonitor& monitor, Outcome& outcome) const;
    void hand_over(Pictures Incoming::*kind, const std::string& name, ByteImage image);

    const ViewerOptions& options_;
    Messages& messages_;
    RenderLink& link_;
    std::filesystem::path folder_;
    Pictures pictures_;
    Pictures drafts_;
    Incoming incoming_;
    bool is_shown_ = false;
    bool is_complete_ = false;                     ///< all scenes have had their turn
    std::unique_ptr<BackgroundJob<Outcome>> job_;  ///< last: it uses all members above
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
        : options_(services.options), jobs_(services.jobs), files_(files), gallery_(services) {}

    /// Once per frame of the window.
    void update();

    bool& is_shown() { return is_shown_; }
    bool is_shown() const { return is_shown_; }
    /// Opens it, with a new look at the folder that it showed last, at first the working directory; or closes it.
    void toggle();

    const std::vector<std::string>& scenes() const { return options_.scenes; }
    SceneGallery& gallery() { return gallery_; }
    const SceneGallery& gallery() const { return gallery_; }
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
    SceneGallery gallery_;
    bool is_shown_ = false;
    std::string choice_;
    FolderListing listing_;
    std::uint64_t newest_look_ = 0;  ///< an older one that ends later is dropped
};

}  // namespace pl::ui
