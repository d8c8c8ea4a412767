#include "core/io/obj_mesh.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/error.h"
#include "core/base/parallel_chunks.h"
#include "core/io/obj_chunk.h"

namespace pl {

namespace {

/// Joins the faces and names of the chunks, in the order of the file.
class ObjChunkJoiner {
public:
    explicit ObjChunkJoiner(ObjMesh& mesh) : mesh_(mesh) {
        group_index_.find_or("", [&] { mesh_.groups.emplace_back(); });
    }

    void add(ObjChunkReader& chunk) {
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
            run.material = run.material == ObjChunkReader::kInherited ? before.material : materials[run.material];
            run.group = run.group == ObjChunkReader::kInherited ? before.group : groups[run.group];
            run.smoothing = run.smoothing == Smoothing::Inherited ? before.smoothing : run.smoothing;
            last_ = run;
        }
        mesh_.parts.push_back(std::move(faces));
    }

    const ObjTallies& tallies() const { return tallies_; }

private:
    ObjMesh& mesh_;
    ObjTallies tallies_;
    NameIndex material_index_;
    NameIndex group_index_;
    ObjFaces::Run last_;
};

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

/// Elements before each chunk and, last, all of them.
std::vector<ObjCounts> count_before(const std::vector<std::string_view>& chunks, int threads) {
    std::vector<ObjCounts> before(chunks.size() + 1);
    for_chunks(static_cast<std::uint32_t>(chunks.size()), 1, threads,
               [&](IndexRange range) { before[range.begin + 1] = count_elements(chunks[range.begin]); });
    for (std::size_t i = 1; i < before.size(); ++i) {
        before[i] += before[i - 1];
    }
    return before;
}

/// Calls read(i) for the chunks in parallel, and throws what the first one in the text throws.
template <class Read>
void read_chunks(std::size_t count, int threads, Read&& read) {
    std::vector<FirstException> faults(count);
    for_chunks(static_cast<std::uint32_t>(count), 1, threads,
               [&](IndexRange range) { faults[range.begin].guard([&] { read(range.begin); }); });
    for (const FirstException& fault : faults) {
        fault.rethrow();
    }
}

/// Makes room for the elements of a text; a reader refuses those for which there is none.
void resize(ObjMesh& mesh, const ObjCounts& total) {
    const auto size = [&](std::size_t list) {
        return static_cast<std::size_t>(std::min(total.elements[list], kMostElements));
    };
    mesh.positions.resize(size(0));
    mesh.normals.resize(size(1));
    mesh.uvs.resize(size(2));
}

}  // namespace

ObjMesh read_obj_text(std::string_view text, const std::filesystem::path& path, int threads, const glm::dvec3& origin,
                      std::size_t chunk_bytes) {
    const std::vector<std::string_view> chunks = split_at_statements(text, chunk_bytes);
    const std::vector<ObjCounts> before = count_before(chunks, threads);
    ObjMesh mesh;
    mesh.origin = origin;
    resize(mesh, before.back());
    std::vector<ObjChunkReader> readers;
    for (std::size_t i = 0; i < chunks.size(); ++i) {
        readers.emplace_back(mesh, path, before[i], before.back());
    }
    read_chunks(chunks.size(), threads,
                [&](std::size_t i) { readers[i].read(chunks[i], before[i + 1].faces - before[i].faces); });
    UnusableElements unusable;
    for (const ObjChunkReader& reader : readers) {
        for (std::size_t list = 0; list < kObjLists; ++list) {
            unusable[list].insert(unusable[list].end(), reader.unusable()[list].begin(),
                                  reader.unusable()[list].end());
        }
    }
    read_chunks(chunks.size(), threads, [&](std::size_t i) { readers[i].check_faces(unusable); });
    ObjChunkJoiner joiner(mesh);
    for (ObjChunkReader& reader : readers) {
        joiner.add(reader);
    }
    const ObjTallies& tallies = joiner.tallies();
    mesh.warnings = tallies.warnings(path);
    if (std::all_of(mesh.parts.begin(), mesh.parts.end(), [](const ObjFaces& part) { return part.size() == 0; })) {
        throw Error(ErrorKind::Input,
                    fmt::format("{}: no faces: expected at least one 'f' statement with three usable corners, got {} "
                                "vertices and {} faces that cannot be used{}{}",
                                path.string(), mesh.positions.size(),
                                tallies.unusable_faces.count + tallies.short_faces.count,
                                mesh.warnings.empty() ? "" : "; ", fmt::join(mesh.warnings, "; ")));
    }
    return mesh;
}

}  // namespace pl
