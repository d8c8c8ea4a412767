#include "ui/model/files.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <optional>
#include <thread>
#include <utility>

#include <unistd.h>

#include <fmt/format.h>

#include "core/io/decode_image.h"
#include "core/io/field_file.h"
#include "core/io/files.h"
#include "core/io/scene_materials.h"
#include "core/io/texture_file.h"
#include "ui/model/file_names.h"
#include "ui/model/programs.h"

namespace pl::ui {
namespace {

constexpr double kSaveSeconds = 3.0;  ///< longest wait for the values of a picture from a failed render thread
constexpr int kLastSaveMs = 3000;     ///< the same when the window closes

/// The file of a picture on its way to the clipboard or from it.
struct ClipboardFile {
    std::filesystem::path path =
        std::filesystem::temp_directory_path() / fmt::format("pathlight-clipboard-{}.png", getpid());

    ClipboardFile() = default;
    ClipboardFile(const ClipboardFile&) = delete;
    ClipboardFile& operator=(const ClipboardFile&) = delete;
    ~ClipboardFile() {
        std::error_code ignored;
        std::filesystem::remove(path, ignored);
    }
};

/// Linear values, or those that a picture of display values decodes to.
OpenedPicture read_picture(const std::filesystem::path& path) {
    const std::string bytes = read_file(path);
    OpenedPicture picture{.pixels = {}, .name = path.filename().string()};
    if (is_linear(image_kind_of(bytes, path))) {
        const LinearImage image = decode_linear(bytes, {.path = path});
        picture.pixels = std::make_shared<const HalfPicture>(half_picture(image.width, image.height, image.pixels));
        return picture;
    }
    std::vector<std::string> warnings;
    const DecodedImage image = decode_image(bytes, path, warnings);
    std::vector<Vec3f> pixels;
    pixels.reserve(image.texels.size());
    for (const auto& texel : image.texels)
        pixels.emplace_back(decode_srgb(texel.r), decode_srgb(texel.g), decode_srgb(texel.b));
    picture.pixels = std::make_shared<const HalfPicture>(half_picture(image.width, image.height, pixels));
    picture.is_display = true;
    return picture;
}

/// The path that file managers and terminals put on the clipboard: the first line, perhaps quoted or a file URI. Empty if it is none of a
/// file.   [RFC 8089]
std::filesystem::path copied_path(std::string text) {
    constexpr std::string_view kScheme = "file://";
    text = text.substr(0, text.find_first_of("\r\n"));
    if (text.size() > 1 && text.front() == text.back() && (text.front() == '\'' || text.front() == '"'))
        text = text.substr(1, text.size() - 2);
    if (text.starts_with(kScheme)) {
        text.erase(0, kScheme.size());
        for (std::size_t at = 0; (at = text.find('%', at)) < text.size(); ++at) {
            unsigned code = 0;
            const char* const digits = text.data() + at + 1;
            if (at + 2 < text.size() && std::from_chars(digits, digits + 2, code, 16).ptr == digits + 2)
                text.replace(at, 3, 1, static_cast<char>(code));
        }
    }
    std::error_code ignored;
    return std::filesystem::is_regular_file(text, ignored) ? text : "";
}

}  // namespace

PictureFiles::PictureFiles(const ModelServices& services, FileNames& names, const ViewedScene& scene,
                           const RenderControls& render, const DisplayControls& display)
    : options_(services.options), messages_(services.messages), jobs_(services.jobs), link_(services.link),
      names_(names), scene_(scene), render_(render), display_(display) {}

void PictureFiles::update() {
    if (!unsaved_.empty()) write_unsaved();
}

void PictureFiles::finish() {
    for (int waited = 0; !unsaved_.empty() && waited < kLastSaveMs; ++waited) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        link_.take_frame();
        update();
    }
}

ViewerPicture PictureFiles::picture() const {
    return {.scene = scene_.shown(),
            .description = scene_.materials().file(),
            .backend = link_.status().backend,
            .settings = render_.settings(),
            .display = display_.settings(),
            .limits = render_.limits(),
            .spp = link_.status().passes,
            .edited_materials = scene_.materials().edited_names()};
}

