// Small pictures of the known scenes for the dialog that opens them: read from a folder, or rendered once, one scene
// after the other, on a thread of low priority.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "core/io/image.h"
#include "ui/model/background_job.h"
#include "ui/model/services.h"

namespace pl::ui {

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

}  // namespace pl::ui
