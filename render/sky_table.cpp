#include "render/sky_table.hpp"

#include <algorithm>
#include <cmath>

#include "materials/base/parallel.hpp"
#include "materials/base/units.hpp"
#include "render/path/path_table.hpp"

namespace diurna {

namespace {

double zenith_of(const Eigen::Vector3d& direction) {
    return degrees(std::acos(std::clamp(direction.z(), -1.0, 1.0)));
}

/// Azimuth from the sun's, to either side: 0 to 180.
double azimuth_from(const Eigen::Vector3d& to_sun, const Eigen::Vector3d& direction) {
    const double apart =
        std::atan2(direction.x(), direction.y()) - std::atan2(to_sun.x(), to_sun.y());
    return std::abs(std::remainder(degrees(apart), 360.0));
}

}  // namespace

void SkyTable::Extent::include(const Eigen::Vector3d& direction, const Eigen::Vector3d& to_sun) {
    const double zenith = zenith_of(direction), azimuth = azimuth_from(to_sun, direction);
    least_zenith_deg = std::min(least_zenith_deg, zenith);
    most_zenith_deg = std::max(most_zenith_deg, zenith);
    least_azimuth_deg = std::min(least_azimuth_deg, azimuth);
    most_azimuth_deg = std::max(most_azimuth_deg, azimuth);
}

double SkyTable::above(double zenith_deg) const {
    return std::log(0.5 + std::max(0.0, horizon_ - zenith_deg));
}
double SkyTable::below(double zenith_deg) const {
    return std::sqrt(std::max(0.0, zenith_deg - horizon_));
}

SkyTable::SkyTable(const RadianceInput& input, const Band& band, const Channels& channels,
                   const SunField* scattered, double height_km, const Extent& extent)
    : padded_(channels.padded()),
      horizon_(horizon_zenith_deg(input, height_km)),
      to_sun_(input.to_sun) {
    // A node to spare on either side where there is one, as a cubic is best in its middle.
    const auto most = static_cast<std::size_t>(180.0 / azimuth_step_deg);
    const auto cell = [](double deg) { return static_cast<std::size_t>(deg / azimuth_step_deg); };
    const std::size_t low = cell(extent.least_azimuth_deg), high = cell(extent.most_azimuth_deg);
    first_azimuth_ = std::min(low > 0 ? low - 1 : 0, most - 3);
    azimuths_ = std::max<std::size_t>(std::min(high + 2, most) + 1 - first_azimuth_, 4);
    const std::vector<double> one(band.node_um.size(), 1.0);
    const auto put = [&](const std::vector<double>& spectrum, float* to) {
        const std::vector<float> sums = channel_sums(band, channels, one, spectrum);
        std::copy(sums.begin(), sums.end(), to);
    };
    const auto fill = [&](Part& part, const auto& zenith_deg) {
        part.heat.assign(nodes * padded_, 0.0f);
        for_each_index(
            nodes,
            [&](std::size_t z) {
                put(background_at(input, height_km, zenith_deg(part.low + part.step * double(z)),
                                  band.node_um),
                    &part.heat[z * padded_]);
            },
            1);
        if (scattered == nullptr) return;
        part.sunlight.assign(azimuths_ * nodes * padded_, 0.0f);
        std::vector<double> azimuth;
        for (std::size_t a = 0; a < azimuths_; ++a) {
            azimuth.push_back(azimuth_step_deg * double(first_azimuth_ + a));
        }
        for_each_index(
            nodes,
            [&](std::size_t z) {
                const auto rows =
                    scattered_backgrounds_at(input, *scattered, height_km,
                                             zenith_deg(part.low + part.step * double(z)), azimuth);
                for (std::size_t a = 0; a < azimuths_; ++a) {
                    put(rows[a], &part.sunlight[(a * nodes + z) * padded_]);
                }
            },
            1);
    };
    if (extent.least_zenith_deg <= horizon_) {
        sky_.low = above(std::min(horizon_, extent.most_zenith_deg));
        sky_.step = std::max(1e-6, (above(extent.least_zenith_deg) - sky_.low) / double(nodes - 1));
        fill(sky_,
             [&](double t) { return std::clamp(horizon_ - (std::exp(t) - 0.5), 0.0, horizon_); });
    }
    if (extent.most_zenith_deg > horizon_) {
        plain_.low = below(std::max(horizon_, extent.least_zenith_deg));
        plain_.step =
            std::max(1e-6, (below(extent.most_zenith_deg) - plain_.low) / double(nodes - 1));
        fill(plain_,
             [&](double t) { return std::clamp(horizon_ + std::max(1e-9, t * t), 0.0, 180.0); });
    }
}

SkyTable::Place SkyTable::place(const Eigen::Vector3d& direction) const {
    const double zenith = zenith_of(direction);
    const bool up = zenith <= horizon_;
    const Part& part = up ? sky_ : plain_;
    const double x = ((up ? above(zenith) : below(zenith)) - part.low) / part.step;
    const double azimuth =
        azimuth_from(to_sun_, direction) / azimuth_step_deg - double(first_azimuth_);
    return {up, stencil(std::clamp(x, 0.0, double(nodes - 1)), nodes),
            stencil(std::clamp(azimuth, 0.0, double(azimuths_ - 1)), azimuths_)};
}

void SkyTable::at(const Place& place, std::span<float> out) const {
    const Part& part = place.up ? sky_ : plain_;
    const Stencil& s = place.zenith;
    std::fill(out.begin(), out.end(), 0.0f);
    const auto add = [&](const float* row, float weight) {
        for (std::size_t c = 0; c < padded_; ++c) out[c] += weight * row[c];
    };
    for (std::size_t i = 0; i < 4; ++i) add(&part.heat[(s.start + i) * padded_], s.weight[i]);
    if (part.sunlight.empty()) return;
    for (std::size_t a = 0; a < 4; ++a) {
        for (std::size_t i = 0; i < 4; ++i) {
            add(&part.sunlight[((place.azimuth.start + a) * nodes + s.start + i) * padded_],
                place.azimuth.weight[a] * s.weight[i]);
        }
    }
}

}  // namespace diurna
