#include "thermal/solve/solve_state.hpp"

#include <algorithm>
#include <cmath>

#include "terrain/visibility/two_sides.hpp"
#include "thermal/weather/light_by_height.hpp"

namespace diurna {

SolveState::SolveState(const SolveInput& given, const SolveOptions& how,
                       const SkySeries& sky_series)
    : input(given),
      options(how),
      series(sky_series),
      instant(step_instants(how)),
      step(how.duration / double(instant.size() - 1)),
      facets(given.facets.size()),
      counted(facets - given.beside),
      tiers(air_tiers(
          given.by_height, given.height,
          given.weather.by_height ? given.weather.by_height->edges() : std::vector<double>{})),
      optics(facet_optics(given.facets, given.materials)),
      other_side(other_sides(given.facets)) {
    for (const NetworkObject& object : given.network) {
        in_network.resize(facets);
        for (const std::uint32_t f : object.facet) in_network[f] = true;
    }
}

StageForcing between(const StageForcing& low, const StageForcing& high, double up) {
    return {air_between(low.air, high.air, up), std::lerp(low.sky_longwave, high.sky_longwave, up)};
}

double absorptance_at(const SolveState& solve, const Kind& kind, std::size_t i) {
    const double measured = measured_albedo(solve.sky[i], kind.measured_share);
    return std::isnan(measured)
               ? kind.column.absorptance()
               : std::max(0.0, 1.0 - measured - kind.column.surface.solar_transmittance);
}

BlockFace front_of(const SolveState& solve, const Block& block, const Kind& kind, std::size_t i) {
    const ThermalSurface& surface = kind.column.surface;
    return {block.facet, absorptance_at(solve, kind, i), surface.emissivity, surface.internal_heat};
}

BlockFace back_of(const SolveState& solve, const Block& block) {
    const MaterialId material = solve.input.facets.material[block.behind.front()];
    const ThermalSurface& surface = solve.input.materials[material].thermal;
    return {block.behind, std::max(0.0, 1.0 - surface.albedo - surface.solar_transmittance),
            surface.emissivity, 0.0, surface.evaporation.wetness > 0.0};
}

void facet_heat(const SolveState& solve, const Block& block, const BlockFace& face, std::size_t i,
                double* heat) {
    const bool flat = solve.tiers.flat();
    const SkyState* const sky =
        flat ? &solve.sky[i] : &solve.tier_sky[i * solve.tiers.size() + block.tier];
    const double tilted = face.emissivity * sky->tilted_longwave;
    const double more = flat ? 0.0 : face.emissivity * sky[1].tilted_longwave - tilted;
    for (std::size_t l = 0; l < face.facet.size(); ++l) {
        const std::size_t at = i * solve.facets + face.facet[l];
        heat[l] = face.absorptance * solve.sunlight[at] + face.internal;
        if (!solve.excess.empty()) heat[l] += face.emissivity * solve.excess[at];
        if (!solve.tilt.empty()) {
            heat[l] += (flat ? tilted : tilted + block.up[l] * more) * solve.tilt[face.facet[l]];
        }
    }
    std::fill(heat + face.facet.size(), heat + block.stride, heat[0]);
}

void put_kelvin(SolveState& solve, const Block& block, std::size_t i, const double* temperature,
                const double* behind) {
    float* const row = solve.kelvin.data() + i * solve.facets;
    for (std::size_t l = 0; l < block.facet.size(); ++l) {
        row[block.facet[l]] = float(temperature[l]);
    }
    if (!behind) behind = temperature;
    for (std::size_t l = 0; l < block.behind.size(); ++l) {
        const std::size_t back = block.behind[l];
        if (solve.other_side[back] == block.facet[l]) row[back] = float(behind[l]);
    }
}

std::span<const HeatJump> edges_of(const Level& level, const Block::Jumps& jumps, std::size_t i) {
    if (level.stride != 1 || jumps.of.empty()) return {};
    return std::span(jumps.jump).subspan(jumps.of[i - 1], jumps.of[i] - jumps.of[i - 1]);
}

void warm(SolveState& solve, const Level& level, const Block& block, const Eigen::MatrixXd& warmer,
          const Eigen::MatrixXd* behind) {
    if (!behind) behind = &warmer;
    for (Eigen::Index k = 0; k < warmer.rows(); ++k) {
        float* const row = solve.kelvin.data() + std::size_t(k) * level.stride * solve.facets;
        for (std::size_t l = 0; l < block.facet.size(); ++l) {
            row[block.facet[l]] += float(warmer(k, Eigen::Index(l)));
        }
        for (std::size_t l = 0; l < block.behind.size(); ++l) {
            const std::size_t back = block.behind[l];
            if (solve.other_side[back] != block.facet[l]) continue;
            row[back] += float((*behind)(k, Eigen::Index(l)));
        }
    }
}

}  // namespace diurna
