// Directional albedo of GGX facets by single scattering, as an integral without noise.
#pragma once

namespace pl {

/// Light that counts, of facets with the Fresnel reflectance of a dielectric or, for Mirror, of 1.
enum class FacetLight {
    Mirror,     ///< all of it, which is reflected
    Reflected,  ///< what is reflected
    Scattered,  ///< what is reflected and what is refracted
};

/// Share of an even sky's light that facets of width `alpha`, in (0, 1], send towards a direction of cosine `cos_o`, in (0, 1], by one
/// reflection or refraction each, with the height-correlated masking of GgxOf. `eta`: as in fresnel_dielectric(). Good to 1e-4, and to
/// 2e-5 in the root mean square, for cosines from 0.03.
double facet_albedo(FacetLight light, double alpha, double cos_o, double eta);

}  // namespace pl
