// Knobs of a scene file: named parameters that transform groups of the mesh or set the albedo of materials.
#pragma once

#include "core/io/json_document.h"
#include "core/io/obj.h"
#include "core/scene/description.h"

namespace pl {

/// Reads the member `knobs` of a scene file into scene.knobs and applies the values `asked`. A knob at its default
/// changes no bit of the mesh. The scene has no instances. Otherwise, with `turned` = value - default, it applies in this order
///   moves   [{groups, by: [x, y, z]}]            by `turned` times this vector
///   turns   [{groups, about, axis, by_deg}]      by `turned` times this angle about an axis through a point,
///                                                right-handed
///   scales  [{groups, about, by: [x, y, z]}]     by 1 + `turned` times these factors, about a point
///   albedo  [material, ...]                      gray of the value itself
/// Throws Error(Input) with file and line for errors of the files, whatever the values: an unknown group or material,
/// a group that shares a vertex or normal with a part that does not move, a scale that reaches 0, an albedo different
/// from the default. Throws Error(Usage) for a value out of range or an unknown knob.
void read_knobs(const JsonDocument& file, SceneDescription& scene, const MeshGroups& groups,
                const ParameterTexts& asked);

/// Throws Error(Usage) for a knob that the scene does not have.
void require_known_knobs(const SceneDescription& scene, const ParameterTexts& asked);

}  // namespace pl
