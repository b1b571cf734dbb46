// What the surface of a medium does to light, as far as fluxes under uniform light go.
#pragma once

namespace meander {

/// matched: no interface. diffuse: light enters and leaves cosine-distributed; with an index step each
/// crossing also passes Fresnel's reflection, at the cosine drawn. dielectric: Fresnel reflection and
/// refraction.
enum class Boundary { matched, diffuse, dielectric };

/// ior is the index inside over the index outside, in [1, 4]; 1 where the boundary is matched. roughness is
/// that of a dielectric boundary, in [0, 1]; 0 elsewhere.
struct Surface {
  Boundary boundary = Boundary::matched;
  double ior = 1;
  double roughness = 0;

  [[nodiscard]] bool operator==(const Surface&) const noexcept = default;
};

/// Unpolarised Fresnel reflectance from inside (Born & Wolf 1999, section 1.5.2): cos_i in [0, 1] the cosine
/// inside; 1 under total internal reflection.
[[nodiscard]] double internal_reflectance(double cos_i, double ior);

/// Mean Fresnel reflectance of uniform light from outside, F_ext, within 1e-12 for ior in [1, 4].
[[nodiscard]] double diffuse_external_reflectance(double ior);

/// Mean Fresnel reflectance of uniform light from inside, 1 - (1 - F_ext) / ior^2.
[[nodiscard]] double diffuse_internal_reflectance(double ior);

}  // namespace meander
