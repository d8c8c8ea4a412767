#include "core/io/obj_names.h"

#include <algorithm>
#include <iterator>
#include <system_error>

#include "core/io/files.h"
#include "core/io/line_reader.h"

namespace pl {

namespace fs = std::filesystem;

namespace {

bool is_quote(char c) { return c == '"' || c == '\''; }

bool is_library(std::string_view word) { return suffix_of(fs::path(word)) == ".mtl"; }

/// Whether a path within a folder leads to a file there; links may lead out of it.
bool has_file(const fs::path& folder, const fs::path& path) {
    std::error_code ignored;
    return stays_inside(folder, path) && fs::is_regular_file(folder / path, ignored);
}

/// A path that leads up once, without that step; empty for others.
fs::path below_parent(const fs::path& path) {
    fs::path rest;
    if (path.empty() || *path.begin() != "..") return rest;
    for (auto part = std::next(path.begin()); part != path.end(); ++part) rest /= *part;
    return rest;
}

/// The names of the folders and of the file, without those that lead up.
std::vector<fs::path> parts_of(const fs::path& named) {
    std::vector<fs::path> parts;
    for (const fs::path& part : named.relative_path())
        if (!part.empty() && part != "." && part != "..") parts.push_back(part);
    return parts;
}

}  // namespace

std::string_view unquoted(std::string_view name) {
    if (name.empty() || !is_quote(name[0])) return name;
    const std::size_t end = name.find(name[0], 1);
    const bool is_closed = end != std::string_view::npos && split_words(name.substr(end + 1)).empty();
    return is_closed ? name.substr(1, end - 1) : name;
}

std::string material_name(std::string_view arguments) {
    std::string name(unquoted(arguments));
    std::replace(name.begin(), name.end(), '\t', ' ');
    return name == " " ? std::string() : name;
}

std::vector<std::string> library_names(std::string_view arguments) {
    std::vector<std::string> names;
    std::string_view rest = arguments;
    while (!split_words(rest).empty()) {
        const std::vector<std::string_view> words = split_words(rest);
        const std::string_view text(words[0].data(), rest.data() + rest.size());
        const std::size_t closing = is_quote(text[0]) ? text.find(text[0], 1) : std::string_view::npos;
        if (closing != std::string_view::npos) {
            names.emplace_back(text.substr(1, closing - 1));
            rest = text.substr(closing + 1);
            continue;
        }
        const auto found = std::find_if(words.begin(), words.end(), is_library);
        const std::string_view last = found == words.end() ? words[0] : *found;
        names.emplace_back(text.data(), last.data() + last.size());
        rest = {last.data() + last.size(), rest.data() + rest.size()};
    }
    return names;
}

NamedFile find_named_file(const fs::path& root, const fs::path& from, std::string_view name, bool is_image) {
    std::string slashes(name);
    std::replace(slashes.begin(), slashes.end(), '\\', '/');
    const bool has_drive = slashes.size() > 1 && slashes[1] == ':';
    const fs::path named(has_drive ? slashes.substr(2) : slashes);
    const fs::path direct = (from / named).lexically_normal();
    const bool is_inside = !has_drive && stays_inside(root, direct);
    if (is_inside && has_file(root, direct)) return {root / direct};
    const fs::path beside = has_drive || !is_image ? fs::path() : below_parent(direct);
    if (!beside.empty() && has_file(root / "..", beside)) return {root / ".." / beside};
    const std::vector<fs::path> parts = parts_of(named);
    for (auto first = parts.begin(); first != parts.end(); ++first) {
        fs::path end;
        for (auto part = first; part != parts.end(); ++part) end /= *part;
        for (const fs::path& folder : {from, fs::path()})
            if (has_file(root, folder / end)) return {root / folder / end, true, true};
    }
    return {root / (is_inside ? direct : named.filename()), false, !is_inside};
}

}  // namespace pl
