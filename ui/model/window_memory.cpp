#include "ui/model/window_memory.h"

#include <array>
#include <cmath>

#include <fmt/format.h>

#include "core/base/error.h"
#include "ui/model/viewer_model.h"

namespace pl::ui {
namespace {

constexpr std::array<const char*, kThemeCount> kThemeNames{"dark", "light", "high contrast"};
constexpr std::array<const char*, 2> kLayoutNames{"explore", "research"};
constexpr std::array<const char*, kErrorMetricCount> kMetricNames{"relmse", "relmse-trimmed", "mse", "smape",
                                                                  "noise"};
constexpr std::array<const char*, 2> kAxisNames{"seconds", "samples"};
constexpr std::size_t kMostRecent = 100;

/// Three decimals: a float as a person would write it.
double short_decimal(float value) { return std::round(1000.0 * static_cast<double>(value)) / 1000.0; }

/// An object of the file, with the name of its members in front for messages.
class Members {
public:
    Members(const Json& object, std::string prefix) : object_(object), prefix_(std::move(prefix)) {
        if (!object.is_object()) fail("the value", "an object", object);
    }

    /// Null if there is none.
    const Json* find(const char* key) const {
        const auto member = object_.find(key);
        return member != object_.end() ? &*member : nullptr;
    }
    Members object(const char* key) const {
        static const Json empty = Json::object();
        const Json* member = find(key);
        return {member != nullptr ? *member : empty, prefix_ + key + "."};
    }
    void read(const char* key, bool& value) const {
        const Json* member = find(key);
        if (member == nullptr) return;
        if (!member->is_boolean()) fail(key, "true or false", *member);
        value = member->get<bool>();
    }
    void read(const char* key, int& value, int low, int high) const {
        const Json* member = find(key);
        if (member == nullptr) return;
        const bool is_whole = member->is_number_integer();
        const double number = is_whole ? member->get<double>() : 0.0;
        if (!is_whole || number < low || number > high)
            fail(key, fmt::format("a whole number from {} to {}", low, high), *member);
        value = static_cast<int>(number);
    }
    void read(const char* key, float& value, float low, float high) const {
        const Json* member = find(key);
        if (member == nullptr) return;
        const double number = member->is_number() ? member->get<double>() : low - 1.0;
        if (!(number >= low && number <= high)) fail(key, fmt::format("a number from {} to {}", low, high), *member);
        value = static_cast<float>(number);
    }
    template <class Value, std::size_t kCount>
    void read(const char* key, Value& value, const std::array<const char*, kCount>& names) const {
        const Json* member = find(key);
        if (member == nullptr) return;
        for (std::size_t i = 0; i < kCount; ++i) {
            if (!member->is_string() || member->get<std::string>() != names[i]) continue;
            value = static_cast<Value>(i);
            return;
        }
        std::string known;
        for (const char* name : names) known += fmt::format("{}{}", known.empty() ? "" : ", ", name);
        fail(key, "one of " + known, *member);
    }
    void read(const char* key, std::vector<std::string>& value) const {
        const Json* member = find(key);
        if (member == nullptr) return;
        std::vector<std::string> texts;
        if (!member->is_array() || member->size() > kMostRecent)
            fail(key, fmt::format("an array of at most {} names", kMostRecent), *member);
        for (const Json& text : *member) {
            if (!text.is_string()) fail(key, "an array of names", *member);
            texts.push_back(text.get<std::string>());
        }
        value = std::move(texts);
    }

private:
    [[noreturn]] void fail(const std::string& key, const std::string& expected, const Json& got) const {
        throw Error(ErrorKind::Input,
                    fmt::format("{}{}: expected {}, got {}", prefix_, key, expected, got.dump().substr(0, 60)));
    }

