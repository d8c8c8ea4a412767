// Coats of Mitsuba: a dielectric layer over another surface.
#pragma once

#include "core/io/mitsuba/surfaces.h"

namespace pl {

/// Puts a coat, a `bsdf` element of the type coating or roughcoating, on a surface and all that it blends with: diffuse ones become
/// plastic, mirrors under a smooth coat mirrors of both reflectances. Others stay as they are, and the coat is noted.
/// [Mitsuba 0.6, coating]
void add_mitsuba_coat(const MitsubaObject& coat, MitsubaSurface& surface);

}  // namespace pl
