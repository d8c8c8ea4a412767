#include "ui/model/saved_fields.h"

#include <optional>
#include <utility>

#include <fmt/format.h>

#include "core/io/field_file.h"
#include "ui/model/window_files.h"

namespace pl::ui {

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
    const std::optional<LearnedAnswer> answer = link_.worker().take_learned();
    if (!answer) return;
    std::filesystem::path path = std::exchange(promised_, {});
    if (!answer->field) {
        messages_.say(MessageLevel::Warning, answer->reason);
        return;
    }
    if (path.empty()) path = next_name(answer->field->method);
    jobs_.push([this, path, field = answer->field]() -> JobThread::Report {
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
    jobs_.push([this, path, scene = scene_.rendered()]() -> JobThread::Report {
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

}  // namespace pl::ui
