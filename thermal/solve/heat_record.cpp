#include "thermal/solve/heat_record.hpp"

#include "thermal/surface/surface_flux.hpp"

namespace diurna {

HeatRecord::HeatRecord(const SolveState& solve, const std::vector<std::size_t>& steps)
    : row_(solve.instant.size(), -1) {
    field_.facets = solve.facets;
    for (const std::size_t i : steps) {
        row_[i] = long(field_.instant.size());
        field_.instant.push_back(solve.instant[i]);
    }
    for (std::vector<float>& watts : field_.watts) watts.resize(steps.size() * solve.facets);
}

void HeatRecord::put(std::size_t i, std::size_t facet, const HeatBalance& balance, double melting) {
    const std::size_t at = std::size_t(row_[i]) * field_.facets + facet;
    const auto set = [&](HeatTerm term, double watts) {
        field_.watts[static_cast<std::size_t>(term)][at] = float(watts);
    };
    set(HeatTerm::absorbed_sunlight, balance.absorbed_solar);
    set(HeatTerm::absorbed_longwave, balance.longwave_in);
    set(HeatTerm::internal, balance.internal);
    set(HeatTerm::emitted_longwave, -balance.longwave_out);
    set(HeatTerm::sensible, -balance.sensible);
    set(HeatTerm::latent, -balance.latent);
    set(HeatTerm::melting, melting);
    set(HeatTerm::conducted, -balance.conducted);
}

void record_block(SolveState& solve, const Block& block, const Kind& kind, std::size_t i,
                  const BlockSurfaces& surfaces) {
    if (!solve.record || !solve.record->wants(i)) return;
    const ThermalSurface& surface = kind.column.surface;
    const double absorptance = absorptance_at(solve, kind, i);
    for (std::size_t l = 0; l < block.facet.size(); ++l) {
        const std::size_t facet = block.facet[l];
        const double sun = absorptance * double(solve.sunlight.at(i, facet));
        HeatBalance balance = heat_balance(
            surfaces.air.at(l), natural_film_of(solve, facet), surface.emissivity,
            {.absorbed_solar = sun, .internal = surface.internal_heat}, surfaces.temperature[l]);
        balance.longwave_in = surfaces.heat[l] - sun - surface.internal_heat;
        balance.conducted = surfaces.taken.empty() ? -balance.sum() : -surfaces.taken[l];
        solve.record->put(i, facet, balance);
    }
}

namespace {

void record_back(const SolveState& solve, const Block& block, std::size_t l, std::size_t i,
                 AirFilm air, double absorbed, double kelvin) {
    const BlockFace face = back_of(solve, block);
    const std::size_t back = block.behind[l];
    if (!face.wet) air.wetness = 0.0;
    const double sun = face.absorptance * double(solve.sunlight.at(i, back));
    HeatBalance balance = heat_balance(air, turned_over(natural_film_of(solve, block.facet[l])),
                                       face.emissivity, {.absorbed_solar = sun}, kelvin);
    balance.longwave_in = absorbed - sun;
    balance.conducted = -balance.sum();
    solve.record->put(i, back, balance);
}

}  // namespace

void record_backs(SolveState& solve, const Block& block, std::size_t i,
                  const BlockSurfaces& surfaces) {
    if (!solve.record || !solve.record->wants(i)) return;
    for (std::size_t l = 0; l < block.behind.size(); ++l) {
        if (solve.other_side[block.behind[l]] != block.facet[l]) continue;
        record_back(solve, block, l, i, surfaces.air.at(l), surfaces.heat[l],
                    surfaces.temperature[l]);
    }
}

void record_point_back(const SolveState& solve, const Kind& kind, const Block& block,
                       std::size_t lane, std::size_t i, double absorbed, double kelvin) {
    if (!solve.record || !solve.record->wants(i) || block.behind.empty()) return;
    if (solve.other_side[block.behind[lane]] != block.facet[lane]) return;
    const Forcing now = solve.series.weather().at(solve.instant[i]);
    const AirState air = solve.tiers.flat()
                             ? now.air
                             : air_at_height(*solve.input.by_height, now.air,
                                             double(solve.input.height[block.facet[lane]]));
    record_back(solve, block, lane, i,
                air_film(kind.column.surface, kind.column.louis, air, now.wind_speed), absorbed,
                kelvin);
}

}  // namespace diurna
