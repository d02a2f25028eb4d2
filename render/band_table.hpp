#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "materials/band.hpp"
#include "materials/library.hpp"

namespace diurna {

/// Runs of a band's nodes that lie in one bin of the atmosphere, inside which its transmittance is
/// one number. What leaves a surface needs to be known per channel only; rows of channels are
/// padded with zeros to whole SIMD registers.
struct Channels {
    std::vector<std::uint32_t> first;  // (channel + 1) nodes of channel c: [first[c], first[c + 1])

    std::size_t size() const { return first.size() - 1; }
    std::size_t padded() const { return (size() + 7) / 8 * 8; }
};
Channels channels_of(const Band& band);

/// Σ weight · f · g per channel, padded.
std::vector<float> channel_sums(const Band& band, const Channels& channels,
                                std::span<const double> f, std::span<const double> g);

/// Temperatures a table is made for, in equal cells [K].
struct TemperatureGrid {
    double low = 200.0;
    double step = 2.0;
    std::size_t cells = 50;

    /// Cell of a temperature (the nearest one if it lies outside) and its place in it, 0 to 1.
    std::size_t cell(float temperature, float& place) const {
        const float u = (temperature - static_cast<float>(low)) * static_cast<float>(1.0 / step);
        const float c = u < 0.0f ? 0.0f : u < float(cells) ? u : float(cells) - 0.5f;
        place = u - static_cast<float>(static_cast<std::size_t>(c));
        return static_cast<std::size_t>(c);
    }
};
/// Cells of at most 2 K that hold [low, high].
TemperatureGrid temperature_grid(double low, double high);

/// What surfaces emit and reflect in a band's channels, over temperature.
///
/// Radiances are cubic Hermite in temperature with exact derivatives: relative error below 1e-6
/// above 200 K, 0.03 mK (tests/band_table_test.cpp). The reflectance of a channel, for the
/// light of surroundings, is its mean weighted by Planck's law at the facet's own temperature, so
/// that ε B + ρ B = B holds exactly in every channel, plus, by day, by the sunlight that
/// surroundings scatter; linear between temperatures.
class SurfaceTable {
 public:
    /// For the materials with `used[id]` set.
    ///
    /// scattered  (node) radiance of sunlit surroundings [W m⁻² sr⁻¹ µm⁻¹]; empty at night
    SurfaceTable(const Band& band, const Channels& channels, const MaterialLibrary& materials,
                 const std::vector<bool>& used, const TemperatureGrid& grid,
                 std::span<const double> scattered = {});

    const TemperatureGrid& grid() const { return grid_; }
    std::size_t padded() const { return padded_; }

    /// Black body: out[c] = Σ weight B(T) [W m⁻² sr⁻¹].
    void black(float temperature, float* out) const;
    /// Emission ε B of a material and its reflectance.
    void surface(MaterialId material, float temperature, float* emitted, float* reflectance) const;
    /// Radiance of a room behind the material that shines through it, or null if there is none or
    /// what is behind is as warm as the facet (then: B − εB − ρB).
    const float* room(MaterialId material) const;
    bool transparent(MaterialId material) const;
    /// The cubics behind black() and surface(), (cell, power, channel).
    std::span<const float> black_cubics() const { return black_; }
    std::span<const float> emitted_cubics(MaterialId material) const {
        return optics_[static_cast<std::size_t>(material)].emitted;
    }

 private:
    struct Optics {
        std::vector<float> emitted;      // (cell, power 0 to 3, channel)
        std::vector<float> reflectance;  // (cell, power 0 to 1, channel)
        std::vector<float> room;         // (channel)
        bool transparent = false;
    };
    TemperatureGrid grid_;
    std::size_t padded_ = 0;
    std::vector<float> black_;  // (cell, power, channel)
    std::vector<Optics> optics_;
};

/// The inverse of a band's radiance over a range of radiances: T by cubic Hermite with exact
/// derivatives over cells of equal ratio, found from the number's own bits. Within 0.05 mK of
/// brightness_temperature() where that is 150 K or more (tests/band_table_test.cpp).
class TemperatureScale {
 public:
    /// For radiances [low, high]; others are inverted one by one.
    TemperatureScale(const Band& band, float low, float high);
    /// [K]; 0 for a radiance of zero or less.
    double operator()(double radiance) const;

 private:
    Band band_;
    int shift_ = 0;            // a cell: radiances alike but for so many last bits
    std::uint32_t first_ = 0;  // leading bits of the first cell
    std::vector<std::array<double, 4>> cubic_;
};

}  // namespace diurna
