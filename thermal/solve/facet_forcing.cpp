#include "thermal/solve/facet_forcing.hpp"

#include <algorithm>
#include <cmath>

#include "materials/base/units.hpp"
#include "thermal/surface/standing_water.hpp"

namespace diurna {

double rain_on(const SolveState& solve, std::size_t facet) {
    const MaterialId material = solve.input.facets.material[facet];
    if (solve.input.materials[material].thermal.flight) return 0.0;
    const std::vector<float>& open = solve.input.open_above;
    return rain_share(solve.input.facets.normal[facet].z(),
                      open.empty() ? 1.0 : double(open[facet]));
}

FacetForcing::FacetForcing(const SolveState& solve, std::vector<Forcing> weather,
                           const Block& block, std::size_t lane)
    : solve_(solve), weather_(std::move(weather)) {
    const std::size_t facet = block.facet[lane];
    measured_share_ = measured_share(solve.input, solve.input.facets.material[facet]);
    rain_share_ = rain_on(solve, facet);
    for (std::size_t i = 0; i < solve.instant.size(); ++i) {
        double longwave = solve.at_facet(&SkyState::longwave_down, i, facet);
        if (!solve.excess.empty()) longwave += double(solve.excess.at(i, facet));
        if (!solve.tilt.empty())
            longwave += solve.tilt[facet] * solve.at_facet(&SkyState::tilted_longwave, i, facet);
        sunlight_.push_back(solve.sunlight.at(i, facet));
        if (!solve.tiers.flat() && !weather_.empty()) {
            weather_[i].air = air_at_height(*solve.input.by_height, weather_[i].air,
                                            double(solve.input.height[facet]));
        }
        longwave_.push_back(longwave);
    }
    const ThermalSurface& surface =
        solve.input.materials[solve.input.facets.material[facet]].thermal;
    other_side_ = !block.behind.empty();
    if (surface.back && !other_side_) {
        // Of a closed mesh: surroundings as warm as the air.
        for (const Instant when : solve.instant) {
            AirState air = solve.series.weather().at(when).air;
            if (!solve.tiers.flat()) {
                air = air_at_height(*solve.input.by_height, air, double(solve.input.height[facet]));
            }
            behind_.push_back(surface.back->emissivity * stefan_boltzmann *
                              power4(air.temperature));
        }
    }
    if (other_side_) {
        const std::size_t back = block.behind[lane];
        const BlockFace face = back_of(solve, block);
        wet_behind_ = face.wet;
        for (std::size_t i = 0; i < solve.instant.size(); ++i) {
            double longwave = solve.at_facet(&SkyState::longwave_down, i, back);
            if (!solve.excess.empty()) longwave += double(solve.excess.at(i, back));
            if (!solve.tilt.empty()) {
                longwave += solve.tilt[back] * solve.at_facet(&SkyState::tilted_longwave, i, back);
            }
            behind_.push_back(face.absorptance * double(solve.sunlight.at(i, back)) +
                              face.emissivity * longwave);
        }
    }
    if (block.front.jump.empty()) return;
    for (std::size_t i = 0; i < solve.steps(); ++i) {
        first_jump_.push_back(jump_.size());
        for (std::size_t k = block.front.of[i]; k < block.front.of[i + 1]; ++k) {
            if (block.front.jump[k].lane != lane) continue;
            const Block::Jump& jump = block.front.jump[k];
            jump_.push_back({jump.lane, double(jump.share), double(jump.heat)});
            edge_.push_back(
                later(solve.instant[i], double(block.front.jump[k].share) * solve.step));
        }
    }
    first_jump_.push_back(jump_.size());
}

double FacetForcing::behind(Instant when) const {
    const double place = seconds_between(solve_.instant.front(), when) / solve_.step;
    const auto last = behind_.size() - 2;
    const auto i = std::min(static_cast<std::size_t>(std::max(0.0, place)), last);
    return std::lerp(behind_[i], behind_[i + 1], std::clamp(place - double(i), 0.0, 1.0));
}

PointForcing FacetForcing::operator()(Instant when) const {
    const double place = seconds_between(solve_.instant.front(), when) / solve_.step;
    const auto last = sunlight_.size() - 2;
    const auto i = std::min(static_cast<std::size_t>(std::max(0.0, place)), last);
    const double x = std::clamp(place - double(i), 0.0, 1.0);
    const Forcing weather = between(weather_[i], weather_[i + 1], x);
    return {.air = weather.air,
            .wind_speed = weather.wind_speed,
            .rain_mm_h = rain_share_ * weather.rain_mm_h,
            .sunlight = sunlight(i, x),
            .own_light = 0.0,
            .albedo = std::lerp(measured_albedo(solve_.sky[i], measured_share_),
                                measured_albedo(solve_.sky[i + 1], measured_share_), x),
            .longwave_in = longwave(i, x),
            .own_view = 0.0};
}

double FacetForcing::sunlight(std::size_t i, double x) const {
    double light = std::lerp(sunlight_[i], sunlight_[i + 1], x);
    // The straight line has the jump in it; a millisecond behind the edge it is done.
    const std::size_t from = jump_.empty() ? 0 : first_jump_[i];
    const std::size_t to = jump_.empty() ? 0 : first_jump_[i + 1];
    for (std::size_t k = from; k < to; ++k) {
        const double done = std::clamp((x - jump_[k].share) * solve_.step / 1e-3, 0.0, 1.0);
        light += (done - x) * jump_[k].heat;
    }
    return std::max(0.0, light);
}

}  // namespace diurna
