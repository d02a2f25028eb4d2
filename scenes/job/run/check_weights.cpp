#include "scenes/job/run/check_weights.hpp"

#include <algorithm>
#include <cmath>

#include "materials/radiation/planck.hpp"
#include "scenes/job/plan/heat_bands.hpp"
#include "scenes/job/world/air.hpp"
#include "scenes/job/world/heights.hpp"

namespace diurna {

namespace {

constexpr std::size_t most_compared = 24;
constexpr double near_temperature = 300.0;  // [K] at which Planck's slope weighs wavelengths

std::size_t nearest(std::span<const Instant> instants, Instant when) {
    const auto distance = [&](std::size_t i) { return std::abs((instants[i] - when).count()); };
    const auto after = std::lower_bound(instants.begin(), instants.end(), when);
    std::size_t i = std::min<std::size_t>(after - instants.begin(), instants.size() - 1);
    if (i > 0 && distance(i - 1) <= distance(i)) --i;
    return i;
}

/// Of one point in one band.
double apparent_slope(const Prepared& prepared, const Atmosphere& air, const Band& band,
                      const CheckPoint& point) {
    const World& world = prepared.world;
    const double from_km = 1e-3 * height_above_sea(world, point.eye.cast<double>());
    const double to_km = 1e-3 * height_above_sea(world, point.place.cast<double>());
    const double range_km = 1e-3 * double{(point.place - point.eye).norm()};
    const PathSpectrum path = path_at_nodes(air, chord(from_km, to_km, range_km), band.node_um);
    const Material& material =
        prepared.scene.materials[world.surfaces().material[index(point.surface)]];
    double shown = 0.0, all = 0.0;
    for (std::size_t i = 0; i < band.node_um.size(); ++i) {
        const double um = band.node_um[i];
        const double slope = band.weight[i] * planck_derivative(um, near_temperature);
        shown += slope * (1.0 - material.reflectance.at(um)) * path.transmittance[i];
        all += slope;
    }
    return shown / all;
}

}  // namespace

CheckWeights check_weights(const Prepared& prepared, const CheckPoints& points,
                           std::span<const Instant> instants) {
    CheckWeights weights;
    weights.observers = prepared.sequences.size();
    for (const Sequence& sequence : prepared.sequences) {
        for (const Instant when : sequence.frame) {
            weights.instant.push_back(nearest(instants, when));
        }
    }
    std::vector<std::size_t>& chosen = weights.instant;
    std::sort(chosen.begin(), chosen.end());
    chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
    if (const std::size_t all = chosen.size(); all > most_compared) {
        for (std::size_t a = 0; a < most_compared; ++a) {
            chosen[a] = chosen[a * (all - 1) / (most_compared - 1)];
        }
        chosen.resize(most_compared);
    }
    std::vector<Instant> compared;
    for (const std::size_t i : chosen) compared.push_back(instants[i]);
    weights.pictures.assign(chosen.size() * weights.observers, 0.0f);
    weights.apparent.assign(points.point.size(), 1.0f);
    for (std::size_t o = 0; o < weights.observers; ++o) {
        const std::vector<Instant>& frames = prepared.sequences[o].frame;
        for (const Instant when : frames) {
            weights.pictures[nearest(compared, when) * weights.observers + o] += 1.0f;
        }
        const std::vector<Band> bands = heat_bands(prepared.scene, prepared.scene.observers[o]);
        if (frames.empty() || bands.empty()) continue;
        const Atmosphere air = atmosphere_at(prepared.scene, prepared.world, prepared.weather,
                                             frames[frames.size() / 2]);
        for (std::size_t k = 0; k < points.point.size(); ++k) {
            if (points.point[k].observer != o) continue;
            double squares = 0.0;
            for (const Band& band : bands) {
                const double slope = apparent_slope(prepared, air, band, points.point[k]);
                squares += slope * slope / double(bands.size());
            }
            weights.apparent[k] = static_cast<float>(std::sqrt(squares));
        }
    }
    return weights;
}

}  // namespace diurna
