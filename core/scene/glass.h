// Surfaces that reflect and transmit light and have no albedo.
#pragma once

#include "core/kernel/shading/surface_lobes.h"

namespace pl {

/// Whether a surface transmits light: solid glass and thin panes.
inline bool is_glass(SurfaceKind kind) { return kind == SurfaceKind::Dielectric || kind == SurfaceKind::Pane; }

/// Whether paths enter the inside of a surface.
inline bool has_inside(SurfaceKind kind) { return kind == SurfaceKind::Dielectric; }

}  // namespace pl
