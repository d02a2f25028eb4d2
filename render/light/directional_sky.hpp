#pragma once

#include <array>
#include <span>
#include <utility>
#include <vector>

#include "materials/atmosphere/sun_field.hpp"
#include "render/light/narrow_sky.hpp"
#include "render/light/radiance_input.hpp"
#include "terrain/visibility/sky_basis.hpp"

namespace diurna {

// The sky's light by direction, in the even functions of terrain/visibility/sky_basis.hpp with the
// sun (or moon) towards x, relative to level ground:
//
//     L(ω) = L_mean + Σ c_k (f_k(ω) − T_k of level ground),    k = 1 to 9
//
// so that level ground receives the mean, and a facet V L_mean + Σ c_k u_k, u_k its UnevenView. The
// residual of the fit of scattered sunlight is used for facets that see little of the sky
// (narrow_sky.hpp).

inline constexpr std::size_t uneven_functions = even_sky_functions - 1;
using UnevenView = std::array<float, uneven_functions>;

/// T_k of a facet minus its sky view times those of level ground; all 0 on open level ground.
UnevenView uneven_view(const RadianceInput& input, SurfaceId facet);
/// Shares of its sky by direction relative to the sun.
NarrowView narrow_view(const RadianceInput& input, SurfaceId facet);
/// The same for many facets at once, some tens.
void narrow_views(const RadianceInput& input, std::span<const SurfaceId> facet,
                  std::span<NarrowView> view);
/// For a wall on open ground that faces the sun, or away from it.
UnevenView uneven_view_of_wall(bool sunward);

/// Thermal radiance of air and clouds at a height [W m⁻² sr⁻¹ µm⁻¹], (node).
struct HeatOfSky {
    std::vector<double> mean;  // L_mean, ∫₀¹ L d(cos²θ) by eight Gauss points
    std::array<std::vector<double>, 3> uneven;  // c_k of the first functions; the others are zero
};
HeatOfSky heat_of_sky(const Atmosphere& atmosphere, double height_km,
                      std::span<const double> node_um);

/// Distribution of scattered sunlight, as shares of its irradiance on level ground, (node). Near
/// the sun its peak is too sharp for the functions: the excess within 12° counts as coming from the
/// sun itself.
struct SunlitShape {
    std::vector<double> aureole;                                 // on a plane facing the sun
    std::vector<double> mean;                                    // L_mean of the rest [sr⁻¹]
    std::array<std::vector<double>, uneven_functions> uneven{};  // its c_k [sr⁻¹]
    std::vector<std::vector<double>> left;  // (direction of half_sky)(node) residual [sr⁻¹]
};
SunlitShape sunlit_shape(const SunField& field, const BandModel& model, double height_km,
                         double zenith_deg);

/// Sunlight scattered by the scene's air, and its distribution over the sky.
struct ScatteredSun : SunField {
    ScatteredSun(SunField field, const RadianceInput& input)
        : SunField(std::move(field)),
          shape(sunlit_shape(*this, std::get<BandModel>(input.atmosphere), input.ground_height_km,
                             input.sun_zenith_deg)) {}
    SunlitShape shape;
};

}  // namespace diurna
