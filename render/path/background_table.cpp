#include "render/path/background_table.hpp"

#include <algorithm>
#include <cmath>

#include "materials/base/parallel.hpp"
#include "render/path/path_table.hpp"

namespace diurna {

// The way through the air grows like one over the angle above the horizon.
double BackgroundTable::above(double zenith_deg) const {
    return std::log(0.5 + std::max(0.0, horizon_ - zenith_deg));
}
// The way to a plain behaves like a square root where it becomes visible.
double BackgroundTable::below(double zenith_deg) const {
    return std::sqrt(std::max(0.0, zenith_deg - horizon_));
}

BackgroundTable::BackgroundTable(const RadianceInput& input, const Band& band, double height_km,
                                 double least_zenith_deg, double most_zenith_deg)
    : horizon_(horizon_zenith_deg(input, height_km)) {
    const auto value = [&](double zenith_deg) {
        return band_sum_nodes(band, background_at(input, height_km, zenith_deg, band.node_um));
    };
    if (least_zenith_deg <= horizon_) {
        const double end = above(least_zenith_deg);
        above_low_ = above(most_zenith_deg);
        above_step_ = std::max(1e-6, (end - above_low_) / double(nodes - 1));
        sky_.resize(nodes);
        for_each_index(
            nodes,
            [&](std::size_t k) {
                const double t = above_low_ + above_step_ * double(k);
                sky_[k] = value(std::clamp(horizon_ - (std::exp(t) - 0.5), 0.0, horizon_));
            },
            1);
    }
    if (most_zenith_deg > horizon_) {
        const double end = below(most_zenith_deg);
        below_low_ = below(least_zenith_deg);
        below_step_ = std::max(1e-6, (end - below_low_) / double(nodes - 1));
        plain_.resize(nodes);
        for_each_index(
            nodes,
            [&](std::size_t k) {
                const double t = below_low_ + below_step_ * double(k);
                plain_[k] = value(std::clamp(horizon_ + std::max(1e-9, t * t), 0.0, 180.0));
            },
            1);
    }
}

void BackgroundTable::add_sunlight(const RadianceInput& input, const Band& band,
                                   const SunField& scattered, double height_km,
                                   double least_azimuth_deg, double most_azimuth_deg) {
    constexpr double step_deg = 6.0;
    const double span = std::max(1e-3, most_azimuth_deg - least_azimuth_deg);
    const std::size_t azimuths = static_cast<std::size_t>(std::ceil(span / step_deg)) + 3;
    azimuth_low_ = least_azimuth_deg;
    azimuth_step_ = span / double(azimuths - 1);
    std::vector<double> azimuth_deg(azimuths);
    for (std::size_t a = 0; a < azimuths; ++a) {
        azimuth_deg[a] = azimuth_low_ + azimuth_step_ * double(a);
    }
    const auto fill = [&](Sunlit& part, const auto& zenith_deg) {
        part.radiance.assign(azimuths, std::vector<double>(sunlit_nodes));
        for_each_index(
            sunlit_nodes,
            [&](std::size_t z) {
                const auto spectra = scattered_backgrounds_at(
                    input, scattered, height_km, zenith_deg(part.low + part.step * double(z)),
                    azimuth_deg);
                for (std::size_t a = 0; a < azimuths; ++a) {
                    part.radiance[a][z] = band_sum_nodes(band, spectra[a]);
                }
            },
            1);
    };
    constexpr double finer = double(nodes - 1) / double(sunlit_nodes - 1);
    if (!sky_.empty()) {
        sunlit_sky_.low = above_low_;
        sunlit_sky_.step = above_step_ * finer;
        fill(sunlit_sky_,
             [&](double t) { return std::clamp(horizon_ - (std::exp(t) - 0.5), 0.0, horizon_); });
    }
    if (!plain_.empty()) {
        sunlit_plain_.low = below_low_;
        sunlit_plain_.step = below_step_ * finer;
        fill(sunlit_plain_,
             [&](double t) { return std::clamp(horizon_ + std::max(1e-9, t * t), 0.0, 180.0); });
    }
}

double BackgroundTable::sunlit(const Sunlit& part, double place, double azimuth_deg) const {
    if (part.radiance.empty()) return 0.0;
    const Stencil s = stencil((azimuth_deg - azimuth_low_) / azimuth_step_, part.radiance.size());
    double sum = 0.0;
    for (std::size_t k = 0; k < 4; ++k) {
        sum += double(s.weight[k]) *
               interpolated(part.radiance[s.start + k], (place - part.low) / part.step);
    }
    return sum;
}

double BackgroundTable::operator()(double zenith_deg, double azimuth_from_sun_deg) const {
    if (zenith_deg <= horizon_) {
        const double place = above(zenith_deg);
        return interpolated(sky_, (place - above_low_) / above_step_) +
               sunlit(sunlit_sky_, place, azimuth_from_sun_deg);
    }
    const double place = below(zenith_deg);
    return interpolated(plain_, (place - below_low_) / below_step_) +
           sunlit(sunlit_plain_, place, azimuth_from_sun_deg);
}

}  // namespace diurna
