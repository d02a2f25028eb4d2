#pragma once

#include <filesystem>
#include <optional>

#include "materials/base/section.hpp"
#include "materials/matter/material.hpp"

namespace diurna {

/// The key of a material that says how light is sent back over the angle; mistakes are noted.
///
/// - finish: one of
///     - { kind = "lambert" }
///     - { kind = "gloss", roughness, index }: paint, varnish, glass, water; in place of index
///       index_file, a CSV file of wavelength_um, n and k
///     - { kind = "metal", roughness }, by Schlick's law, or with an index_file by its index
///     - either with effective_index = true: the index that sends back the reflectance upright
///     - { kind = "by_angle", factors = [[angle_deg, factor], ...] }
///     - { kind = "measured", file }: a BRDF (materials/matter/read_brdf.hpp)
///
/// To be read after reflectance, transmittance and the means that follow from them, all of a net's
/// strips. With a finish that is not Lambert's the broadband emissivity becomes the hemisphere's,
/// unless it was given.
///
/// anew  whether those means are of spectra or of a finish that are new; else they are what the
///       hemisphere's were
void read_finish(const Section& section, bool anew, Material& material);

/// What a material's `finish` says.
inline constexpr const char* finish_says = "reflectance as a function of angle";

/// From where to where a material's index_file has n and k, which go on beyond its ends.
struct IndexReach {
    double from_um, to_um;
    double needed_to_um;   // where another law takes over; 1e3: nowhere
    bool effective_helps;  // of a gloss
};
/// Of a material that was read before as `finish`; none without such a file, or where its index
/// serves nowhere.
std::optional<IndexReach> index_reach(const Section& section, const Glossy& finish);

}  // namespace diurna