    const Json& object_;
    std::string prefix_;
};

std::optional<WindowPlace> place_in(const Members& file) {
    if (file.find("window") == nullptr) return std::nullopt;
    constexpr int kFarthest = 100000;
    const Members window = file.object("window");
    WindowPlace place;
    window.read("x", place.x, -kFarthest, kFarthest);
    window.read("y", place.y, -kFarthest, kFarthest);
    window.read("width", place.width, 1, kFarthest);
    window.read("height", place.height, 1, kFarthest);
    window.read("maximized", place.maximized);
    return place;
}

void read_panels(const Members& panels, PanelChoice& choice) {
    constexpr float kWidest = 10000.0f;
    panels.read("settings", choice.settings);
    panels.read("right", choice.right);
    panels.read("tabs", choice.tabs);
    panels.read("accuracy", choice.accuracy);
    panels.read("settings_em", choice.settings_em, 0.0f, kWidest);
    panels.read("right_em", choice.right_em, 0.0f, kWidest);
    panels.read("accuracy_share", choice.accuracy_share, 0.0f, 1.0f);
}

Json panels_json(const PanelChoice& choice) {
    return {{"settings", choice.settings},
            {"right", choice.right},
            {"tabs", choice.tabs},
            {"accuracy", choice.accuracy},
            {"settings_em", short_decimal(choice.settings_em)},
            {"right_em", short_decimal(choice.right_em)},
            {"accuracy_share", short_decimal(choice.accuracy_share)}};
}

}  // namespace

void write_memory(const WindowMemory& memory, Json& document) {
    document["schema"] = kWindowMemorySchema;
    document.erase("window");
    if (const auto& place = memory.place)
        document["window"] = {{"x", place->x},
                              {"y", place->y},
                              {"width", place->width},
                              {"height", place->height},
                              {"maximized", place->maximized}};
    document["ui_scale"] = short_decimal(memory.ui_scale);
    document["theme"] = kThemeNames[static_cast<std::size_t>(memory.theme)];
    document["layout"] = name_of(memory.layout);
    document["panels"] = panels_json(memory.panels);
    document["display"] = {{"hemisphere", memory.hemisphere},
                           {"tint_opacity", short_decimal(memory.tint_opacity)},
                           {"coarser_in_motion", memory.coarser_in_motion},
                           {"preview_in_motion", memory.preview_in_motion},
                           {"denoised_preview", memory.denoised_preview}};
    document["plot"] = {{"metric", kMetricNames[static_cast<std::size_t>(memory.plot.metric)]},
                        {"axis", kAxisNames[static_cast<std::size_t>(memory.plot.axis)]}};
    document["recent"] = memory.recent;
    document["tour"] = {{"step", memory.tour_step}, {"answered", memory.is_tour_answered}};
}

WindowMemory memory_in(const Json& document, const WindowMemory& first, const std::filesystem::path& path) {
    const Members file(document, path.string() + ": ");
    WindowMemory memory = first;
    memory.place = place_in(file);
    if (const Json* scale = file.find("ui_scale"); scale != nullptr && *scale != 0)
        file.read("ui_scale", memory.ui_scale, kLeastUiScale, kMostUiScale);
    file.read("theme", memory.theme, kThemeNames);
    file.read("layout", memory.layout, kLayoutNames);
    read_panels(file.object("panels"), memory.panels);
    const Members display = file.object("display");
    display.read("hemisphere", memory.hemisphere);
    display.read("tint_opacity", memory.tint_opacity, 0.0f, 1.0f);
    display.read("coarser_in_motion", memory.coarser_in_motion);
    display.read("preview_in_motion", memory.preview_in_motion);
    display.read("denoised_preview", memory.denoised_preview);
    const Members plot = file.object("plot");
    plot.read("metric", memory.plot.metric, kMetricNames);
    plot.read("axis", memory.plot.axis, kAxisNames);
    file.read("recent", memory.recent);
    const Members tour = file.object("tour");
    tour.read("step", memory.tour_step, 0, static_cast<int>(tour_steps().size()) - 1);
    tour.read("answered", memory.is_tour_answered);
    return memory;
}

WindowMemory memory_of(const ViewerModel& model, const WindowMemory& before) {
    WindowMemory memory = before;
    const WindowState& window = model.window();
    memory.theme = window.theme;
    memory.layout = window.layout;
    memory.panels = window.panels;
    memory.panels.shown = true;
    memory.hemisphere = window.hemisphere;
    memory.tint_opacity = model.display().cells_opacity();
    memory.coarser_in_motion = model.display().low_resolution();
    memory.preview_in_motion = model.display().preview();
    memory.denoised_preview = model.display().denoises();
    const AccuracyModel& accuracy = model.comparison().accuracy();
    memory.plot = {accuracy.wanted_metric(), accuracy.kind().axis};
    memory.recent = model.scene().recent().names();
    memory.tour_step = model.tour().step();
    memory.is_tour_answered = model.tour().is_answered();
    return memory;
}

void restore(const WindowMemory& memory, ViewerModel& model) {
    WindowState& window = model.window();
    window.theme = memory.theme;
    window.layout = memory.layout;
    window.panels = memory.panels;
    window.hemisphere = memory.hemisphere;
    model.scene().remember(memory.recent);
    model.tour().remember(memory.tour_step, memory.is_tour_answered);
    model.display().set_cells_opacity(memory.tint_opacity);
    model.display().set_low_resolution(memory.coarser_in_motion);
    model.display().set_preview(memory.preview_in_motion);
    model.display().set_denoises(memory.denoised_preview);
    model.comparison().accuracy().set_metric(memory.plot.metric);
    model.comparison().accuracy().set_axis(memory.plot.axis);
}

const char* name_of(WindowLayout layout) { return kLayoutNames[static_cast<std::size_t>(layout)]; }

namespace {

bool is_there(const std::filesystem::path& file) {
    std::error_code ignored;
    return std::filesystem::exists(std::filesystem::symlink_status(file, ignored));
}

}  // namespace

RememberedWindow::RememberedWindow(std::filesystem::path file, const WindowMemory& first)
    : file_(std::move(file)), last_(first) {
    is_new_ = !file_.empty() && !is_there(file_);
    if (!file_.empty() && !is_new_) {
        try {
            Json document = read_json_file(file_, kWindowMemorySchema);
            last_ = read_members(file_, [&] { return memory_in(document, first, file_); });
            document_ = std::move(document);
        } catch (const Error& error) {
            problem_ = fmt::format("the window opens as at a first start: {}", error.what());
        }
    }
    waiting_ = last_;
}

std::string RememberedWindow::write(const WindowMemory& now) {
    try {
        write_memory(now, document_);
        make_folder(file_.parent_path());
        write_json_file(file_, document_);
        last_ = now;
        return "";
    } catch (const std::exception& error) {  // also Json's, for names that are not UTF-8
        return fmt::format("the window is not remembered: {}", error.what());
    }
}

void RememberedWindow::update(const WindowMemory& now, double seconds, Messages& messages) {
    if (file_.empty()) return;
    if (seconds < settled_at_) last_ = waiting_ = now;
    if (now != waiting_) {
        waiting_ = now;
        changed_at_ = seconds;
    }
    if (has_failed_ || waiting_ == last_ || seconds - changed_at_ < kRestSeconds) return;
    const std::string failure = write(now);
    if (failure.empty()) return;
    has_failed_ = true;
    messages.say(MessageLevel::Warning, failure);
}

std::string RememberedWindow::finish(const WindowMemory& now) {
    return file_.empty() || now == last_ ? "" : write(now);
}

void RememberedWindow::forget(const WindowMemory& now, double seconds, Messages& messages) {
    last_ = waiting_ = now;
    document_ = Json::object();
    settled_at_ = seconds + kRestSeconds;
    std::error_code error;
    if (!file_.empty()) std::filesystem::remove(file_, error);
    if (error)
        messages.say(MessageLevel::Warning, fmt::format("cannot remove {}: {}", file_.string(), error.message()));
    else
        messages.say(MessageLevel::Info, "the window is as at a first start; nothing of it is remembered");
}

}  // namespace pl::ui
