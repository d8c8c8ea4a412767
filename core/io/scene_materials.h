// The members `materials` and `environment` of a scene file.
#pragma once

#include <optional>

#include "core/io/json_document.h"
#include "core/io/json_file.h"
#include "core/scene/description.h"

namespace pl {

/// Reads `materials`: overrides of MTL entries, name -> any of
///   surface                                    the name of a kind, see kSurfaces
///   the names of kMaterialParameters           numbers, or [r, g, b]
///   emission                                   [r, g, b]
///   two_sided_emission                         true, false
///   normal_strength, opacity                   numbers
///   opacity_rule                               "threshold", "blend": the standard of an opacity below 1
///   normal_green                               "up", "down", "left"
///   blend                                      { with, share, image, image_wrap }: the name of a material, "" for none; a number in
///                                              [0, 1]; an image that multiplies it, as below
///   albedo_map, roughness_map, emission_map, opacity_map, normal_map    images in the folder of the scene or below; "" for none
///   wrap                                       "repeat" (default) or "clamp", for these images
///   albedo_map_wrap and so on                  the same for one of them
/// See MaterialDescription. Throws Error(Input) with file and line.
void read_materials(const JsonDocument& file, SceneDescription& scene);

/// Reads a file of the schema "pathlight.materials/1" with the member `materials` as in scene files, applied after it.
/// Throws Error(Input) with file and line.
void read_material_file(const std::filesystem::path& path, SceneDescription& scene);

/// All values of a material but its images and the name of the one that it blends with, for read_materials().
Json material_json(const MaterialDescription& material);

/// Writes such a file with all values of these materials but their images and the names of those that they blend with. Throws
/// Error(Runtime).
void write_material_file(const std::filesystem::path& path, const std::vector<MaterialDescription>& materials);

/// Reads `environment`:
///   radiance [r, g, b]; map (an image), scale, rotation_deg, axes [x, y, z]; sun { direction, radiance, angle_deg };
///   or in place of map and sun: sky { turbidity, sun_direction, up, albedo, scale, sun_scale }, see SkyDescription
/// Throws Error(Input) with file and line, also for an image that cannot be read, because the scene would be dark.
void read_environment(const JsonDocument& file, SceneDescription& scene);

}  // namespace pl
