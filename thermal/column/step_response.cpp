#include "thermal/column/step_response.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

namespace diurna {

namespace {

/// Nodes in a row: heat held [J m⁻² K⁻¹], conductance to the next [W m⁻² K⁻¹], the last one's to
/// what lies below.
struct Chain {
    std::vector<double> held, conductance;
};

Chain chain_of(const ThermalSurface& surface, double film) {
    constexpr double first_m = 5e-4, growth = 1.2, deepest_m = 1.5;
    std::vector<double> half;  // [m² K W⁻¹] of half a node
    Chain chain;
    double depth = 0.0, size = first_m;
    for (const Layer& layer : surface.layers) {
        for (double left = layer.thickness; left > 1e-9 && depth < deepest_m;) {
            const double here = left < 1.6 * size ? left : size;
            chain.held.push_back(here * layer.density * layer.heat_capacity);
            half.push_back(0.5 * here / layer.conductivity);
            left -= here;
            depth += here;
            size *= growth;
        }
    }
    for (std::size_t i = 0; i + 1 < half.size(); ++i) {
        chain.conductance.push_back(1.0 / (half[i] + half[i + 1]));
    }
    double below = 0.0;
    if (surface.back) {
        below = film;
    } else if (depth < deepest_m && std::holds_alternative<FixedTemperature>(surface.bottom)) {
        below = 1e9;
    } else if (const auto* room = std::get_if<Interior>(&surface.bottom)) {
        below = room->film;
    }
    chain.conductance.push_back(below > 0.0 ? 1.0 / (half.back() + 1.0 / below) : 0.0);
    // The surface itself holds no heat: half a node above the first, more with a skin.
    double above = half.front();
    if (const auto* leaf = std::get_if<BigLeaf>(&surface.canopy)) {
        above += 1.0 / leaf->skin_conductance;
    }
    chain.held.insert(chain.held.begin(), 0.0);
    chain.conductance.insert(chain.conductance.begin(), 1.0 / above);
    return chain;
}

/// One implicit step of `dt` under unit flux (Thomas' algorithm).
void advance(const Chain& chain, double film, double dt, std::vector<double>& kelvin) {
    const std::size_t n = kelvin.size();
    std::vector<double> upper(n), right(n);
    for (std::size_t i = 0; i < n; ++i) {
        const double to_before = i == 0 ? 0.0 : chain.conductance[i - 1];
        const double to_next = chain.conductance[i];
        const double held = chain.held[i] / dt;
        double diagonal = held + to_before + to_next + (i == 0 ? film : 0.0);
        double source = held * kelvin[i] + (i == 0 ? 1.0 : 0.0);
        if (i > 0) {
            diagonal -= to_before * upper[i - 1];
            source += to_before * right[i - 1];
        }
        upper[i] = i + 1 < n ? to_next / diagonal : 0.0;
        right[i] = source / diagonal;
    }
    for (std::size_t i = n; i-- > 0;) {
        kelvin[i] = right[i] + (i + 1 < n ? upper[i] * kelvin[i + 1] : 0.0);
    }
}

}  // namespace

std::vector<double> step_response(const ThermalSurface& surface, double film,
                                  std::span<const double> seconds) {
    if (surface.layers.empty()) return std::vector<double>(seconds.size(), 1.0 / film);
    constexpr double first_s = 1.0, longer = 0.03;
    const Chain chain = chain_of(surface, film);
    std::vector<double> kelvin(chain.held.size(), 0.0), found;
    double now = 0.0;
    for (const double until : seconds) {
        while (now < until) {
            const double step = std::min(std::max(first_s, longer * now), until - now);
            advance(chain, film, step, kelvin);
            now += step;
        }
        found.push_back(kelvin.front());
    }
    return found;
}

}  // namespace diurna
