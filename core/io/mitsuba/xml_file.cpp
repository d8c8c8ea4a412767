#include "core/io/mitsuba/xml_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <set>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/io/files.h"
#include "core/io/line_reader.h"
#include "core/io/nearest_name.h"
#include "core/io/texture_file.h"

namespace pl {

namespace fs = std::filesystem;

namespace {

/// Properties that decide how Mitsuba works, or how it writes a file, but nothing that a picture shows.
constexpr std::array<std::string_view, 22> kPassedOver = {
    "rr_depth",     "sampling_weight",  "sample_visible",  "samples_per_pass",
    "block_size",   "timeout",          "pixel_format",    "component_format",
    "file_format",  "banner",           "sample_border",   "high_quality_edges",
    "attach_log",   "fast_math",        "format",          "accel",
    "cache",        "mis_compensation", "shading_samples", "emitter_samples",
    "bsdf_samples", "collapse"};
/// Objects that decide nothing that a picture shows; phase functions belong to media that scatter nothing.
constexpr std::array<std::string_view, 3> kObjectsWithoutEffect = {"sampler", "rfilter", "phase"};

bool is_of_name(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

bool contains(const auto& names, std::string_view name) { return std::ranges::find(names, name) != names.end(); }

}  // namespace

MitsubaFile::MitsubaFile(const fs::path& path, const Parameters& given) : shared_(std::make_unique<MitsubaShared>()) {
    shared_->folder = path.parent_path();
    for (const auto& [name, value] : given) shared_->parameters.insert_or_assign(name, value);
    read(path, 0);
    const std::vector<std::string> known = parameter_names();
    for (const auto& [name, value] : given)
        if (!contains(known, name))
            throw Error(ErrorKind::Usage, fmt::format("-D {}: {} has no such parameter{}", name, path.string(),
                                                      known.empty() ? ": it has none" : known_names(name, known)));
}

MitsubaFile::~MitsubaFile() = default;

SceneNotes& MitsubaFile::notes() { return shared_->notes; }

void MitsubaFile::read(const fs::path& path, int depth) {
    constexpr int kDeepest = 8;
    if (depth > kDeepest || static_cast<int>(texts_.size()) >= kMostIncludes) {
        throw Error(ErrorKind::Input,
                    fmt::format("{}: expected at most {} included files, {} levels deep, got more: in a circle?",
                                path.string(), kMostIncludes, kDeepest));
    }
    files_.push_back(path);
    texts_.push_back(std::make_unique<MitsubaText>());
    MitsubaText& text = *texts_.back();
    text.path = path;
    text.text = read_text_file(path);
    text.shared = shared_.get();
    const pugi::xml_parse_result result =
        text.document.load_buffer(text.text.data(), text.text.size(), pugi::parse_default, pugi::encoding_utf8);
    if (!result) fail_at(path, text.line_of(result.offset), fmt::format("not valid XML: {}", result.description()));
    if (text.document.child("scene").empty()) fail_at(path, 1, "expected a scene of Mitsuba, '<scene version=...>'");
    take(text, depth);
}

void MitsubaFile::take(const MitsubaText& text, int depth) {
    for (const MitsubaObject& object : MitsubaObject(text.document.child("scene"), text).children())
        take(object, depth);
    // The ids of all objects, also of objects inside of other objects.
    text.for_each_object([&](const MitsubaObject& object) {
        const std::string id = object.attribute("id");
        if (!id.empty() && object.element() != "ref" && object.element() != "alias")
            shared_->ids.try_emplace(id, object);
    });
}

void MitsubaFile::take(const MitsubaObject& object, int depth) {
    const std::string element = object.element();
    if (element == "include") {
        read(object.file_named("filename", object.attribute("filename")), depth + 1);
    } else if (element == "default") {
        shared_->parameters.try_emplace(object.attribute("name"), object.attribute("value"));
    } else if (element == "path") {
        add_folder(object);
    } else if (element == "alias") {
        shared_->aliases.try_emplace(object.attribute("as"), object.attribute("id"));
    } else {
        objects_.push_back(object);
    }
}

/// Parameters that have a `default`, and parameters that attributes mention as $NAME; sorted.
std::vector<std::string> MitsubaFile::parameter_names() const {
    std::set<std::string> names;
    const auto add_mentioned = [&names](std::string_view value) {
        for (std::size_t at = value.find('$'); at != std::string_view::npos; at = value.find('$', at + 1)) {
            const std::string_view rest = value.substr(at + 1);
            const auto end = std::ranges::find_if_not(rest, is_of_name);
            if (end != rest.begin()) names.emplace(rest.begin(), end);
        }
    };
    for (const auto& text : texts_)
        text->for_each_object([&](const MitsubaObject& object) {
            if (object.element() == "default") names.insert(object.attribute("name"));
            for (const pugi::xml_attribute& attribute : object.node_.attributes()) add_mentioned(attribute.value());
        });
    return {names.begin(), names.end()};
}

/// Of a scene that is a few folders below what it shares with others, so that it names folders above its own.
void MitsubaFile::add_folder(const MitsubaObject& path) {
    constexpr auto kMostUp = 3;
    const fs::path name = fs::path(path.attribute("value")).lexically_normal();
    if (name.is_absolute() || std::ranges::count(name, fs::path("..")) > kMostUp)
        path.note(fmt::format("folders of 'path' that are absolute, or more than {} above the scene, are left out",
                              kMostUp));
    else
        shared_->others.push_back(shared_->folder / name);
}

void MitsubaFile::note_unused() {
    for (const auto& text : texts_) text->for_each_object([](const MitsubaObject& object) { object.note_unused(); });
}

void MitsubaObject::note_unused() const {
    const MitsubaShared& shared = *text_->shared;
    if (!shared.read.contains(identity()) || shared.left_out.contains(identity())) return;
    for (const MitsubaObject& child : children()) {
        if (shared.used.contains(child.identity()) || contains(kPassedOver, child.name()) ||
            contains(kObjectsWithoutEffect, child.element()))
            continue;
        const std::string name = child.attribute("name");
        child.note(fmt::format("{} of {} {} is not used", name.empty() ? "a " + child.element() : in_quotes(name),
                               element(), in_quotes(type())));
    }
}

}  // namespace pl
