#include "render/sky_table.hpp"

#include <algorithm>
#include <cmath>

#include "materials/units.hpp"
#include "render/path_table.hpp"
#include "terrain/parallel.hpp"

namespace diurna {

namespace {

double zenith_of(const Eigen::Vector3d& direction) {
    return degrees(std::acos(std::clamp(direction.z(), -1.0, 1.0)));
}

}  // namespace

void SkyTable::Extent::include(const Eigen::Vector3d& direction) {
    const double zenith = zenith_of(direction);
    least_zenith_deg = std::min(least_zenith_deg, zenith);
    most_zenith_deg = std::max(most_zenith_deg, zenith);
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
      sun_azimuth_deg_(degrees(std::atan2(input.to_sun.x(), input.to_sun.y()))) {
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
        part.sunlight.assign(azimuths * nodes * padded_, 0.0f);
        for_each_index(
            azimuths * nodes,
            [&](std::size_t k) {
                put(scattered_background_at(input, *scattered, height_km,
                                            zenith_deg(part.low + part.step * double(k % nodes)),
                                            180.0 * double(k / nodes) / double(azimuths - 1)),
                    &part.sunlight[k * padded_]);
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

void SkyTable::at(const Eigen::Vector3d& direction, std::span<float> out) const {
    const double zenith = zenith_of(direction);
    const bool up = zenith <= horizon_;
    const Part& part = up ? sky_ : plain_;
    const double x = ((up ? above(zenith) : below(zenith)) - part.low) / part.step;
    const Stencil s = stencil(std::clamp(x, 0.0, double(nodes - 1)), nodes);
    std::fill(out.begin(), out.end(), 0.0f);
    const auto add = [&](const float* row, float weight) {
        for (std::size_t c = 0; c < padded_; ++c) out[c] += weight * row[c];
    };
    for (std::size_t i = 0; i < 4; ++i) add(&part.heat[(s.start + i) * padded_], s.weight[i]);
    if (part.sunlight.empty()) return;
    const double azimuth = std::abs(std::remainder(
        degrees(std::atan2(direction.x(), direction.y())) - sun_azimuth_deg_, 360.0));
    const Stencil around = stencil(azimuth / 180.0 * double(azimuths - 1), azimuths);
    for (std::size_t a = 0; a < 4; ++a) {
        for (std::size_t i = 0; i < 4; ++i) {
            add(&part.sunlight[((around.start + a) * nodes + s.start + i) * padded_],
                around.weight[a] * s.weight[i]);
        }
    }
}

}  // namespace diurna
