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

NaturalFilm natural_film_of(const SolveState& solve, std::size_t facet) {
    const MaterialId material = solve.input.facets.material[facet];
    return facet_film(solve.input.materials[material].thermal.convection,
                      double(solve.input.facets.normal[facet].z()), solve.part_of(facet));
}

std::vector<NaturalFilm> natural_films(const SolveState& solve, const Block& block) {
    std::vector<NaturalFilm> films;
    films.reserve(block.facet.size());
    for (const std::size_t f : block.facet) films.push_back(natural_film_of(solve, f));
    return films;
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

FaceHeat::FaceHeat(const SolveState& solve, const Block& block, std::span<const std::size_t> facets)
    : solve_(solve), block_(block), sunlight_(solve.sunlight, facets, block.stride) {
    if (!solve.excess.empty()) excess_.emplace(solve.excess, facets, block.stride);
}

void FaceHeat::at(const BlockFace& face, std::size_t i, double* heat) {
    const std::size_t count = face.facet.size();
    const float* const sunlight = sunlight_.at(i);
    const float* const excess = excess_ ? excess_->at(i) : nullptr;
    for (std::size_t l = 0; l < count; ++l) {
        const double sun = sunlight ? double(sunlight[l]) : 0.0;
        heat[l] = face.absorptance * sun + face.internal;
        if (excess) heat[l] += face.emissivity * double(excess[l]);
    }
    if (!solve_.tilt.empty()) {
        const bool flat = solve_.tiers.flat();
        const SkyState* const sky =
            flat ? &solve_.sky[i] : &solve_.tier_sky[i * solve_.tiers.size() + block_.tier];
        const double tilted = face.emissivity * sky->tilted_longwave;
        const double more = flat ? 0.0 : face.emissivity * sky[1].tilted_longwave - tilted;
        for (std::size_t l = 0; l < count; ++l) {
            heat[l] += (flat ? tilted : tilted + block_.up[l] * more) * solve_.tilt[face.facet[l]];
        }
    }
    std::fill(heat + count, heat + block_.stride, heat[0]);
}

KelvinRecord::KelvinRecord(SolveState& solve, const Block& block)
    : front_(solve.kelvin, block.facet) {
    for (std::size_t l = 0; l < block.behind.size(); ++l) {
        if (solve.other_side[block.behind[l]] != block.facet[l]) continue;
        back_.push_back(block.behind[l]);
        lane_.push_back(l);
    }
    if (!back_.empty()) behind_.emplace(solve.kelvin, back_);
}

void KelvinRecord::put(const double* temperature, const double* behind) {
    front_.add(temperature);
    if (!behind_) return;
    if (!behind) behind = temperature;
    double values[mode_lanes];
    for (std::size_t k = 0; k < lane_.size(); ++k) values[k] = behind[lane_[k]];
    behind_->add(values);
}

std::span<const Block::Jump> edges_of(const Level& level, const Block::Jumps& jumps,
                                      std::size_t i) {
    if (level.stride != 1 || jumps.of.empty()) return {};
    return std::span(jumps.jump).subspan(jumps.of[i - 1], jumps.of[i] - jumps.of[i - 1]);
}

namespace {

/// Adds a column of `warmer` to a facet's temperatures.
void warm_facet(PackedField& kelvin, std::size_t f, const Eigen::MatrixXd& warmer,
                Eigen::Index lane, std::vector<float>& values) {
    values.resize(kelvin.slots());
    kelvin.get(f, values.data());
    for (Eigen::Index k = 0; k < warmer.rows(); ++k) {
        values[std::size_t(k)] += float(warmer(k, lane));
    }
    kelvin.put(f, values.data());
}

}  // namespace

void warm(SolveState& solve, const Block& block, const Eigen::MatrixXd& warmer,
          const Eigen::MatrixXd* behind) {
    if (warmer.rows() == 0) return;
    if (!behind) behind = &warmer;
    std::vector<float> values;
    for (std::size_t l = 0; l < block.facet.size(); ++l) {
        warm_facet(solve.kelvin, block.facet[l], warmer, Eigen::Index(l), values);
    }
    for (std::size_t l = 0; l < block.behind.size(); ++l) {
        const std::size_t back = block.behind[l];
        if (solve.other_side[back] != block.facet[l]) continue;
        warm_facet(solve.kelvin, back, *behind, Eigen::Index(l), values);
    }
}

}  // namespace diurna
