#include "core/io/mitsuba/xml_file.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/io/files.h"
#include "core/io/line_reader.h"
#include "core/io/mitsuba/xml_text.h"
#include "core/io/texture_file.h"

namespace pl {

namespace fs = std::filesystem;

MitsubaFile::MitsubaFile(const fs::path& path) : folder_(path.parent_path()) { read(path, 0); }

MitsubaFile::~MitsubaFile() = default;

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
    text.folder = folder_;
    text.text = read_text_file(path);
    text.parameters = &parameters_;
    text.notes = &notes_;
    const pugi::xml_parse_result result =
        text.document.load_buffer(text.text.data(), text.text.size(), pugi::parse_default, pugi::encoding_utf8);
    if (!result) fail_at(path, text.line_of(result.offset), fmt::format("not valid XML: {}", result.description()));
    if (text.document.child("scene").empty()) fail_at(path, 1, "expected a scene of Mitsuba, '<scene version=...>'");
    take(text, depth);
}

void MitsubaFile::take(const MitsubaText& text, int depth) {
    for (const MitsubaObject& object : MitsubaObject(text.document.child("scene"), text).children()) {
        if (object.element() == "include") {
            const fs::path path = path_inside(folder_, object.attribute("filename"));
            if (path.empty()) {
                object.fail(fmt::format("'filename': expected a file in the folder of the scene, got {}",
                                        in_quotes(object.attribute("filename"))));
            }
            read(path, depth + 1);
        } else if (object.element() == "default") {
            parameters_.try_emplace(object.attribute("name"), object.attribute("value"));
        } else {
            objects_.push_back(object);
            if (const std::string id = object.attribute("id"); !id.empty()) ids_.try_emplace(id, object);
        }
    }
}

MitsubaObject MitsubaFile::by_id(const std::string& id) const {
    const auto known = ids_.find(id);
    return known == ids_.end() ? MitsubaObject() : known->second;
}

}  // namespace pl
