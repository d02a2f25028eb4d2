#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "materials/band.hpp"
#include "materials/units.hpp"
#include "render/hop_angles.hpp"
#include "render/hops.hpp"
#include "render/leaving.hpp"
#include "render/lit_facets.hpp"
#include "render/node_optics.hpp"
#include "render/path_table.hpp"
#include "render/scattered_path.hpp"
#include "render/sky_table.hpp"
#include "render/spectral_basis.hpp"

namespace diurna {

/// What a facet of the hops sends and receives, in channels.
struct FacetLight {
    enum Part { black, open, around, emitted, sun, sky, surroundings, behind, parts };
    std::vector<float> value;  // (part, channel): black body, light of the sky and of the
                               // surroundings on it, then the terms of a closed facet
};

constexpr std::array<std::pair<Term, FacetLight::Part>, 5> closed_terms = {
    {{Term::emitted, FacetLight::emitted},
     {Term::sun, FacetLight::sun},
     {Term::sky, FacetLight::sky},
     {Term::surroundings, FacetLight::surroundings},
     {Term::behind, FacetLight::behind}}};

/// All that one band needs.
struct BandLight {
    std::optional<SunField> scattered;
    std::array<Light, 3> light;  // at the heights of LitFacets
    std::vector<NodeOptics> optics;
    Channels channels;
    SpectralBasis basis;
    std::vector<FacetLight> facet;               // (facet of the hops)
    std::vector<AngleTable> angle;               // (material), where needed
    std::vector<std::vector<float>> room;        // (material)(channel) τ B of the room behind
    std::vector<std::vector<float>> absorption;  // (plume)(channel) [m⁻¹]
    std::vector<std::vector<float>> glow;        // (plume)(channel) B(T)
    std::array<std::vector<float>, 3> sun;       // (height)(channel)
    std::optional<SkyTable> from_eye, from_mirror;
    std::optional<ScatteredPath> haze;  // sunlight scattered before places on the line of sight
    float angle_deg(const Eigen::Vector3f& direction, const Eigen::Vector3d& to_sun) const {
        const double cosine = direction.cast<double>().dot(to_sun);
        return static_cast<float>(degrees(std::acos(std::clamp(cosine, -1.0, 1.0))));
    }
};

/// All that the hops of a view need at an instant, before any pixel is looked at.
struct HopTables {
    const Hops& hops;
    const RadianceInput& input;
    std::span<const Plume> plumes;
    std::vector<Band> bands;
    std::vector<FacetId> facets{};       // in the hops
    std::vector<std::uint32_t> place{};  // (hop) index of its facet above
    LitFacets lit{};
    LitState state{};
    std::vector<Channels> channels{};
    std::vector<std::vector<std::vector<float>>> probe{};
    std::vector<BandLight> band{};
    std::optional<PathTable> path{};

    HopTables(const Hops& hops, std::span<const Plume> plumes, double observer_height,
              std::span<const Band> bands, const RadianceInput& input, int bounces,
              double tolerance);
    HopTables(const HopTables&) = delete;  // its tables refer to each other

 private:
    void prepare(std::size_t b, double eye_km);
    void send(int bounces, double tolerance);
};

}  // namespace diurna
