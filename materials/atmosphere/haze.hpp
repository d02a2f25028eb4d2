#pragma once

#include <array>
#include <vector>

#include "materials/atmosphere/band_model.hpp"
#include "materials/atmosphere/band_model_tables.hpp"

namespace diurna {

/// ln(100 − relative humidity [%]), the scale of the aerosol levels; humidity by LOWTRAN's formula:
/// absolute humidity over its saturation [g m⁻³].
double ln_dryness(const AirSample& air);

/// The two levels of an aerosol around a dryness, and the position between them.
struct AerosolPlace {
    std::size_t low, high;
    double t;
};
AerosolPlace place_of(const BandModelTables::Aerosol& aerosol, double ln_dryness);

/// How much aerosol and rain a model's air holds by height. Refers to the model, which must outlive
/// it.
class Haze {
 public:
    explicit Haze(const BandModel& model);

    using Aerosol = BandModelTables::Aerosol;
    static constexpr std::size_t zones = BandModelTables::haze_zones;

    /// The boundary layer's aerosol (the chosen type), and the troposphere's; null without aerosol.
    const Aerosol* boundary() const { return boundary_; }
    const Aerosol* tropospheric() const { return tropospheric_; }
    /// Extinction at 0.55 µm [km⁻¹]: of the boundary layer's aerosol, of the troposphere's at the
    /// air's humidity, and of dry tropospheric aerosol above it.
    std::array<double, zones> extinction(double height_km) const;

    bool rains() const { return rain_ > 0.0; }
    /// Extinction of rain [km⁻¹], at all wavelengths.
    double rain(double height_km) const;

 private:
    const BandModel& model_;
    double rain_ = 0.0;  // [km⁻¹]
    const Aerosol* boundary_ = nullptr;
    const Aerosol* tropospheric_ = nullptr;
    std::vector<double> height_km_;
    std::array<std::vector<double>, zones> zone_;  // (zone)(height) at 0.55 µm [km⁻¹]
};

}  // namespace diurna
