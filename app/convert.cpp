// `pathlight convert`: any scene that opens, written in the program's own format.
#include <fmt/format.h>

#include "app/commands.h"
#include "app/open_scene.h"
#include "core/io/write_scene.h"
#include "core/scene/instances.h"

namespace pl {

int run_convert(const CommandLine& line, Console& console) {
    const LoadedScene loaded = open_scene(line.options.scene, line.options.load, console);
    const SceneDescription& scene = *loaded.scene;
    const std::uint64_t triangles = shown_triangles(scene);
    const SceneParts parts = write_scene(scene, line.options.output);
    if (!scene.knobs.empty())
        console.log().warning(
            fmt::format("{}: its knobs are left out: mesh and materials have their values", scene.source.string()));
    console.result(fmt::format("{}: {} triangles, {} materials, {} images in {}\n", line.options.output, triangles,
                               scene.materials.size(), parts.images, parts.folder.string()));
    console.event("convert", {{"file", line.options.output},
                              {"folder", parts.folder.string()},
                              {"triangles", triangles},
                              {"materials", scene.materials.size()},
                              {"images", parts.images}});
    return 0;
}

}  // namespace pl