std::string PictureFiles::command_line(const std::string& field, const std::string& materials) const {
    if (!options_.command_line) return "";
    ViewerPicture shown = picture();
    shown.field = field;
    shown.materials = materials;
    return options_.command_line(shown);
}

void PictureFiles::save(std::initializer_list<const char*> suffixes) {
    if (!link_.frame()) {
        messages_.say(MessageLevel::Warning, "there is no picture to save yet");
        return;
    }
    const std::filesystem::path name = names_.next(scene_, info_of(link_.frame()->settings.method).name, suffixes);
    for (const char* suffix : suffixes) save_as(name.string() + suffix);
}

void PictureFiles::save_as(const std::filesystem::path& path) {
    unsaved_.push_back(path);
    deadline_ = messages_.now() + kSaveSeconds;
    link_.worker().set_values_wanted(true);
    write_unsaved();
}

/// Frames carry pixel values only on request: until one has arrived, there is nothing to write.
void PictureFiles::write_unsaved() {
    const auto& frame = link_.frame();
    if (!frame->has_values()) {
        if (link_.status().state != WorkerState::Failed || messages_.now() < deadline_) return;
        unsaved_.clear();
        messages_.say(MessageLevel::Error, "the picture cannot be saved: rendering has failed");
        return;
    }
    ViewerPicture shown = picture();
    shown.settings = frame->settings;
    shown.backend = frame->backend.name;
    shown.spp = frame->snapshot.passes;
    for (const std::filesystem::path& path : std::exchange(unsaved_, {})) {
        jobs_.push([this, path, shown, frame]() -> Jobs::Report {
            save_window_picture(path, frame->snapshot, shown,
                                options_.command_line ? options_.command_line(shown) : "");
            return [this, path] { messages_.say(MessageLevel::Info, "saved " + path.string()); };
        });
    }
}

void PictureFiles::save_plot(const std::string& svg, const std::string& csv) {
    const std::filesystem::path name = names_.next(scene_, "plot", {".svg", ".csv"});
    jobs_.push([this, name, svg, csv]() -> Jobs::Report {
        write_file_atomic(name.string() + ".svg", svg);
        write_file_atomic(name.string() + ".csv", csv);
        return [this, name] {
            messages_.say(MessageLevel::Info, fmt::format("saved {0}.svg and {0}.csv", name.string()));
        };
    });
}

void PictureFiles::save_window(ByteImage pixels, std::filesystem::path path) {
    jobs_.push([this, path, shared = std::make_shared<ByteImage>(std::move(pixels))]() -> Jobs::Report {
        save_window_pixels(path, *shared);
        return [this, path] { messages_.say(MessageLevel::Info, "saved " + path.string()); };
    });
}

void PictureFiles::copy_view(ByteImage pixels) {
    jobs_.push([this, shared = std::make_shared<ByteImage>(std::move(pixels))]() -> Jobs::Report {
        const ClipboardFile file;
        save_window_pixels(file.path, *shared);
        copy_picture(file.path);
        return [this] { messages_.say(MessageLevel::Info, "copied the picture as it is seen"); };
    });
}

SavedFields::SavedFields(const ModelServices& services, FileNames& names, const ViewedScene& scene,
                         RenderControls& render)
    : messages_(services.messages), jobs_(services.jobs), link_(services.link), names_(names), scene_(scene),
      render_(render) {}

std::filesystem::path SavedFields::next_name(MethodId method) {
    const std::string suffix(kFieldSuffix);
    return names_.next(scene_, info_of(method).name, {suffix.c_str()}).string() + suffix;
}

void SavedFields::save() { link_.worker().request_learned(); }

std::filesystem::path SavedFields::save_as_named() {
    if (promised_.empty()) promised_ = next_name(render_.method());
    save();
    return promised_;
}

