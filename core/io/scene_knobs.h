// Knobs of a scene file: named numbers that move groups of the mesh or set the albedo of materials.
#pragma once

#include "core/io/json_document.h"
#include "core/io/obj.h"
#include "core/scene/description.h"

namespace pl {

/// Reads the member `knobs` of a scene file into scene.knobs and applies `asked`. A knob at its default touches nothing:
/// the scene has the bits of the mesh file. Else, with `turned` the value less the default, it does all of
///   moves   [{groups, by: [x, y, z]}]            by `turned` times this vector
///   turns   [{groups, about, axis, by_deg}]      by `turned` times so many degrees about the axis through a point,
///                                                counter-clockwise for who looks against the axis
///   scales  [{groups, about, by: [x, y, z]}]     by 1 + `turned` times these numbers, away from a point
///   albedo  [material, ...]                      gray of this very value
/// in this order. Throws Error(Input) with file and line for what is wrong in the files, whatever the values: a group
/// or material that is not there, a group that shares a vertex or normal with a part that stays, a scale that reaches
/// 0, an albedo that is not the default. Throws Error(Usage) for a value out of range or a name that no knob has.
void read_knobs(const JsonDocument& file, SceneDescription& scene, const MeshGroups& groups, const KnobValues& asked);

/// Throws Error(Usage) if a knob is asked for that the scene does not have.
void require_known_knobs(const SceneDescription& scene, const KnobValues& asked);

}  // namespace pl
