#pragma once

#include <array>
#include <span>
#include <vector>

#include "materials/atmosphere/band_model.hpp"
#include "materials/atmosphere/band_model_tables.hpp"

/// The band model made ready for one model and a range of bins: shared by band_model.cpp and
/// scattering.cpp, no part of the public interface.
namespace diurna {

/// What a line has met so far; optical depth follows from it alone. Amounts of two lines add.
struct Amounts {
    std::vector<double> gas;  // (group) W
    std::array<double, BandModelTables::linear_count> linear{};
    std::vector<double> aerosol;  // (bin) optical depth of aerosol and rain; empty: none
    /// Aerosol not yet in `aerosol`: depth at 0.55 µm times the weight of each node of humidity, of
    /// the boundary layer's aerosol and the troposphere's.
    std::array<std::vector<double>, 2> haze;
    double rain = 0.0;  // depth not yet in `aerosol`

    void add(const Amounts& other);
};

/// How a cubic kilometre of air scatters sunlight, per bin.
struct Scatterers {
    std::vector<double> rayleigh;            // (bin) [km⁻¹]
    std::vector<double> aerosol_extinction;  // (bin) [km⁻¹], rain included
    std::vector<double> aerosol_scattering;  // (bin) [km⁻¹]
    std::vector<double> asymmetry;           // (bin) of the aerosol
    /// Scattering [km⁻¹] of the boundary layer's aerosol, the troposphere's, rain: (bin), or empty.
    std::array<std::vector<double>, 3> part;
};

/// ln(100 − relative humidity [%]), the scale aerosol levels stand on; humidity by LOWTRAN's
/// formula: absolute humidity over its saturation [g m⁻³].
double ln_dryness(const AirSample& air);

/// The two levels of an aerosol around a dryness and the place between them.
struct AerosolPlace {
    std::size_t low, high;
    double t;
};
AerosolPlace place_of(const BandModelTables::Aerosol& aerosol, double ln_dryness);

/// x → e⁻ˣ.
void negative_exponentials(std::span<double> values);

/// Refers to the model: use it while the model lives.
class Medium {
 public:
    Medium(const BandModel& model, BinRange bins);

    BinRange bins() const { return bins_; }
    Amounts none() const;
    /// Adds a segment; returns the temperature [K] of its middle. Its aerosol waits for spread().
    double add(double height_km, double length_km, Amounts& amounts) const;
    /// Adds a segment of a line: where its ends are known and it climbs more than 20 m, by Gauss's
    /// rule of two points, else by its middle.
    void add(const SightLine& line, std::size_t segment, Amounts& amounts) const;
    /// Puts the aerosol that waits into every bin.
    void spread(Amounts& amounts) const;
    /// The same with the extinction of aerosol and rain [km⁻¹], (bin), given.
    double add(double height_km, double length_km, std::span<const double> aerosol,
               Amounts& amounts) const;
    /// Optical depth of every bin for the amounts met; and transmittance.
    void depths(const Amounts& amounts, std::span<double> out) const;
    void transmittances(const Amounts& amounts, std::span<double> out) const;
    /// Transmittance of gases and continua alone: neither Rayleigh nor aerosol.
    void absorption_transmittances(const Amounts& amounts, std::span<double> out) const;
    Scatterers scatterers(double height_km) const;
    /// Phase function of each part of the scatterers at an angle, (bin).
    std::array<std::vector<double>, 3> phase(double cosine) const;

 private:
    using Tables = BandModelTables;
    static constexpr std::size_t zones = 3;
    static constexpr std::size_t group_lanes = 16;

    /// Extinction at 0.55 µm [km⁻¹] of each zone's aerosol.
    std::array<double, zones> haze(double height_km) const;
    double rain(double height_km) const;
    void find_depths(const Amounts& amounts, bool scattering, std::span<double> out) const;
    double add_gases(double height_km, double length_km, Amounts& amounts, AirSample& air) const;
    /// Adds depth at 0.55 µm to the nodes around a dryness.
    void add_aerosol(const Tables::Aerosol& aerosol, double ln_dryness, double depth,
                     std::span<double> node) const;

    const Tables& tables_;
    const BandModel& model_;
    BinRange bins_;
    std::vector<double> no_depth_;  // (bin) zeros
    double co2_scale_ = 1.0;
    double rain_extinction_ = 0.0;                            // [km⁻¹]
    std::vector<std::size_t> active_;                         // groups that absorb in these bins
    std::vector<double> pressure_power_, temperature_power_;  // theirs, and zeros behind
    const Tables::Aerosol* boundary_ = nullptr;
    const Tables::Aerosol* tropospheric_ = nullptr;
    std::vector<double> haze_height_km_;
    std::array<std::vector<double>, zones> haze_;  // (zone)(height) at 0.55 µm [km⁻¹]
};

}  // namespace diurna
