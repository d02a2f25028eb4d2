#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "materials/radiation/band.hpp"
#include "render/light/interreflection.hpp"
#include "render/light/lit_facets.hpp"
#include "render/light/node_optics.hpp"
#include "render/light/spectral_basis.hpp"
#include "render/path/path_table.hpp"
#include "render/path/scattered_path.hpp"
#include "render/rays/angle_table.hpp"
#include "render/rays/hops.hpp"
#include "render/sky_table.hpp"

namespace diurna {

/// What a facet of the hops sends and receives: rows of lanes, one a part. `closed` to
/// `closed_behind` are the terms of a closed facet, `closed` their sum.
enum class FacetPart { black, open, around, closed, emitted, sun, sky, surroundings, behind };
inline constexpr std::size_t facet_parts = 9;

/// Of one band.
struct HopBand {
    Band band;
    Channels channels;
    std::optional<SunField> scattered;
    std::array<Light, 3> light;             // at the heights of LitFacets
    std::vector<NodeOptics> optics;         // (material)
    std::vector<std::vector<float>> probe;  // (probe)(channel)
    SpectralBasis basis;
    std::optional<SkyTable> from_eye, from_mirror;
    std::optional<ScatteredPath> haze;  // sunlight scattered before places on the line of sight
};

/// All that the hops of a view need at an instant before any pixel is looked at, in the channels of
/// all bands side by side (lanes): so that a hop's place in a table is found once for all of them.
struct HopTables {
    HopTables(const Hops& hops, std::span<const Plume> plumes, double observer_height,
              std::span<const Band> bands, const RadianceInput& input, int bounces,
              double tolerance);
    HopTables(const HopTables&) = delete;  // its tables refer to each other

    const Hops& hops;
    const RadianceInput& input;
    std::vector<HopBand> band;
    Lanes lanes;
    std::vector<std::uint32_t> place;  // (hop) index of its facet in `lit.target`
    LitFacets lit;
    LitState state;
    std::vector<float> facet;                    // (facet of the hops, part, lane)
    std::vector<AngleTable> angle;               // (material), where needed
    std::vector<std::vector<float>> room;        // (material)(lane) τ B of the room behind
    std::vector<std::vector<float>> absorption;  // (plume)(lane) [m⁻¹]
    std::vector<std::vector<float>> glow;        // (plume)(lane) B(T)
    std::array<std::vector<float>, 3> sun;       // (height of LitFacets)(lane)

    const float* part(std::uint32_t facet_place, FacetPart p) const {
        return &facet[(facet_place * facet_parts + static_cast<std::size_t>(p)) * lanes.size()];
    }
    /// Transmittance and radiance of the air to a place, (lane).
    void air_to(float range, float height_km, float* transmittance, float* radiance) const;
    /// Radiance of the background in a direction, (lane): seen straight, or in a mirror.
    void sky_towards(const Eigen::Vector3d& direction, bool straight, std::span<float> out) const;
    /// [deg]
    double angle_from_sun(const Eigen::Vector3f& direction) const;

 private:
    void prepare(HopBand& of);
    void look_up(double observer_height);
    void send(std::span<const FacetId> facets, int bounces, double tolerance);
    void fill_facet(std::size_t facet_place, std::size_t of_band, std::span<const float> around);
    void fill_air(const PathExtent& extent, double tolerance);

    std::span<const Plume> plumes_;
    std::vector<Band> bands_;
    std::vector<Channels> channels_;
    std::vector<std::vector<std::vector<float>>> probe_;  // (band)(probe)(channel)
    std::optional<PathTable> path_;
    std::vector<float> air_;  // (range, height, transmittance or radiance, lane)
};

}  // namespace diurna
