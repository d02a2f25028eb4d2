#pragma once

#include <array>
#include <span>
#include <vector>

#include "materials/air/sight_line.hpp"
#include "materials/atmosphere/band_model.hpp"
#include "materials/atmosphere/band_model_tables.hpp"
#include "materials/atmosphere/bins.hpp"
#include "materials/atmosphere/haze.hpp"

namespace diurna {

/// Amounts of absorbers along a line so far; they determine its optical depth. Amounts add.
struct Amounts {
    std::vector<double> gas;  // (group) W
    std::array<double, BandModelTables::linear_count> linear{};
    std::vector<double> aerosol;  // (bin) optical depth of aerosol and rain; empty: none
    /// Aerosol not yet in `aerosol`: depth at 0.55 µm times the weight of each humidity node, for
    /// the boundary layer's aerosol and the troposphere's.
    std::array<std::vector<double>, 2> haze;
    double rain = 0.0;  // depth not yet in `aerosol`

    void add(const Amounts& other);
};

/// x → e⁻ˣ.
void negative_exponentials(std::span<double> values);

/// The band model prepared for one model and a range of bins: amounts along lines through its air,
/// and their optical depth. Refers to the model, which must outlive it.
class Medium {
 public:
    Medium(const BandModel& model, BinRange bins);

    BinRange bins() const { return bins_; }
    const BandModel& model() const { return model_; }
    const Haze& haze() const { return haze_; }

    Amounts none() const;
    /// Adds a segment by the height of its middle. Its aerosol is added later by spread().
    void add(double height_km, double length_km, Amounts& amounts) const;
    /// Adds a segment of a line: by Gauss's two-point rule if its ends are known and it climbs more
    /// than 20 m, else by its middle. Its aerosol is also added by spread().
    void add(const SightLine& line, std::size_t segment, Amounts& amounts) const;
    /// Adds the pending aerosol to every bin.
    void spread(Amounts& amounts) const;
    /// Adds a segment whose extinction of aerosol and rain [km⁻¹], (bin), is given.
    void add(double height_km, double length_km, std::span<const double> aerosol,
             Amounts& amounts) const;

    /// Adds an aerosol's depth at 0.55 µm to the weights of its nodes around a dryness.
    void add_aerosol(const BandModelTables::Aerosol& aerosol, double ln_dryness, double depth,
                     std::span<double> node) const;

    /// Optical depth of every bin for the amounts met; and transmittance.
    void depths(const Amounts& amounts, std::span<double> out) const;
    /// Of two lines together.
    void depths(const Amounts& amounts, const Amounts& more, std::span<double> out) const;
    void transmittances(const Amounts& amounts, std::span<double> out) const;
    /// Transmittance of gases and continua only, without Rayleigh scattering and aerosol.
    void absorption_transmittances(const Amounts& amounts, std::span<double> out) const;

 private:
    using Tables = BandModelTables;
    static constexpr std::size_t group_lanes = 16;

    /// - more: null: none
    void find_depths(const Amounts& amounts, const Amounts* more, bool scattering,
                     std::span<double> out) const;
    void add_gases(const AirSample& air, double length_km, Amounts& amounts) const;

    const Tables& tables_;
    const BandModel& model_;
    BinRange bins_;
    Haze haze_;
    std::vector<double> no_depth_;  // (bin) zeros
    double co2_scale_ = 1.0;
    std::vector<std::size_t> active_;                         // groups that absorb in these bins
    std::vector<std::size_t> run_;                            // places of their runs there
    std::vector<double> pressure_power_, temperature_power_;  // theirs, and zeros behind
};

}  // namespace diurna
