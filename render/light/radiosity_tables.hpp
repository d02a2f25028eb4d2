#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "render/light/band_light.hpp"
#include "render/light/lanes.hpp"

namespace diurna {

/// Temperatures of a table, in equal cells [K].
struct TemperatureGrid {
    double low = 200.0;
    double step = 2.0;
    std::size_t cells = 50;

    /// Cell of a temperature (the nearest one if outside) and its position in it, 0 to 1.
    std::size_t cell(float temperature, float& place) const {
        const float u = (temperature - static_cast<float>(low)) * static_cast<float>(1.0 / step);
        const float c = u < 0.0f ? 0.0f : u < float(cells) ? u : float(cells) - 0.5f;
        place = u - static_cast<float>(static_cast<std::size_t>(c));
        return static_cast<std::size_t>(c);
    }
};
/// Cells of at most 2 K that hold [low, high].
TemperatureGrid temperature_grid(double low, double high);

/// Emission and reflection of surfaces, in the modes (spectral_basis.hpp) of all bands side by
/// side, so that one loop over the neighbours of a facet serves every band. A band's modes fill
/// whole groups of four lanes, all bands together whole groups of eight; unused lanes are zero.
struct RadiosityTables {
    struct OfMaterial {
        // (cell, power, lane) cubics in temperature: ε B with transmission, and ρ B
        std::vector<float> emitted, reflected;
        // (lane) at the three heights: ρ × irradiance of the sun
        std::array<std::vector<float>, 3> sun;
        // (band)(mode of the sky, lane) ρ × its spectrum
        std::vector<std::vector<float>> sky;
        // (band)(mode in, lane out) multiplication by ρ
        std::vector<std::vector<float>> reflection;
    };
    TemperatureGrid grid;
    std::size_t lanes = 0;
    std::vector<std::size_t> first;  // (band + 1) its lanes are [first[b], first[b + 1])
    std::vector<std::size_t> size;   // (band) modes
    std::vector<float> black;        // (cell, power, lane) B
    std::vector<OfMaterial> material;
};
RadiosityTables radiosity_tables(std::span<const BandLight> bands, const TemperatureGrid& grid);

/// A cubic of such a table at a position in its cell, eight lanes at a time: its coefficients are
/// `lanes` apart.
inline Lane cubic(const float* a, std::size_t lanes, float t) {
    return load(a) + t * (load(a + lanes) + t * (load(a + 2 * lanes) + t * load(a + 3 * lanes)));
}

/// Black body at a temperature, (lane).
void black_modes(const RadiosityTables& tables, float temperature, float* out);

}  // namespace diurna
