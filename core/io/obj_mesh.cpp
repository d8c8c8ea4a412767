#include "core/io/obj_mesh.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/io/line_reader.h"
#include "core/io/obj_elements.h"
#include "core/io/obj_face_reader.h"

namespace pl {

namespace {

/// The end of the first line that ends at or behind a place and is not continued, with what ends it.
std::size_t end_of_statement(std::string_view text, std::size_t from) {
    for (std::size_t at = from; (at = text.find_first_of("\r\n", at)) != std::string_view::npos; ++at) {
        if (text.substr(at).starts_with("\r\n")) {
            continue;
        }
        const bool is_pair = text[at] == '\n' && at > 0 && text[at - 1] == '\r';
        const std::size_t line_end = is_pair ? at - 1 : at;
        if (line_end == 0 || text[line_end - 1] != '\\') {
            return at + 1;
        }
    }
    return text.size();
}

/// Parts of about `bytes` that end at ends of statements.
std::vector<std::string_view> split_at_statements(std::string_view text, std::size_t bytes) {
    std::vector<std::string_view> chunks;
    while (!text.empty()) {
        chunks.push_back(text.substr(0, end_of_statement(text, std::min(bytes, text.size()) - 1)));
        text.remove_prefix(chunks.back().size());
    }
    return chunks;
}

/// Refuses more elements than indices of OBJ programs can name, and more lines than that.
void refuse_too_many(const ObjCounts& counts, const std::filesystem::path& path) {
    constexpr std::size_t kMost = std::numeric_limits<std::int32_t>::max() - 1;
    const std::size_t most =
        std::max(counts.lines, *std::max_element(counts.elements.begin(), counts.elements.end()));
    if (most > kMost) {
        throw Error(ErrorKind::Input, fmt::format("{}: expected at most {} lines, vertices, normals and texture "
                                                  "points of each, got {}",
                                                  path.string(), kMost, most));
    }
}

/// The elements of all chunks; `before` receives what precedes each of them and, last, the counts of all.
ObjElements read_elements(const std::vector<std::string_view>& chunks, const std::filesystem::path& path, int threads,
                          const glm::dvec3& origin, std::vector<ObjCounts>& before) {
    std::vector<ObjElements> parts(chunks.size());
    for_chunks(static_cast<std::uint32_t>(chunks.size()), 1, threads,
               [&](IndexRange range) { parts[range.begin] = read_obj_elements(chunks[range.begin], origin); });
    ObjElements all;
    before.push_back(all.counts);
    for (ObjElements& part : parts) {
        all.append(std::move(part));
        refuse_too_many(all.counts, path);
        before.push_back(all.counts);
    }
    return all;
}

/// Joins the faces and names of the chunks, in the order of the file.
class ObjChunkJoiner {
public:
    explicit ObjChunkJoiner(ObjMesh& mesh) : mesh_(mesh) {
        group_index_.find_or("", [&] { mesh_.groups.emplace_back(); });
    }

    void add(ObjFaceReader& chunk) {
        tallies_.add(chunk.tallies());
        std::vector<std::uint32_t> materials;
        for (const ObjName& material : chunk.materials()) {
            materials.push_back(material_index_.find_or(material.name, [&] { mesh_.materials.push_back(material); }));
        }
        std::vector<std::uint32_t> groups;
        for (const std::string& group : chunk.groups()) {
            groups.push_back(group_index_.find_or(group, [&] { mesh_.groups.push_back(group); }));
        }
        mesh_.libraries.insert(mesh_.libraries.end(), chunk.libraries().begin(), chunk.libraries().end());
        ObjFaces faces = chunk.take_faces();
        const ObjFaces::Run before = last_;
        for (ObjFaces::Run& run : faces.runs) {
            run.material = run.material == ObjFaceReader::kInherited ? before.material : materials[run.material];
            run.group = run.group == ObjFaceReader::kInherited ? before.group : groups[run.group];
            run.smoothing = run.smoothing == Smoothing::Inherited ? before.smoothing : run.smoothing;
            last_ = run;
        }
        mesh_.parts.push_back(std::move(faces));
    }

    const ObjFaceTallies& tallies() const { return tallies_; }

private:
    ObjMesh& mesh_;
    ObjFaceTallies tallies_;
    NameIndex material_index_;
    NameIndex group_index_;
    ObjFaces::Run last_;
};

std::vector<std::string> warnings_of(const ObjElements& elements, const ObjFaceTallies& faces,
                                     const std::filesystem::path& path) {
    std::vector<std::string> warnings;
    faces.short_faces.tell(warnings, path, "face with fewer than 3 corners left out");
    elements.colors.tell(warnings, path, "vertex color left out: colors come from materials only");
    elements.weights.tell(warnings, path, "fourth vertex coordinate left out");
    const Tally unknown{.count = faces.unknown.count, .first_line = faces.unknown.first_line, .first = {}};
    unknown.tell(warnings, path, fmt::format("unknown statement {} left out", faces.unknown.first));
    for (std::size_t list = 0; list < kObjLists; ++list) {
        elements.malformed[list].tell(warnings, path, fmt::format("this {} is left out", kObjElementNames[list]));
    }
    faces.unusable_faces.tell(warnings, path, "this face is left out");
    faces.unusable_corners.tell(warnings, path, "this face is shown without its normals or texture points");
    return warnings;
}

}  // namespace

ObjMesh read_obj_text(std::string_view text, const std::filesystem::path& path, int threads, const glm::dvec3& origin,
                      std::size_t chunk_bytes) {
    refuse_control_characters(text, path);
    const std::vector<std::string_view> chunks = split_at_statements(text, chunk_bytes);
    std::vector<ObjCounts> before;
    ObjElements elements = read_elements(chunks, path, threads, origin, before);
    std::vector<ObjFaceReader> readers;
    for (std::size_t i = 0; i < chunks.size(); ++i) {
        readers.emplace_back(elements, before[i]);
    }
    for_chunks(static_cast<std::uint32_t>(chunks.size()), 1, threads, [&](IndexRange range) {
        const std::size_t i = range.begin;
        if (before[i + 1].others > before[i].others) {
            readers[i].read(chunks[i], before[i + 1].faces - before[i].faces);
        }
    });
    ObjMesh mesh;
    ObjChunkJoiner joiner(mesh);
    for (ObjFaceReader& reader : readers) {
        joiner.add(reader);
    }
    mesh.origin = origin;
    mesh.warnings = warnings_of(elements, joiner.tallies(), path);
    if (std::all_of(mesh.parts.begin(), mesh.parts.end(), [](const ObjFaces& part) { return part.size() == 0; })) {
        throw Error(ErrorKind::Input,
                    fmt::format("{}: no faces: expected at least one 'f' statement with three usable corners, got {} "
                                "vertices and {} faces that cannot be used{}{}",
                                path.string(), elements.positions.size(), elements.counts.faces,
                                mesh.warnings.empty() ? "" : "; ", fmt::join(mesh.warnings, "; ")));
    }
    mesh.positions = std::move(elements.positions);
    mesh.normals = std::move(elements.normals);
    mesh.uvs = std::move(elements.uvs);
    return mesh;
}

}  // namespace pl
