#include "core/io/obj_simple.h"

#include <algorithm>
#include <atomic>

#include "core/base/parallel_chunks.h"
#include "core/io/obj_check.h"
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

private:
    ObjMesh& mesh_;
    NameIndex material_index_;
    NameIndex group_index_;
    ObjFaces::Run last_;
};

/// Parts of about `bytes` that end at ends of lines.
std::vector<std::string_view> split_at_lines(std::string_view text, std::size_t bytes) {
    std::vector<std::string_view> chunks;
    while (!text.empty()) {
        const std::size_t end = text.size() > bytes ? text.find('\n', bytes - 1) : std::string_view::npos;
        const std::size_t size = end == std::string_view::npos ? text.size() : end + 1;
        chunks.push_back(text.substr(0, size));
        text.remove_prefix(size);
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

bool is_readable(const ObjCounts& total) {
    return total.faces > 0 && std::max({total.vertices, total.normals, total.uvs, total.lines}) <= kMostElements;
}

}  // namespace

std::optional<ObjMesh> read_simple_obj(std::string_view text, int threads, std::size_t chunk_bytes,
                                       const glm::dvec3& origin) {
    const std::vector<std::string_view> chunks = split_at_lines(text, chunk_bytes);
    const std::vector<ObjCounts> before = count_before(chunks, threads);
    const ObjCounts& total = before.back();
    if (!is_readable(total)) {
        return std::nullopt;
    }
    ObjMesh mesh;
    mesh.origin = origin;
    mesh.positions.resize(static_cast<std::size_t>(total.vertices));
    mesh.normals.resize(static_cast<std::size_t>(total.normals));
    mesh.uvs.resize(static_cast<std::size_t>(total.uvs));
    std::vector<ObjChunkReader> readers;
    for (std::size_t i = 0; i < chunks.size(); ++i) {
        readers.emplace_back(mesh, before[i], total);
    }
    std::atomic<bool> is_simple{true};
    for_chunks(static_cast<std::uint32_t>(chunks.size()), 1, threads, [&](IndexRange range) {
        const std::uint32_t i = range.begin;
        if (is_simple && !readers[i].read(chunks[i], before[i + 1].faces - before[i].faces)) {
            is_simple = false;
        }
    });
    if (!is_simple) {
        return std::nullopt;
    }
    ObjChunkJoiner joiner(mesh);
    for (ObjChunkReader& reader : readers) {
        joiner.add(reader);
    }
    return mesh;
}

}  // namespace pl
