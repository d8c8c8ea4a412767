// Interfaces of dielectrics, and coats, which have one over another surface.
#pragma once

#include "core/io/mitsuba/surfaces.h"
#include "core/io/mitsuba/xml_file.h"
#include "core/scene/description.h"

namespace pl {

// Interfaces of Mitsuba's surfaces: indices of refraction, facets, and the reflectance of metals.

/// Index of refraction `int_ior` over `ext_ior`, as numbers or names.
float index_ratio(const MitsubaObject& bsdf, float standard);

/// The nearest valid index of refraction, with a note if it is another one.
float usable_ior(const MitsubaObject& bsdf, float ior);

/// Sets the roughness of a material by `alpha` and `distribution`; conductors get the anisotropy of `alpha_u` and `alpha_v`, too.
void read_mitsuba_facets(const MitsubaObject& bsdf, MaterialDescription& material);

/// Share of diffuse light that a smooth interface reflects from inside. [d'Eon and Irving 2011]
double internal_reflectance(double eta);

/// Edge tint of a conductor by its reflectance at normal incidence and at kEdgeCosine.
float edge_tint_of(float normal, float edge);

// Coats of Mitsuba: a dielectric layer over another surface.

/// Puts a coat, a `bsdf` element of the type coating or roughcoating, on a surface and all that it blends with: diffuse ones become
/// plastic, mirrors under a smooth coat mirrors of both reflectances. Others stay as they are, and the coat is noted.
/// [Mitsuba 0.6, coating]
void add_mitsuba_coat(const MitsubaObject& coat, MitsubaSurface& surface);

}  // namespace pl
