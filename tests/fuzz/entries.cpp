#include "tests/fuzz/entries.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>

#include <unistd.h>

#include "core/base/error.h"
#include "core/io/checkpoint_file.h"
#include "core/io/field_file.h"
#include "core/io/files.h"
#include "core/io/image.h"
#include "core/io/load_scene.h"
#include "core/io/mitsuba/ply.h"
#include "core/io/mitsuba/serialized.h"
#include "core/io/obj_mesh.h"
#include "core/io/texture_file.h"
#include "core/scene/pack_scene.h"
#include "tests/support/files/sealed_bytes.h"
#include "tests/support/scenes/obj_difference.h"
#if PL_FUZZ_SCRIPTS
#include "tests/fuzz/play_script.h"
#endif

namespace pl::test {
namespace {

namespace fs = std::filesystem;

/// The process's own folder, in memory where the machine has that.
class FuzzFolder {
public:
    FuzzFolder() {
        const fs::path root = fs::is_directory("/dev/shm") ? fs::path("/dev/shm") : fs::temp_directory_path();
        path_ = root / ("pathlight-fuzz-" + std::to_string(::getpid()));
        fs::create_directories(path_);
    }
    ~FuzzFolder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    FuzzFolder(const FuzzFolder&) = delete;
    FuzzFolder& operator=(const FuzzFolder&) = delete;

