#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "render/band_table.hpp"

namespace diurna {

/// A few orthonormal spectra (modes) that all a scene sends out is a sum of. Sums over a band's
/// channels become sums over modes: 8 to 24 numbers a facet in place of up to 150.
///
/// Chosen from sample spectra ("generators": emission of each material over the scene's
/// temperatures, sunlight and sky light it reflects, reflections of reflections) by Gram-Schmidt
/// with pivoting: the one worst represented becomes the next mode, until all are represented to
/// `tolerance`. A black body at the middle temperature is the first mode, so that an isothermal
/// scene stays exactly isothermal. Where that takes most of the channels, the channels themselves.
class ModeBasis {
 public:
    /// generators  (generator)(channel) [W m⁻² sr⁻¹]; the first becomes the first mode
    /// tolerance   [W m⁻² sr⁻¹] bound on the norm of what is left of any generator
    ModeBasis(std::span<const std::vector<float>> generators, std::size_t channels,
              double tolerance);

    std::size_t size() const { return mode_.size(); }
    std::size_t padded() const { return (size() + 7) / 8 * 8; }
    double error() const { return error_; }  // [W m⁻² sr⁻¹] norm of the worst rest

    /// Coefficients of a spectrum given per channel, padded with zeros; of its projection, if it
    /// is not a sum of modes. Also turns transmittances per channel into what multiplies
    /// coefficients: Σ_c τ_c L_c = Σ_k project(τ)_k project(L)_k.
    void project(const float* per_channel, float* out) const;
    /// Multiplication by a factor per channel, for add_product().
    std::vector<float> product(std::span<const float> factor) const;

 private:
    std::size_t channels_;
    std::vector<std::vector<double>> mode_;  // (mode)(channel)
    bool plain_ = false;                     // the modes are the channels
    double error_ = 0.0;
};

/// out += product · in, for a ModeBasis::product: a matrix (mode in, mode out) with padded rows, or
/// its diagonal where the modes are the channels.
void add_product(const std::vector<float>& product, const float* in, std::size_t padded,
                 float* out);

/// A SurfaceTable in modes.
class ModeTable {
 public:
    ModeTable(const SurfaceTable& table, const ModeBasis& basis, std::size_t materials,
              const std::vector<bool>& used, float temperature);

    std::size_t padded() const { return padded_; }
    void black(float temperature, float* out) const;
    void emitted(MaterialId material, float temperature, float* out) const;
    /// The cubics (power, mode) of ε B, of ρ B and of B in the cell of a temperature.
    struct Cell {
        const float *emitted, *reflected, *black;
        float t;
    };
    Cell cell(MaterialId material, float temperature) const;
    /// Multiplication by the material's reflectance (for light of surroundings).
    const std::vector<float>& reflection(MaterialId material) const {
        return optics_[static_cast<std::size_t>(material)].reflection;
    }
    /// As SurfaceTable::room().
    const float* room(MaterialId material) const;
    bool transparent(MaterialId material) const {
        return optics_[static_cast<std::size_t>(material)].transparent;
    }

 private:
    struct Optics {
        std::vector<float> emitted, reflected;  // (cell, power, mode)
        std::vector<float> reflection, room;
        bool transparent = false;
    };
    TemperatureGrid grid_;
    std::size_t padded_;
    std::vector<float> black_;
    std::vector<Optics> optics_;
};

}  // namespace diurna
