#include "materials/air/air_by_height.hpp"

#include <algorithm>
#include <cmath>

#include "materials/base/units.hpp"

namespace diurna {

namespace {

constexpr auto water = static_cast<std::size_t>(Gas::water);
constexpr double level_step = 50.0;      // [m] between levels of a profile made of this air
constexpr double pressure_step = 100.0;  // [m] of the barometric sum: 1e-8 of the pressure

double ratio_at(const Profile& profile, double height) {
    return std::max(air_at(profile, height * 1e-3).mixing_ratio_ppm[water], 1e-9);
}

/// Temperature and vapour, the latter without regard to saturation, over one station.
class Course {
 public:
    Course(const AirByHeight& rule, const AirState& station) : rule_(rule), station_(station) {
        if (!rule.profile) return;
        const AirSample there = air_at(*rule.profile, rule.station * 1e-3);
        warmer_ = station.temperature - there.temperature;
        const double ratio = 1e6 * std::max(station.vapour_pressure, 1e-7) / station.pressure;
        ln_water_ = std::log(ratio / std::max(there.mixing_ratio_ppm[water], 1e-9));
    }

    double temperature(double height) const {
        if (!rule_.profile) {
            return station_.temperature + rule_.lapse * (height - rule_.station);
        }
        return pressure_and_temperature_at(*rule_.profile, height * 1e-3).second +
               share(height) * warmer_;
    }
    double vapour(double height, double pressure) const {
        if (!rule_.profile) {
            return station_.vapour_pressure * std::exp(-vapour_fall * (height - rule_.station));
        }
        return 1e-6 * pressure * ratio_at(*rule_.profile, height) *
               std::exp(share(height) * ln_water_);
    }

 private:
    double share(double height) const {
        return std::clamp(1.0 - (height - rule_.station) / mixed_depth, 0.0, 1.0);
    }
    const AirByHeight& rule_;
    const AirState& station_;
    double warmer_ = 0.0, ln_water_ = 0.0;
};

}  // namespace

AirState air_at_height(const AirByHeight& rule, const AirState& station, double height) {
    const double rise = height - rule.station;
    if (rule.same_everywhere() || rise == 0.0) return station;
    // (T29) of docs/theory.md
    const Course course(rule, station);
    // Air that is above saturation at the station stays so by as much.
    const double most =
        std::max(1.0, station.vapour_pressure / saturation_vapour_pressure(station.temperature));
    const auto vapour_at = [&](double z, double temperature, double pressure) {
        return std::min(course.vapour(z, pressure), most * saturation_vapour_pressure(temperature));
    };
    AirState air = station;
    const int steps = std::max(1, int(std::ceil(std::abs(rise) / pressure_step)));
    const double step = rise / steps;
    for (int i = 0; i < steps; ++i) {
        const double middle = rule.station + (i + 0.5) * step;
        const double t = course.temperature(middle);
        const double moist = vapour_at(middle, t, air.pressure) / air.pressure;
        const double virtual_t = t / (1.0 - (1.0 - water_over_dry_air) * moist);
        air.pressure *= std::exp(-gravity * step / (dry_air_gas_constant * virtual_t));
    }
    air.temperature = course.temperature(height);
    air.vapour_pressure = vapour_at(height, air.temperature, air.pressure);
    return air;
}

Profile profile_over(Profile free_air, const AirByHeight& rule, const AirState& station, double low,
                     double high) {
    if (rule.same_everywhere()) {
        return with_surface(std::move(free_air), rule.station * 1e-3, station.temperature,
                            station.vapour_pressure / 100.0, mixed_depth * 1e-3);
    }
    low = std::min(low, rule.station);
    high = std::max(high, rule.station + (rule.profile ? mixed_depth : 0.0));
    const int steps = std::max(1, int(std::ceil((high - low) / level_step)));
    for (int i = 0; i <= steps; ++i) {
        add_level(free_air, 1e-3 * (low + (high - low) * i / steps));
    }
    add_level(free_air, 1e-3 * rule.station);
    if (rule.profile) {  // where it bends
        add_level(free_air, 1e-3 * (rule.station + mixed_depth));
        for (const double km : rule.profile->height_km) {
            if (1e3 * km > low && 1e3 * km < high) add_level(free_air, km);
        }
    }
    add_level(free_air, 1e-3 * (high + mixed_depth));
    const auto change_at = [&](double height, const AirSample& was) {
        const AirState air = air_at_height(rule, station, height);
        const double ratio = 1e6 * std::max(air.vapour_pressure, 1e-7) / air.pressure;
        return AirChange{.warmer = air.temperature - was.temperature,
                         .ln_pressure = std::log(air.pressure / 100.0 / was.pressure_hPa),
                         .ln_water = std::log(ratio / std::max(was.mixing_ratio_ppm[water], 1e-9))};
    };
    const AirChange below = change_at(low, air_at(free_air, 1e-3 * low));
    const AirChange above = change_at(high, air_at(free_air, 1e-3 * high));
    for (std::size_t i = 0; i < free_air.height_km.size(); ++i) {
        const double height = 1e3 * free_air.height_km[i];
        if (height < low) {
            change_level(free_air, i, below, 1.0);
        } else if (height > high) {
            change_level(free_air, i, above, std::max(0.0, 1.0 - (height - high) / mixed_depth));
        } else {
            change_level(free_air, i, change_at(height, sample_of(free_air, i)), 1.0);
        }
    }
    return free_air;
}

}  // namespace diurna
