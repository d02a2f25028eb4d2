#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <span>

#include "materials/atmosphere/atmosphere.hpp"
#include "materials/atmosphere/moonlight.hpp"
#include "materials/matter/library.hpp"
#include "render/view/view.hpp"
#include "terrain/facets.hpp"
#include "terrain/place/instant.hpp"
#include "terrain/place/site.hpp"
#include "terrain/visibility/view_factors.hpp"

namespace diurna {

/// Level ground beyond the scene's edge, open to the whole sky, up to the horizon.
struct FarGround {
    MaterialId material{};
    double temperature = 288.0;  // [K]
    double height_km = 0.0;      // above the sea
};

/// The state of the scene at one instant: all inputs of a picture except the view.
struct RadianceInput {
    const FacetSet& facets;
    const FacetViews& views;
    const MaterialLibrary& materials;
    const Atmosphere& atmosphere;
    std::span<const float> temperature;                 // (facet) [K], 1 to 5000
    std::span<const float> sun_fraction = {};           // (facet) 0 to 1; empty: no sun
    Eigen::Vector3d to_sun = Eigen::Vector3d::UnitZ();  // unit
    double sun_zenith_deg = 180.0;
    double sun_distance_au = 1.0;
    double ground_height_km = 0.0;  // of the scene's origin above the sea
    Instant instant{};
    /// The moon replaces the sun: sun_fraction, to_sun and sun_zenith_deg are the moon's,
    /// sun_distance_au is 1.
    std::optional<MoonLight> moon{};
    double wind_speed = 3.0;  // [m s⁻¹] 12.5 m above water: its roughness
    /// None: beyond the edge is a black plain at ground_height_km, at the temperature of the air.
    std::optional<FarGround> beyond{};
    /// One height above the sea [km] whose sun and sky all facets have; none: each its own's.
    std::optional<double> light_height_km{};
    /// Height above the sea [km] at which sun and sky change at once: a cloud's top.
    double light_edge_km = std::numeric_limits<double>::infinity();

    /// Height above the sea [km] of the ground beyond the scene's edge.
    double plain_height_km() const { return beyond ? beyond->height_km : ground_height_km; }

    /// Height above the sea [km] of a height above the origin's level surface [m].
    double above_sea_km(double height) const { return ground_height_km + 1e-3 * height; }
    /// Height above the sea [km] whose sun and sky a facet has: of its middle.
    double height_km(SurfaceId facet) const {
        if (light_height_km) return *light_height_km;
        return above_sea_km(level_height(facets.centroid[index(facet)].cast<double>()));
    }
};

/// Calls body(surface, factor) for each that a surface sees, with the view factor scaled so that
/// the sum is 1 − sky view: ground beyond the scene's edge looks like the visible surroundings.
/// Never called without any.
template <class Body>
void each_seen_facet(const FacetViews& views, SurfaceId facet, const Body& body) {
    const ViewFactors& others = views.others;
    const std::size_t f = index(facet);
    double total = 0.0;
    for (std::uint32_t k = others.row[f]; k < others.row[f + 1]; ++k) {
        total += double{others.factor[k]};
    }
    const double rest = 1.0 - double{views.sky[f]};
    for (std::uint32_t k = others.row[f]; k < others.row[f + 1]; ++k) {
        if (others.factor[k] == 0.0f) continue;  // a row of zeros counts as empty
        body(SurfaceId{others.facet[k]}, rest * double{others.factor[k]} / total);
    }
}

}  // namespace diurna
