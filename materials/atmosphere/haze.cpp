#include "materials/atmosphere/haze.hpp"

#include <algorithm>
#include <cmath>

#include "materials/base/units.hpp"

namespace diurna {

namespace {

using HazeTables = BandModelTables;

constexpr double squeezed_below_km = 6.0;  // LOWTRAN7: above, ground height does not matter

/// Between levels exponentially, or linearly where one end is zero.
double between(double low, double high, double t) {
    if (low > 0.0 && high > 0.0) return low * std::exp(t * std::log(high / low));
    return low + t * (high - low);
}

}  // namespace

double ln_dryness(const AirSample& air) {
    const double a = zero_celsius / air.temperature;
    const double saturated = a * std::exp(18.9766 - 14.9595 * a - 2.43882 * a * a);
    const double vapour = air.vapour_pressure_hPa() * 1e5 / (461.5 * air.temperature);
    const double percent = 100.0 * vapour / saturated;
    return std::log(100.0 - std::clamp(percent, 0.0, 99.0));
}

AerosolPlace place_of(const HazeTables::Aerosol& aerosol, double dryness) {
    const auto& levels = aerosol.levels;
    std::size_t upper = 0;
    while (upper < levels.size() && levels[upper].ln_dryness > dryness) ++upper;
    const std::size_t high = std::min(upper, levels.size() - 1), low = upper > 0 ? upper - 1 : 0;
    if (low == high) return {low, high, 0.0};
    const double from = levels[low].ln_dryness;
    return {low, high, (dryness - from) / (levels[high].ln_dryness - from)};
}

Haze::Haze(const BandModel& model) : model_(model) {
    if (model.rain_mm_h > 0.0) rain_ = 0.365 * std::pow(model.rain_mm_h, 0.63);
    if (model.aerosol == "none") return;
    const HazeTables& tables = band_model_tables();
    boundary_ = &tables.aerosols.at(model.aerosol);
    tropospheric_ = &tables.aerosols.at("tropospheric");
    const std::vector<HazeTables::Haze>& season = tables.haze[model.profile.winter ? 1 : 0];
    // Between tabulated visibilities linear in 1 / visibility, as the ground's extinction is.
    std::size_t high = 1;
    while (high + 1 < season.size() && season[high].visibility_km < model.visibility_km) ++high;
    const HazeTables::Haze &a = season[high - 1], &b = season[high];
    const double t = (1.0 / model.visibility_km - 1.0 / a.visibility_km) /
                     (1.0 / b.visibility_km - 1.0 / a.visibility_km);
    // (T38) of docs/theory.md
    const double ground = std::max(0.0, std::log(50.0) / model.visibility_km - 0.01159);
    height_km_ = a.height_km;
    for (std::size_t zone = 0; zone < zones; ++zone) {
        zone_[zone] = a.extinction[zone];
        for (std::size_t i = 0; i < zone_[zone].size(); ++i) {
            // Beyond the tabulated visibilities the ground's extinction alone goes on.
            const double inside = std::clamp(t, 0.0, 1.0);
            zone_[zone][i] += inside * (b.extinction[zone][i] - a.extinction[zone][i]);
        }
    }
    const double scale = ground / zone_[0].front();
    // Thick haze fills the lowest kilometre evenly; thin haze thins at all its heights.
    const std::size_t filled = model.visibility_km > 10.0 ? 3 : 2;
    for (std::size_t i = 0; i < filled; ++i) zone_[0][i] *= scale;
}

std::array<double, Haze::zones> Haze::extinction(double height_km) const {
    std::array<double, zones> extinction{};
    if (boundary_ == nullptr) return extinction;
    double z = height_km;
    if (z < squeezed_below_km) {
        z = squeezed_below_km * (z - model_.ground_km) / (squeezed_below_km - model_.ground_km);
    }
    if (z >= height_km_.back()) return extinction;
    if (z <= 0.0) {
        for (std::size_t zone = 0; zone < zones; ++zone) extinction[zone] = zone_[zone].front();
        return extinction;
    }
    const auto above = std::upper_bound(height_km_.begin(), height_km_.end(), z);
    const auto i = static_cast<std::size_t>(above - height_km_.begin());
    const double t = (z - height_km_[i - 1]) / (height_km_[i] - height_km_[i - 1]);
    for (std::size_t zone = 0; zone < zones; ++zone) {
        extinction[zone] = between(zone_[zone][i - 1], zone_[zone][i], t);
    }
    return extinction;
}

double Haze::rain(double height_km) const {
    return height_km < model_.ground_km + model_.rain_top_km ? rain_ : 0.0;
}

}  // namespace diurna
