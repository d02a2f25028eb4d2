#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "terrain/facets.hpp"
#include "terrain/texture/texture_levels.hpp"
#include "terrain/visibility/copies.hpp"

namespace diurna {

struct ViewOptions {
    int samples = 16;  // a pixel: multiples of 16 fill whole ray packets
    std::uint64_t seed = 1;
    /// Where a sample meets a textured facet it counts for the two levels mixed there
    /// (textured_hit.hpp), in parts of 2^-16; null: no textures.
    const TextureLevels* texture_levels = nullptr;
    /// (pixel) pixels to be cast (non-zero); empty: all. The others see nothing, and their centres
    /// are not cast.
    std::span<const std::uint8_t> asked = {};
};

/// A pixel's view of one target.
struct Sighting {
    std::uint32_t target = 0;  // index into View::surface
    float weight = 0.0f;       // share of the pixel, 0 to 1
    float deeper = 0.0f;       // [m] range beyond the target's, mean over the samples that hit
    float higher = 0.0f;       // [m] height above the target's
};

/// Range of a view's targets.
struct ViewExtent {
    float near = 0.0f, far = 0.0f;  // [m] ranges of targets
    float low = 0.0f, high = 0.0f;  // [m] their heights
    std::size_t sky_pixels = 0;     // that see sky
    std::array<float, 2> sky_zenith_deg{}, sky_azimuth_deg{};
};

/// Visible facets of every pixel of an observer, cast once and valid for every instant and band
/// while nothing moves. Weights of a pixel's sightings and of its sky add up to 1.
///
/// A target is a surface seen in a tile of 32 x 32 pixels, or a part of it if it is so deep that
/// the air in front of it is not linear in range and height: parts span at most 1/128 of an octave
/// of range and 16 m of height. So a target's radiance at the eye is computed once, with two
/// slopes. Targets are numbered tile by tile in order of appearance, so that neighbours in the
/// picture are neighbours in memory; a surface on a border of tiles has several.
struct View {
    int width = 0, height = 0;
    std::size_t facets = 0;            // of the scene it was cast on: surfaces
    std::vector<SurfaceId> surface;    // (target)
    std::vector<float> range;          // (target) [m] mean over its sightings
    std::vector<float> range_root;     // (target) [m^⅓] its cube root
    std::vector<float> target_height;  // (target) [m] above the origin's level surface, earth's
                                       // curvature included; mean over its sightings
    std::vector<std::uint32_t> row;    // (pixel + 1) sightings of pixel p: [row[p], row[p + 1])
    std::vector<Sighting> sighting;
    std::vector<float> sky;              // (pixel) share that sees no facet
    std::vector<float> sky_zenith_deg;   // (pixel) mean direction of that share; 0 if none
    std::vector<float> sky_azimuth_deg;  // (pixel) of the pixel's middle from the optical axis,
                                         // −180 to 180; 0 without sky
    std::vector<FacetId> centre;         // (pixel) facet at the pixel's centre, or no_facet
    std::vector<float> centre_range;     // (pixel) [m]; NaN without a facet
    std::vector<Blend> centre_blend{};   // (pixel) levels of `centre`; empty: no textures
    // For a scene with copies: the copy a facet is in, or no_copy; else both are empty.
    Copies copies{};
    std::vector<std::uint32_t> copy{};         // (target)
    std::vector<std::uint32_t> centre_copy{};  // (pixel)
    double observer_height = 0.0;              // [m] above the origin's level surface
    std::uint64_t rays = 0;                    // cast to make it
    /// (pixel) Number of samples that leave the error of those it has, which may have been taken in
    /// two rounds; empty: no error is to be estimated.
    std::vector<float> samples{};
    ViewExtent extent;

    std::size_t pixels() const { return sky.size(); }
    float range_of(const Sighting& s) const { return range[s.target] + s.deeper; }
    float height_of(const Sighting& s) const { return target_height[s.target] + s.higher; }
    std::uint32_t copy_of(std::uint32_t target) const {
        return copy.empty() ? no_copy : copy[target];
    }
    std::uint32_t copy_at(std::size_t pixel) const {
        return centre_copy.empty() ? no_copy : centre_copy[pixel];
    }
    /// Surfaces at a pixel's centre, where it sees a facet.
    Blend surfaces_at(std::size_t pixel) const {
        if (!centre_blend.empty()) return centre_blend[pixel];
        return {own_surface(centre[pixel]), own_surface(centre[pixel])};
    }
    /// At a pixel's centre; `of` are the facets it was cast on.
    ObjectId object_at(const FacetSet& of, std::size_t pixel) const {
        const std::uint32_t in = copy_at(pixel);
        return in == no_copy ? of.object[index(centre[pixel])] : copies[in].object;
    }
};

}  // namespace diurna
