#include "thermal/weather/sky_state.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "materials/air/moist_air.hpp"
#include "materials/base/units.hpp"

namespace diurna {

namespace {

double water_path_cm(const AirState& air) {
    return 46.5 * (air.vapour_pressure / 100.0) / air.temperature;
}

// A sun closer than this to the horizon divides direct light by almost nothing.
constexpr double least_sine = 0.02;

}  // namespace

ClearSun bird_clear_sky(double sun_elevation_deg, double distance_au, double pressure,
                        double water_cm, const ClearSky& sky) {
    if (sun_elevation_deg <= 0.0) return {0.0, 0.0};
    const double zenith_deg = 90.0 - sun_elevation_deg;
    const double cosine = std::sin(radians(sun_elevation_deg));
    const double mass = 1.0 / (cosine + 0.15 * std::pow(93.885 - zenith_deg, -1.25));
    const double pressure_mass = mass * pressure / 101325.0;
    const double top = solar_constant / (distance_au * distance_au);

    // Bird's depth of Rayleigh scattering turns back beyond 13 air masses (sun below 4°); from 10
    // on it follows the slope of Kasten's (1996, Solar Energy 56, 239).
    const double thin = std::min(pressure_mass, 10.0);
    const double rayleigh =
        std::exp(-0.0903 * std::pow(thin, 0.84) * (1.0 + thin - std::pow(thin, 1.01)) -
                 0.0156 * (pressure_mass - thin));
    const double o = sky.ozone_cm * mass;
    const double ozone = 1.0 - 0.1611 * o * std::pow(1.0 + 139.48 * o, -0.3035) -
                         0.002715 * o / (1.0 + 0.044 * o + 0.0003 * o * o);
    const double mixed = std::exp(-0.0127 * std::pow(pressure_mass, 0.26));
    const double w = water_cm * mass;
    const double water = 1.0 - 2.4959 * w / (std::pow(1.0 + 79.034 * w, 0.6828) + 6.385 * w);
    const double depth = 0.2758 * sky.aerosol_380nm + 0.35 * sky.aerosol_500nm;
    const double aerosol = std::exp(
        -std::pow(depth, 0.873) * (1.0 + depth - std::pow(depth, 0.7088)) * std::pow(mass, 0.9108));

    // Absorbed and scattered aerosol light: single scattering 0.9, forward share 0.84.
    const double absorbed = 1.0 - 0.1 * (1.0 - mass + std::pow(mass, 1.06)) * (1.0 - aerosol);
    const double back_scatter = 0.0685 + (1.0 - 0.84) * (1.0 - aerosol / absorbed);
    const double direct = top * 0.9662 * rayleigh * ozone * mixed * water * aerosol;
    const double scattered = top * cosine * 0.79 * ozone * mixed * water * absorbed *
                             (0.5 * (1.0 - rayleigh) + 0.84 * (1.0 - aerosol / absorbed)) /
                             (1.0 - mass + std::pow(mass, 1.02));
    const double global = (direct * cosine + scattered) / (1.0 - sky.ground_albedo * back_scatter);
    return {direct, std::max(0.0, global - direct * cosine)};
}

ClearSun ineichen_clear_sky(double sun_elevation_deg, double distance_au, double pressure,
                            double elevation, double linke_turbidity) {
    if (sun_elevation_deg <= 0.0) return {0.0, 0.0};
    const double zenith_deg = 90.0 - sun_elevation_deg;
    const double cosine = std::sin(radians(sun_elevation_deg));
    const double top = solar_constant / (distance_au * distance_au);
    // Kasten & Young 1989, at the pressure of the place.
    const double mass =
        pressure / 101325.0 / (cosine + 0.50572 * std::pow(96.07995 - zenith_deg, -1.6364));
    const double low = std::exp(-elevation / 8000.0), high = std::exp(-elevation / 1250.0);
    const double haze = linke_turbidity - 1.0;
    const double global = (5.09e-5 * elevation + 0.868) * top * cosine *
                          std::exp(-(3.92e-5 * elevation + 0.0387) * mass * (low + high * haze));
    const double beam = top * (0.664 + 0.163 / low) * std::exp(-0.09 * mass * haze);
    const double most =
        global / cosine *
        std::max(0.0, 1.0 - (0.1 - 0.2 * std::exp(-linke_turbidity)) / (0.1 + 0.882 / low));
    const double direct = std::min(beam, most);
    return {direct, std::max(0.0, global - direct * cosine)};
}

double clear_longwave(const AirState& air, LongwaveFormula formula) {
    const double t = air.temperature, e = air.vapour_pressure / 100.0;
    const double black = stefan_boltzmann * power4(t);
    switch (formula) {
        case LongwaveFormula::brutsaert:
            return 1.24 * std::pow(e / t, 1.0 / 7.0) * black;
        case LongwaveFormula::prata: {
            const double w = 46.5 * e / t;
            return (1.0 - (1.0 + w) * std::exp(-std::sqrt(1.2 + 3.0 * w))) * black;
        }
        case LongwaveFormula::brunt:
            return (0.52 + 0.065 * std::sqrt(e)) * black;
        case LongwaveFormula::idso:
            return (0.70 + 5.95e-5 * e * std::exp(1500.0 / t)) * black;
        case LongwaveFormula::swinbank:
            return 5.31e-13 * std::pow(t, 6);
        case LongwaveFormula::dilley_obrien:
            break;
    }
    return clear_longwave(air);
}

TiltedSky::Tilt TiltedSky::tilt_of(double slope) {
    // Σ (ln sec z − ½) cos(incidence) dω / π in rings around the zenith. With s = sin² z the
    // weights are exact for a level facet: ∫ (ln sec z − ½) ds = ½ (1 − s) ln(1 − s).
    constexpr int rings = 180;
    constexpr double b = 0.09;
    const auto primitive = [](double s) {
        return s < 1.0 ? 0.5 * (1.0 - s) * std::log(1.0 - s) : 0.0;
    };
    const double up = std::cos(slope), across = std::sin(slope);
    Tilt tilt{.view = {0.0}, .excess = {0.0}};
    double last = 0.0;
    // Finer towards the horizon, where ln sec z has no end.
    const auto edge_of = [&](int i) {
        const double left = 1.0 - double(i) / rings;
        return 0.5 * std::numbers::pi * (1.0 - left * left);
    };
    for (int i = 0; i < rings; ++i) {
        const double s = i + 1 == rings ? 1.0 : std::pow(std::sin(edge_of(i + 1)), 2);
        const double z = 0.5 * (edge_of(i) + edge_of(i + 1));
        // Mean over the ring of max(0, cos(incidence)) / cos z.
        const double level = up, swing = across * std::tan(z);
        double seen = std::max(level, 0.0);
        if (std::abs(level) < swing) {
            const double edge = std::acos(-level / swing);
            seen = (level * edge + swing * std::sin(edge)) / std::numbers::pi;
        }
        tilt.view.push_back(tilt.view.back() + seen * (s - last));
        tilt.excess.push_back(tilt.excess.back() + b * seen * (primitive(s) - primitive(last)));
        last = s;
    }
    return tilt;
}

double TiltedSky::at(const Tilt& tilt, double share) {
    const double view = share * tilt.view.back();
    const auto above = std::upper_bound(tilt.view.begin(), tilt.view.end(), view);
    if (above == tilt.view.end()) return tilt.excess.back();
    const auto i = static_cast<std::size_t>(above - tilt.view.begin());
    const double part = (view - tilt.view[i - 1]) / (tilt.view[i] - tilt.view[i - 1]);
    return std::lerp(tilt.excess[i - 1], tilt.excess[i], part);
}

TiltedSky::TiltedSky() {
    for (int degree = 0; degree <= 180; degree += 2) tilt_.push_back(tilt_of(radians(degree)));
}

double TiltedSky::excess(double up_cosine, double sky_view) const {
    const double whole = 0.5 * (1.0 + up_cosine);
    const double share = whole > 0.0 ? std::min(1.0, sky_view / whole) : 0.0;
    const double place = 0.5 * degrees(std::acos(std::clamp(up_cosine, -1.0, 1.0)));
    const auto i = std::min(static_cast<std::size_t>(place), tilt_.size() - 2);
    return std::lerp(at(tilt_[i], share), at(tilt_[i + 1], share), place - double(i));
}

double tilted_sky_excess(double slope, double sky_view) {
    const double whole = 0.5 * (1.0 + std::cos(slope));
    const double share = whole > 0.0 ? std::min(1.0, sky_view / whole) : 0.0;
    return TiltedSky::at(TiltedSky::tilt_of(slope), share);
}

double clear_longwave(const AirState& air) {
    const double t = air.temperature / 273.16;
    return 59.38 + 113.7 * std::pow(t, 6) + 96.96 * std::sqrt(water_path_cm(air) / 2.5);
}

double cloudy_longwave(const AirState& air, double cloud_fraction, LongwaveFormula formula) {
    const double black = stefan_boltzmann * power4(air.temperature);
    return cloud_fraction * black + (1.0 - cloud_fraction) * clear_longwave(air, formula);
}

double erbs_diffuse_share(double clearness) {
    const double k = clearness;
    if (k <= 0.22) return 1.0 - 0.09 * k;
    if (k > 0.80) return 0.165;
    return 0.9511 + k * (-0.1604 + k * (4.388 + k * (-16.638 + k * 12.336)));
}

double SkyState::global_horizontal() const {
    return direct_normal * std::max(0.0, to_sun.z()) + diffuse_horizontal;
}

SkyState sky_state(const Site& site, double elevation, Instant instant, const Forcing& forcing,
                   const ClearSky& clear) {
    return sky_state(sun_position(site, instant), elevation, forcing, clear);
}

SkyState sky_state(const SunPosition& geometric, double elevation, const Forcing& forcing,
                   const ClearSky& clear) {
    const AirState& air = forcing.air;
    const double pressure = air.pressure > 0.0 ? air.pressure : standard_pressure(elevation);
    SkyState sky;
    sky.sun = refracted(geometric, pressure / 100.0, celsius(air.temperature));
    sky.to_sun = sun_direction(sky.sun);
    const double sine = sky.to_sun.z();
    const double top = solar_constant / (sky.sun.distance_au * sky.sun.distance_au);
    const bool up = sine > 0.0;

    const bool has_global = !std::isnan(forcing.shortwave_down);
    const bool has_direct = !std::isnan(forcing.direct_normal);
    const bool has_diffuse = !std::isnan(forcing.diffuse);
    const double global = std::max(0.0, forcing.shortwave_down);
    if (has_direct && has_diffuse) {
        sky.direct_normal = up ? std::max(0.0, forcing.direct_normal) : 0.0;
        sky.diffuse_horizontal = std::max(0.0, forcing.diffuse);
        const double sum = sky.global_horizontal();
        if (has_global && sum > 0.0) {
            sky.direct_normal *= global / sum;
            sky.diffuse_horizontal *= global / sum;
        } else if (has_global) {
            sky.diffuse_horizontal = global;
        }
    } else if (has_global) {
        double diffuse = global;
        if (has_diffuse) {
            diffuse = std::clamp(forcing.diffuse, 0.0, global);
        } else if (has_direct && up) {
            diffuse = std::max(0.0, global - std::max(0.0, forcing.direct_normal) * sine);
        } else if (up) {
            diffuse = global * erbs_diffuse_share(global / (top * std::max(sine, least_sine)));
        }
        if (!up) diffuse = global;
        // The beam is no stronger than above the air; what is left over came from the sky.
        sky.direct_normal = up ? std::min((global - diffuse) / sine, top) : 0.0;
        sky.diffuse_horizontal = global - sky.direct_normal * std::max(0.0, sine);
    } else if (up) {
        const double water = std::isnan(clear.precipitable_water_cm) ? water_path_cm(air)
                                                                     : clear.precipitable_water_cm;
        const ClearSun sun =
            std::isnan(clear.linke_turbidity)
                ? bird_clear_sky(sky.sun.elevation_deg, sky.sun.distance_au, pressure, water, clear)
                : ineichen_clear_sky(sky.sun.elevation_deg, sky.sun.distance_au, pressure,
                                     elevation, clear.linke_turbidity);
        const double cloud = std::isnan(forcing.cloud_fraction) ? 0.0 : forcing.cloud_fraction;
        const double clear_global = sun.direct_normal * sine + sun.diffuse_horizontal;
        const double under_cloud = clear_global * (1.0 - 0.75 * std::pow(cloud, 3.4));
        sky.direct_normal = sun.direct_normal * (1.0 - cloud);
        if (has_direct) sky.direct_normal = std::max(0.0, forcing.direct_normal);
        sky.diffuse_horizontal =
            has_diffuse ? std::max(0.0, forcing.diffuse)
                        : std::max(0.0, under_cloud - sun.direct_normal * (1.0 - cloud) * sine);
    }
    sky.anisotropy = std::clamp(sky.direct_normal / top, 0.0, 1.0);

    if (!std::isnan(forcing.longwave_down)) {
        sky.longwave_down = forcing.longwave_down;
    } else {
        sky.longwave_down = std::isnan(forcing.cloud_fraction)
                                ? clear_longwave(air, clear.longwave)
                                : cloudy_longwave(air, forcing.cloud_fraction, clear.longwave);
    }
    if (clear.longwave_by_direction) {
        // Overcast is even. Where only the flux was measured, Crawford and Duchon's cloud follows
        // from it; a sky darker than clear air's is so in all directions.
        const double black = stefan_boltzmann * power4(air.temperature);
        const double cloudless = clear_longwave(air, clear.longwave);
        double share = 1.0 - forcing.cloud_fraction;
        if (!std::isnan(forcing.longwave_down)) {
            share = sky.longwave_down < cloudless
                        ? std::max(0.0, sky.longwave_down / cloudless)
                        : std::max(0.0, (black - sky.longwave_down) / (black - cloudless));
        }
        if (std::isnan(share)) share = 1.0;
        sky.tilted_longwave = std::clamp(share, 0.0, 1.0) * black;
    }
    // Below 5 W/m² two pyranometers' offsets are larger than the albedo they would give.
    if (has_global && global > 5.0 && !std::isnan(forcing.shortwave_up)) {
        sky.albedo = std::clamp(forcing.shortwave_up / global, 0.0, 1.0);
    }
    if (!std::isnan(forcing.plane_of_array)) {
        sky.plane_of_array = std::max(0.0, forcing.plane_of_array);
    }
    return sky;
}

void infer_cloud(Weather& weather, const Site& site, double elevation, const ClearSky& clear) {
    constexpr double least_elevation_deg = 8.0;
    double held = not_measured;
    std::size_t waiting = 0;  // samples before the first daylight take its value
    for (std::size_t i = 0; i < weather.sample.size(); ++i) {
        Forcing& forcing = weather.sample[i];
        if (!std::isnan(forcing.cloud_fraction)) {
            held = forcing.cloud_fraction;
            continue;
        }
        if (!std::isnan(forcing.shortwave_down)) {
            Forcing cloudless = forcing;
            cloudless.shortwave_down = cloudless.direct_normal = cloudless.diffuse = not_measured;
            const SkyState sky = sky_state(site, elevation, weather.instant[i], cloudless, clear);
            if (sky.sun.elevation_deg > least_elevation_deg) {
                held = std::clamp(1.0 - forcing.shortwave_down / sky.global_horizontal(), 0.0, 1.0);
                for (; waiting < i; ++waiting) {
                    double& earlier = weather.sample[waiting].cloud_fraction;
                    if (std::isnan(earlier)) earlier = held;
                }
                waiting = weather.sample.size();
            }
        }
        forcing.cloud_fraction = held;
    }
}

double facet_sunlight(const SkyState& sky, double sun_cosine, double sun_fraction,
                      double sky_view) {
    const double sine = sky.to_sun.z();
    const double seen = std::max(0.0, sun_cosine) * sun_fraction;
    double beam = 0.0, even = sky.diffuse_horizontal;
    if (sine > 0.0) {
        // Circumsolar light is that of a beam; near the horizon its strength is bounded.
        const double circumsolar =
            sky.diffuse_horizontal * sky.anisotropy * std::min(1.0, sine / least_sine);
        beam = (sky.direct_normal + circumsolar / sine) * seen;
        even -= circumsolar;
    }
    return beam + even * sky_view;
}

}  // namespace diurna
