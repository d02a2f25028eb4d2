#pragma once

#include <filesystem>
#include <optional>

#include "materials/base/section.hpp"
#include "materials/matter/material.hpp"

namespace diurna {

/// The keys of a material that say how light is sent back and let through; mistakes are noted.
///
/// - finish: one of
///     - { kind = "lambert" }
///     - { kind = "gloss", roughness, index }: paint, varnish, glass, water; in place of index
///       index_file, a CSV file of wavelength_um, n and k
///     - { kind = "metal", roughness }, by Schlick's law, or with an index_file by its index
///     - either with effective_index = true: the index that sends back the reflectance upright
///     - { kind = "by_angle", factors = [[angle_deg, factor], ...] }
///     - { kind = "measured", file }: a BRDF (materials/matter/read_brdf.hpp)
/// - see_through: true where rays go on behind it, as far as its transmittance lets them
/// - cover: 0 to 1, of a net: this share is the material and the rest is open
///
/// To be read after reflectance, transmittance and the means that follow from them. With a finish
/// that is not Lambert's the broadband emissivity becomes the hemisphere's, unless it was given.
void read_finish(const Section& section, const std::filesystem::path& folder, Material& material);

/// What a material's `finish` says.
inline constexpr const char* finish_says = "how light is sent back over the angle";

/// From where to where a material's index_file has n and k, which go on beyond its ends.
struct IndexReach {
    double from_um, to_um;
    double needed_to_um;   // where another law takes over; 1e3: nowhere
    bool effective_helps;  // of a gloss
};
/// Of a material that was read before as `finish`; none without such a file, or where its index
/// serves nowhere.
std::optional<IndexReach> index_reach(const Section& section, const std::filesystem::path& folder,
                                      const Glossy& finish);

}  // namespace diurna