    fs::path write(const std::string& name, std::string_view bytes) const {
        if (std::FILE* file = std::fopen((path_ / name).c_str(), "wb")) {
            if (!bytes.empty()) std::fwrite(bytes.data(), 1, bytes.size(), file);
            std::fclose(file);
        }
        return path_ / name;
    }

private:
    fs::path path_;
};

const FuzzFolder& folder() {
    static const FuzzFolder instance;
    return instance;
}

/// A defect: ends the process, so that a fuzzer keeps the input.
[[noreturn]] void fail(const char* what) {
    std::fprintf(stderr, "defect: %s\n", what);
    std::abort();
}

/// Runs `read`; an Error(Input) with words is an answer, too.
template <class Read>
void read_or_refuse(Read&& read) {
    try {
        read();
    } catch (const Error& error) {
        if (error.kind() != ErrorKind::Input) fail("an error of another kind than Input");
        if (std::string_view(error.what()).empty()) fail("an error without words");
    }
}

/// A scene that was accepted is one that can be packed into finite numbers.
void load_and_pack(const fs::path& path, const LoadSettings& asked = {}) {
    const SceneDescription scene = load_scene(path.string(), path.parent_path(), asked);
    if (scene.triangles.size() > 20000 || scene.instances.size() > 20000) return;
    const HostScene packed = pack_scene(scene);
    for (const auto& plane : packed.planes)
        for (int axis = 0; axis < 3; ++axis)
            if (!std::isfinite(plane.normal[axis])) fail("a normal that is no number");
    for (const DeltaLight& light : packed.delta_lights) {
        if (!std::isfinite(light.slope) || !std::isfinite(light.offset)) fail("a spot that is no number");
        for (int axis = 0; axis < 3; ++axis)
            if (!std::isfinite(light.axis[axis]) || !std::isfinite(light.intensity[axis]))
                fail("a light that is no number");
    }
    const Camera camera = make_camera(scene.camera, 64, 48);
    for (const Vec3f v : {camera.eye, camera.axis, camera.center, camera.right, camera.up})
        for (int axis = 0; axis < 3; ++axis)
            if (!std::isfinite(v[axis])) fail("a camera that is no number");
}

/// Behind this line of the input begins the material file.
constexpr std::string_view kCut = "\n%%%\n";

/// A text is read in chunks as it is at once, or refused in the same words.
void compare_chunks(std::string_view text, const glm::dvec3& origin) {
    const auto read = [&](std::size_t chunk_bytes, std::string& refusal) {
        try {
            return read_obj_text(text, "s.obj", 1, origin, chunk_bytes);
        } catch (const Error& error) {
            refusal = error.what();
            return ObjMesh{};
        }
    };
    constexpr std::size_t kSmallChunk = 16;
    std::string refusal_in_chunks;
    std::string refusal;
    const ObjMesh chunks = read(kSmallChunk, refusal_in_chunks);
    const std::string difference = obj_difference(chunks, read(kObjChunk, refusal));
    if (refusal_in_chunks != refusal) fail("another refusal in chunks");
    if (!difference.empty()) fail(("chunks that differ in " + difference).c_str());
}

void run_obj(std::string_view bytes) {
    const std::size_t cut = bytes.find(kCut);
    const bool has_materials = cut != std::string_view::npos;
    folder().write("m.mtl", has_materials ? bytes.substr(cut + kCut.size()) : std::string_view{});
    const fs::path path = folder().write("s.obj", bytes.substr(0, cut));
    read_or_refuse([&] { load_and_pack(path); });
    compare_chunks(bytes.substr(0, cut), glm::dvec3(0.0));
    compare_chunks(bytes.substr(0, cut), glm::dvec3(391240.0, -1e15, 0.125));
}

void run_json(std::string_view bytes) {
    folder().write(
        "s.obj", "mtllib m.mtl\ng a\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\ng b\nusemtl n\nv 0 0 1\nv 1 0 1\n"
                 "v 0 1 1\nf 4 5 6\n");
    folder().write("m.mtl", "newmtl m\nKd 0.5 0.5 0.5\nnewmtl n\nKd 0 0 0\nKe 1 1 1\n");
    const fs::path path = folder().write("s.json", bytes);
    read_or_refuse([&] { load_and_pack(path); });
}

/// A .gltf or .glb, which are told apart by their bytes, with copies and with instances.
void run_gltf(std::string_view bytes) {
    folder().write("b.bin", std::string(64, '\x3f'));
    const fs::path path = folder().write("s.glb", bytes);
    read_or_refuse([&] { load_and_pack(path); });
    read_or_refuse([&] { load_and_pack(path, {.most_copied_triangles = 0}); });
}

void run_mitsuba(std::string_view bytes) {
    folder().write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const fs::path path = folder().write("s.xml", bytes);
    read_or_refuse([&] { load_and_pack(path); });
    read_or_refuse([&] { load_and_pack(path, {.most_copied_triangles = 0}); });
}

void run_serialized(std::string_view bytes) {
    const fs::path path = folder().write("m.serialized", bytes);
    read_or_refuse([&] { read_serialized(path, 0); });
}

void run_ply(std::string_view bytes) {
    const fs::path path = folder().write("m.ply", bytes);
    read_or_refuse([&] { read_ply(path); });
}

void run_field(std::string_view bytes) {
    const fs::path as_it_is = folder().write("f.field", bytes);
    read_or_refuse([&] { read_field(as_it_is); });
    const fs::path file = folder().write("f.field", sealed(std::string(bytes)));
    read_or_refuse([&] { read_field(file); });
}

void run_checkpoint(std::string_view bytes) {
    const fs::path as_it_is = folder().write("c", bytes);
    read_or_refuse([&] { read_checkpoint(as_it_is); });
    const fs::path file = folder().write("c", sealed(std::string(bytes)));
    read_or_refuse([&] { read_checkpoint(file); });
}

void run_image(std::string_view bytes) {
    const fs::path path = folder().write("image", bytes);
    std::vector<std::string> warnings;
    read_or_refuse([&] {
        const TextureDescription texture = read_texture(path, TextureContent::Color, true, warnings);
        if (texture.texels.size() != std::size_t{texture.width} * texture.height) fail("texels of another size");
        if (texture.texels.size() > 100000) return;  // takes longer to look at than to read
        for (const glm::vec4& texel : texture.texels)
            for (int c = 0; c < 4; ++c)
                if (!(texel[c] >= 0.0f) || !std::isfinite(texel[c])) fail("a texel that is no light");
    });
    read_or_refuse([&] { read_linear(path); });
    read_or_refuse([&] { read_png8(path); });
}

#if PL_FUZZ_SCRIPTS
void run_script(std::string_view bytes) {
    std::vector<ScriptCommand> commands;
    read_or_refuse([&] {
        int before = 0;
        for (const ScriptCommand& command : parse_script(bytes, "fuzz.script")) {
            if (command.frame < before) fail("frames that go back");
            before = command.frame;
            if (!(std::fabs(command.x) <= 1.0e6) || !(std::fabs(command.y) <= 1.0e6))
                fail("a place outside of any window");
            holds(command.condition, "12.5");
            holds(command.condition, "default");
            commands.push_back(command);
        }
    });
    if (commands.empty()) return;
    try {
        play_script(std::move(commands));
    } catch (const Error& error) {
        if (error.kind() != ErrorKind::Runtime) fail("an error of another kind than Runtime");  // no such control
    } catch (const std::logic_error& defect) {
        fail(defect.what());
    }
}
#endif

constexpr FuzzEntry kEntries[] = {
    {"obj", run_obj},       {"json", run_json},
    {"gltf", run_gltf},     {"mitsuba", run_mitsuba},
    {"ply", run_ply},       {"serialized", run_serialized},
    {"field", run_field},   {"checkpoint", run_checkpoint},
    {"image", run_image},
#if PL_FUZZ_SCRIPTS
    {"script", run_script},
#endif
};

}  // namespace

std::span<const FuzzEntry> fuzz_entries() { return kEntries; }

const FuzzEntry* find_fuzz_entry(std::string_view name) {
    for (const FuzzEntry& entry : kEntries)
        if (entry.name == name) return &entry;
    return nullptr;
}

}  // namespace pl::test
