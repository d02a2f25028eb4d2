#include "scenes/job/run/remembered_sun.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <variant>

#include "materials/base/units.hpp"
#include "render/view/pixel_heat.hpp"
#include "scenes/job/run/sun_on_surfaces.hpp"
#include "terrain/place/sun.hpp"
#include "thermal/column/step_response.hpp"

namespace diurna {

namespace {

constexpr double minute = 60.0;
/// [s] Ends of the times before a picture, and a moment in each, at which facets' shares are taken.
constexpr std::array<double, 6> ends{0.0,         2 * minute,  10 * minute,
                                     30 * minute, 90 * minute, 240 * minute};
constexpr std::array<double, 5> lags{0.0, 6 * minute, 20 * minute, 60 * minute, 165 * minute};

/// Beam on level ground under a clear sky, relative.
double strength(const SunPosition& sun) {
    const double sine = std::sin(radians(sun.elevation_deg));
    return sine <= 0.0 ? 0.0 : sine * std::exp(-0.25 / std::max(0.05, sine));
}

/// [W m⁻² K⁻¹] Of air (Jürges 1924: 5.7 + 3.8 U) and of radiation at its temperature.
double film_of(const ThermalSurface& surface, const Forcing& weather) {
    const auto* constant = std::get_if<ConstantFilm>(&surface.convection);
    const double air = constant ? constant->film : 5.7 + 3.8 * weather.wind_speed;
    return air + 4.0 * surface.emissivity * stefan_boltzmann * std::pow(weather.air.temperature, 3);
}

/// Weights of the moments, sum 1; the present alone: the surface follows at once.
std::array<double, lags.size()> weights_of(const ThermalSurface& surface, double film,
                                           const std::array<double, lags.size()>& sun) {
    std::array<double, lags.size()> weight{1.0};
    if (follows_at_once(surface) || std::holds_alternative<TwoSource>(surface.canopy))
        return weight;
    const std::vector<double> warm = step_response(surface, film, std::span(ends).subspan(1));
    double sum = 0.0;
    for (std::size_t k = 0; k < weight.size(); ++k) {
        weight[k] = (warm[k] - (k > 0 ? warm[k - 1] : 0.0)) * sun[k];
        sum += weight[k];
    }
    constexpr double enough = 0.95;  // of the present: follows at once
    if (!(sum > 0.0) || weight[0] > enough * sum) return {1.0};
    for (double& w : weight) w /= sum;
    return weight;
}

/// Instants of equal weight: seconds before the picture, uniform within each time.
PastSun::Course course_of(const std::array<double, lags.size()>& weight, const Prepared& prepared,
                          Instant instant) {
    PastSun::Course course;
    std::size_t k = 0;
    double passed = 0.0;
    for (std::size_t q = 0; q < course.size(); ++q) {
        const double place = (double(q) + 0.5) / double(course.size());
        while (k + 1 < weight.size() && passed + weight[k] < place) passed += weight[k++];
        const double within = std::clamp((place - passed) / weight[k], 0.0, 1.0);
        const double lag = std::lerp(ends[k], ends[k + 1], within);
        course[q] = sun_direction(sun_over(prepared, later(instant, -lag)));
    }
    return course;
}

/// Of the wanted surfaces those that objects can shade.
std::vector<SurfaceId> shaded_by_objects(const World& world, const FacetViews& views,
                                         std::span<const SurfaceId> wanted) {
    const TextureLevels& levels = world.texture_levels;
    const auto of_object = [&](auto f) {
        return index(levels.facet_of(surface_id(static_cast<std::size_t>(f)))) >=
               world.ground_facets;
    };
    // What a box hides six times its height away, where a sun 10 degrees high still shades.
    constexpr double least_view = 0.002;
    const auto sees_object = [&](std::size_t f, const ViewFactors& views_of) {
        if (views_of.row.empty()) return false;
        double sum = 0.0;
        for (std::uint32_t k = views_of.row[f]; k < views_of.row[f + 1]; ++k) {
            if (of_object(views_of.facet[k])) sum += double{views_of.factor[k]};
        }
        return sum > least_view;
    };
    std::vector<SurfaceId> found;
    for (const SurfaceId facet : wanted) {
        const auto f = index(facet);
        if (of_object(facet) || sees_object(f, views.others) || sees_object(f, views.copied)) {
            found.push_back(facet);
        }
    }
    return found;
}

}  // namespace

RememberedSun remembered_sun(const Prepared& prepared, const FacetViews& views,
                             std::span<const float> fraction, std::span<const SurfaceId> wanted,
                             Instant instant) {
    RememberedSun found;
    if (fraction.empty() || wanted.empty() || !prepared.movement.none()) return found;
    const std::vector<SurfaceId> shaded = shaded_by_objects(prepared.world, views, wanted);
    if (shaded.empty()) return found;
    std::array<SunPosition, lags.size()> sun{};
    std::array<double, lags.size()> strong{};
    for (std::size_t k = 0; k < lags.size(); ++k) {
        sun[k] = sun_over(prepared, later(instant, -lags[k]));
        strong[k] = strength(sun[k]);
    }
    const FacetSet& surfaces = prepared.world.surfaces();
    const MaterialLibrary& materials = prepared.scene.materials;
    const Forcing weather = prepared.weather.at(instant);
    PastSun& past = found.past;
    past.of_facet.assign(prepared.world.facets.size(), PastSun::at_once);
    found.weight.assign(materials.size(), {1.0f});
    std::vector<std::uint8_t> course(materials.size(), PastSun::at_once);
    for (const SurfaceId f : shaded) {
        const std::size_t m = index(surfaces.material[index(f)]);
        if (found.weight[m].size() > 1) continue;
        const ThermalSurface& surface = materials[surfaces.material[index(f)]].thermal;
        const auto weight = weights_of(surface, film_of(surface, weather), strong);
        found.weight[m].assign(weight.begin(), weight.end());
        if (weight[0] == 1.0 || past.course.size() == PastSun::at_once) continue;
        course[m] = static_cast<std::uint8_t>(past.course.size());
        past.course.push_back(course_of(weight, prepared, instant));
    }
    if (past.course.empty()) return found;
    past.share.assign(fraction.begin(), fraction.end());
    for (std::size_t k = 1; k < lags.size(); ++k) {
        std::vector<float>& earlier = found.earlier.emplace_back(fraction.begin(), fraction.end());
        std::vector<float> at =
            sun_on_surfaces(prepared, sun[k], prepared.scene.sun_samples, shaded);
        if (at.empty()) at.assign(fraction.size(), 0.0f);
        for (const SurfaceId f : shaded) earlier[index(f)] = at[index(f)];
    }
    for (const SurfaceId facet : shaded) {
        const auto f = index(facet);
        past.of_facet[index(prepared.world.texture_levels.facet_of(facet))] =
            course[index(surfaces.material[f])];
        const std::vector<float>& weight = found.weight[index(surfaces.material[f])];
        past.share[f] *= weight[0];
        for (std::size_t k = 1; k < weight.size(); ++k) {
            past.share[f] += weight[k] * found.earlier[k - 1][f];
        }
    }
    return found;
}

}  // namespace diurna
