#pragma once

#include <array>
#include <span>
#include <vector>

#include "materials/atmosphere/medium.hpp"
#include "materials/atmosphere/sun_field.hpp"
#include "materials/base/monotone_cubic.hpp"

/// What SunField keeps: shared by sun_field.cpp (made and asked), sun_field_levels.cpp (filled) and
/// sun_field_path.cpp (along lines); no part of the public interface.
namespace diurna {

/// The aerosol with the forward peak of its scattering counted as not scattered at all.
struct ScaledAerosol {
    std::vector<double> extinction;  // (bin) [km⁻¹] of aerosol
    std::vector<double> scattering;  // (bin) [km⁻¹] of aerosol
    std::vector<double> asymmetry;   // (bin)
    Scatterers whole;

    double peak(std::size_t bin) const { return whole.aerosol_extinction[bin] - extinction[bin]; }
};
ScaledAerosol scaled_aerosol(const Medium& medium, double height_km);

/// Drops of clouds: mean cosine of their scattering, and the share of it in the peak.
inline constexpr double cloud_asymmetry = 0.85;
inline constexpr double cloud_peak = cloud_asymmetry * cloud_asymmetry;

/// Values at levels, (level)(column), and the smooth monotone curve through each column.
struct LevelCurves {
    std::vector<std::vector<double>> value, slope;

    void assign(std::size_t levels, std::size_t columns) {
        value.assign(levels, std::vector<double>(columns, 0.0));
    }
    void find_slopes(std::span<const double> level_km);
    double at(const HermiteWeights& w, std::size_t column) const {
        return w.value_low * value[w.low][column] + w.slope_low * slope[w.low][column] +
               w.value_high * value[w.low + 1][column] + w.slope_high * slope[w.low + 1][column];
    }
};

/// Diffuse fluxes of sunlight [W m⁻² µm⁻¹] at each level, (bin).
struct DiffuseField {
    LevelCurves up, down;
};

struct SunField::State {
    BandModel model;
    SunLight sun;
    BinRange bins;
    std::vector<std::size_t> node_bin;  // counted from the first of the range
    std::vector<double> node_share;     // irradiance there over its bin's: not 1 below 0.351 µm
    std::vector<double> above_air;  // (bin) irradiance [W m⁻² µm⁻¹] at the sun's distance
    std::vector<double> level;      // [km], ascending
    std::vector<bool> lit;          // (level)
    /// Amounts on the way to the sun: logarithms of gases, then of the linear terms; optical
    /// depths (bin) of scaled aerosol, and what scaling took from it. Levels the sun does not reach
    /// have those of the lowest it does.
    LevelCurves ln_amount, aerosol, peak;
    DiffuseField clear, cloudy;
    double beam_through_cloud = 1.0;
    double cosine = 0.0;

    /// Works out all that depends on height.
    void fill_levels(const Medium& medium);
    HermiteWeights at_height(double height_km) const { return hermite_weights(level, height_km); }
    bool sun_reaches(const HermiteWeights& w) const {
        return lit[w.low + 1] && (lit[w.low] || w.t >= 0.5);
    }
    /// What the beam has met on its way to a height.
    Amounts amounts_to_sun(const Medium& medium, const HermiteWeights& w) const;

    /// Cosines of the angles by which a line turns the sun's light, (azimuth).
    std::vector<double> turns(double zenith_deg, std::span<const double> azimuth_deg) const;

    /// Radiance scattered into a line, per bin: level[turn] + cos(zenith) · by_cosine.
    struct Scattered {
        std::vector<std::vector<double>> level;
        std::vector<double> by_cosine;

        std::vector<double> towards(std::size_t turn, double cosine) const {
            std::vector<double> sum = level[turn];
            for (std::size_t b = 0; b < sum.size(); ++b) sum[b] += cosine * by_cosine[b];
            return sum;
        }
    };
    Scattered along(const SightLine& line, std::span<const double> turn, bool under_cloud,
                    bool something_behind) const;
    /// Mean of the parts of the sky without and with cloud above the line.
    Scattered mixed(const SightLine& line, std::span<const double> turn) const;

    std::vector<double> per_node(const std::vector<double>& per_bin) const {
        std::vector<double> values(node_bin.size());
        for (std::size_t n = 0; n < values.size(); ++n) {
            values[n] = node_share[n] * per_bin[node_bin[n]];
        }
        return values;
    }

 private:
    void follow_beam(const Medium& medium, std::vector<std::vector<double>>& beam);
    void spread_light(const Medium& medium, const std::vector<std::vector<double>>& beam);
};

}  // namespace diurna