void SavedFields::update() {
    const std::optional<LearnedAnswer> answer = link_.worker().take<LearnedAnswer>();
    if (!answer) return;
    std::filesystem::path path = std::exchange(promised_, {});
    if (!answer->value) {
        messages_.say(MessageLevel::Warning, answer->reason);
        return;
    }
    if (path.empty()) path = next_name(answer->value->method);
    jobs_.push([this, path, field = answer->value]() -> Jobs::Report {
        write_field(path, *field);
        return [this, text = fmt::format("saved {}: {}", path.string(), summary_of(*field))] {
            messages_.say(MessageLevel::Info, text);
        };
    });
}

std::filesystem::path SavedFields::newest_file() const {
    std::filesystem::path newest;
    std::filesystem::file_time_type newest_time{};
    std::error_code error;
    const std::string start = FileNames::stem_of(scene_) + "-";
    for (const auto& entry : std::filesystem::directory_iterator(names_.folder(), error)) {
        const std::filesystem::path& path = entry.path();
        if (path.extension() != kFieldSuffix || !path.filename().string().starts_with(start)) continue;
        const auto time = entry.last_write_time(error);
        if (error || (!newest.empty() && time < newest_time)) continue;
        newest = path;
        newest_time = time;
    }
    return newest;
}

void SavedFields::load_newest() {
    const std::filesystem::path newest = newest_file();
    if (newest.empty()) {
        messages_.say(MessageLevel::Warning,
                      fmt::format("no learned field of {} was saved in {}", scene_.name(), names_.folder().string()));
        return;
    }
    load(newest);
}

void SavedFields::load(const std::filesystem::path& path) {
    jobs_.push([this, path, scene = scene_.rendered()]() -> Jobs::Report {
        const std::shared_ptr<LearnedField> field = load_window_field(path, *scene.description);
        return [this, field, path, scene] {
            if (scene.description != link_.status().scene)
                messages_.say(MessageLevel::Error, fmt::format("{}: the scene was changed meanwhile", path.string()));
            else
                adopt(field, path);
        };
    });
}

void SavedFields::adopt(const std::shared_ptr<LearnedField>& field, const std::filesystem::path& path) {
    render_.adopt_field(field);
    messages_.say(MessageLevel::Info, fmt::format("continuing from {}: {}", path.string(), summary_of(*field)));
}

void Files::open(const std::string& file) {
    constexpr std::array kPictures{".exr", ".pfm", ".hdr", ".png", ".jpg", ".jpeg", ".tga", ".bmp"};
    const std::string suffix = suffix_of(file);
    if (suffix == kFieldSuffix)
        fields_.load(file);
    else if (std::ranges::find(kPictures, suffix) != kPictures.end())
        open_picture(file);
    else
        scene_.open(file);
}

void Files::open_picture(const std::filesystem::path& path) {
    jobs_.push(
        [this, path]() -> Jobs::Report { return [this, picture = read_picture(path)] { compare_with(picture); }; });
}

void Files::compare_with(const OpenedPicture& picture) {
    comparison_.open_picture(picture);
    messages_.say(MessageLevel::Info,
                  picture.name + (picture.is_display
                                      ? " is compared as B, by eye: its colors are those of a screen, clipped and "
                                        "without linear values. Exposure does not change them"
                                      : " is compared as B"));
}

void Files::paste(const std::string& text) {
    if (const std::filesystem::path path = copied_path(text); !path.empty()) {
        open(path.string());
        return;
    }
    jobs_.push([this]() -> Jobs::Report {
        const ClipboardFile file;
        if (!paste_picture(file.path))
            throw Error(ErrorKind::Input, "the clipboard has neither the path of a file nor a picture");
        OpenedPicture picture = read_picture(file.path);
        picture.name = "the copied picture";
        return [this, picture] { compare_with(picture); };
    });
}

std::filesystem::path Files::save_materials() {
    const std::filesystem::path path = names_.next(scene_, "materials", {".json"}).string() + ".json";
    jobs_.push([this, path, materials = scene_.materials().named()]() -> Jobs::Report {
        write_material_file(path, materials);
        return [this, path] { messages_.say(MessageLevel::Info, "saved " + path.string()); };
    });
    return path;
}

}  // namespace pl::ui
