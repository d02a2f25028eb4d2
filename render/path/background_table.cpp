#include "render/path/background_table.hpp"

#include <algorithm>
#include <cmath>

#include "materials/base/parallel.hpp"
#include "render/path/background.hpp"
#include "render/path/direction_angles.hpp"

namespace diurna {

namespace {

constexpr std::size_t sunlit_nodes = 28;
/// Of a table that is refined until it is close enough.
constexpr std::size_t fewest_nodes = 7, most_nodes = 25;
constexpr double heat_error = 1e-5, sunlight_error = 2e-4;  // shares
constexpr double azimuth_step_deg = 6.0;
constexpr HorizonScale::Side sides[] = {HorizonScale::sky, HorizonScale::plain};

/// Azimuth from the sun's, to either side: 0 to 180.
double azimuth_beside_sun_deg(const Eigen::Vector3d& direction, const Eigen::Vector3d& to_sun) {
    return std::abs(std::remainder(azimuth_from_sun_deg(direction, to_sun), 360.0));
}

/// Values over an axis, at evenly spaced places: their number is doubled until cubics through the
/// even ones are close to the odd ones; those kept are ten times closer.
///
/// - make: make(place) of 0 to 1
/// - close: close(values) of twice as many
template <class Value, class Make, class Close>
std::vector<Value> refined(const Make& make, const Close& close) {
    const auto add = [&](std::size_t first, std::size_t every, std::vector<Value>& values) {
        const double last = double(values.size() - 1);
        for_each_index((values.size() - first + every - 1) / every,
                       [&](std::size_t k) {
                           const std::size_t i = first + every * k;
                           values[i] = make(double(i) / last);
                       },
                       1);
    };
    std::vector<Value> values(fewest_nodes);
    add(0, 1, values);
    while (values.size() < most_nodes) {
        std::vector<Value> finer(2 * values.size() - 1);
        for (std::size_t i = 0; i < values.size(); ++i) finer[2 * i] = std::move(values[i]);
        add(1, 2, finer);
        values = std::move(finer);
        if (close(values)) break;
    }
    return values;
}

/// Error of cubics through the even values, at the odd ones, as a share of `least` or of them.
template <class At>
double error_of_even(std::size_t count, double least, const At& at) {
    return worst_between((count + 1) / 2, [&](std::size_t i) { return at(2 * i); },
                         [&](std::size_t i) { return at(2 * i + 1); },
                         [&](double right) {
                             return std::max({right, least, 1e-300});
                         });
}

}  // namespace

double HorizonScale::of(Side side, double zenith_deg) const {
    return side == sky ? std::log(0.5 + std::max(0.0, horizon_deg - zenith_deg))
                       : std::sqrt(std::max(0.0, zenith_deg - horizon_deg));
}

double HorizonScale::zenith_deg(Side side, double variable) const {
    return side == sky ? std::clamp(horizon_deg - (std::exp(variable) - 0.5), 0.0, horizon_deg)
                       : std::clamp(horizon_deg + std::max(1e-9, variable * variable), 0.0, 180.0);
}

std::optional<HorizonScale::Nodes> HorizonScale::nodes(Side side, double least_zenith_deg,
                                                       double most_zenith_deg,
                                                       std::size_t count) const {
    const bool up = side == sky;
    if (up ? least_zenith_deg > horizon_deg : most_zenith_deg <= horizon_deg) return std::nullopt;
    const double low = of(side, up ? most_zenith_deg : least_zenith_deg);
    const double high = of(side, up ? least_zenith_deg : most_zenith_deg);
    return Nodes{low, std::max(1e-6, (high - low) / double(count - 1))};
}

BackgroundTable::BackgroundTable(const RadianceInput& input, const BandLight& band,
                                 double height_km, const Extent& extent)
    : horizon_{horizon_zenith_deg(input, height_km)} {
    for (const auto side : sides) {
        const auto whole = horizon_.nodes(side, extent.least_zenith_deg, extent.most_zenith_deg, 2);
        if (!whole) continue;
        Part& of = part_[side];
        of.heat = refined<double>(
            [&](double place) {
                const double zenith_deg = horizon_.zenith_deg(side, whole->at(place));
                return band_sum_nodes(
                    band.band, background_at(input, height_km, zenith_deg, band.band.node_um, {},
                                             band.far_ground, band.from_plain()));
            },
            [](const std::vector<double>& heat) {
                return error_of_even(heat.size(), 0.0, [&](std::size_t i) { return heat[i]; }) <
                       heat_error;
            });
        of.nodes = whole->cut(of.heat.size());
    }
    if (band.scattered) add_sunlight(input, band, height_km, extent);
}

void BackgroundTable::add_sunlight(const RadianceInput& input, const BandLight& band,
                                   double height_km, const Extent& extent) {
    const double span = std::max(1e-3, extent.most_azimuth_deg - extent.least_azimuth_deg);
    const std::size_t azimuths = static_cast<std::size_t>(std::ceil(span / azimuth_step_deg)) + 3;
    azimuth_low_ = extent.least_azimuth_deg;
    azimuth_step_ = span / double(azimuths - 1);
    std::vector<double> azimuth_deg(azimuths);
    for (std::size_t a = 0; a < azimuths; ++a) {
        azimuth_deg[a] = azimuth_low_ + azimuth_step_ * double(a);
    }
    for (const auto side : sides) {
        Part& of = part_[side];
        const auto whole = horizon_.nodes(side, extent.least_zenith_deg, extent.most_zenith_deg, 2);
        if (!whole) continue;
        using Azimuths = std::vector<double>;
        const auto found = refined<Azimuths>(
            [&](double place) {
                Azimuths sums;
                for (const auto& spectrum : scattered_backgrounds_at(
                         input, *band.scattered, height_km,
                         horizon_.zenith_deg(side, whole->at(place)), azimuth_deg)) {
                    sums.push_back(band_sum_nodes(band.band, spectrum));
                }
                return sums;
            },
            [&](const std::vector<Azimuths>& sums) {
                double most = 0.0, worst = 0.0;
                for (const Azimuths& at : sums) {
                    most = std::max(most, *std::max_element(at.begin(), at.end()));
                }
                for (std::size_t a = 0; a < azimuths; ++a) {
                    worst =
                        std::max(worst, error_of_even(sums.size(), 0.02 * most,
                                                      [&](std::size_t i) { return sums[i][a]; }));
                }
                return worst < sunlight_error;
            });
        of.sunlit_nodes = whole->cut(found.size());
        of.sunlight.assign(azimuths, std::vector<double>(found.size()));
        for (std::size_t z = 0; z < found.size(); ++z) {
            for (std::size_t a = 0; a < azimuths; ++a) of.sunlight[a][z] = found[z][a];
        }
    }
}

double BackgroundTable::operator()(double zenith_deg, double azimuth_from_sun) const {
    // A pixel's mean direction may lie by a rounding on the other side of the horizon than all of
    // its rays do.
    HorizonScale::Side side = horizon_.side_of(zenith_deg);
    if (part_[side].heat.empty()) side = side == sides[0] ? sides[1] : sides[0];
    const Part& of = part_[side];
    const double variable = horizon_.of(side, zenith_deg);
    const double heat = interpolated(of.heat, of.nodes.place(variable));
    if (of.sunlight.empty()) return heat;
    const Stencil s =
        stencil((azimuth_from_sun - azimuth_low_) / azimuth_step_, of.sunlight.size());
    double sunlight = 0.0;
    for (std::size_t k = 0; k < 4; ++k) {
        sunlight += double(s.weight[k]) *
                    interpolated(of.sunlight[s.start + k], of.sunlit_nodes.place(variable));
    }
    return heat + sunlight;
}

void BackgroundChannels::Extent::include(const Eigen::Vector3d& direction,
                                         const Eigen::Vector3d& to_sun) {
    const double zenith = zenith_deg_of(direction);
    const double azimuth = azimuth_beside_sun_deg(direction, to_sun);
    least_zenith_deg = std::min(least_zenith_deg, zenith);
    most_zenith_deg = std::max(most_zenith_deg, zenith);
    least_azimuth_deg = std::min(least_azimuth_deg, azimuth);
    most_azimuth_deg = std::max(most_azimuth_deg, azimuth);
}

BackgroundChannels::BackgroundChannels(const RadianceInput& input, const BandLight& band,
                                       double height_km, const Extent& extent,
                                       const SightLine& onward)
    : padded_(band.channels.padded()),
      horizon_{horizon_zenith_deg(input, height_km)},
      to_sun_(input.to_sun) {
    // A node to spare on either side where there is one, as a cubic is best in its middle.
    const auto most = static_cast<std::size_t>(180.0 / azimuth_step_deg);
    const auto cell = [](double deg) { return static_cast<std::size_t>(deg / azimuth_step_deg); };
    const std::size_t low = cell(extent.least_azimuth_deg), high = cell(extent.most_azimuth_deg);
    first_azimuth_ = std::min(low > 0 ? low - 1 : 0, most - 3);
    azimuths_ = std::max<std::size_t>(std::min(high + 2, most) + 1 - first_azimuth_, 4);
    for (const auto side : sides) {
        const auto nodes =
            horizon_.nodes(side, extent.least_zenith_deg, extent.most_zenith_deg, sunlit_nodes);
        if (!nodes) continue;
        part_[side].nodes = *nodes;
        fill(side, input, band, height_km, onward);
    }
}

void BackgroundChannels::fill(HorizonScale::Side side, const RadianceInput& input,
                              const BandLight& band, double height_km, const SightLine& onward) {
    Part& of = part_[side];
    const auto put = [&](const std::vector<double>& spectrum, float* to) {
        const std::vector<float> sums = channel_sums(band.band, band.channels, spectrum);
        std::copy(sums.begin(), sums.end(), to);
    };
    std::vector<double> azimuth_deg;
    for (std::size_t a = 0; a < azimuths_; ++a) {
        azimuth_deg.push_back(azimuth_step_deg * double(first_azimuth_ + a));
    }
    of.heat.assign(sunlit_nodes * padded_, 0.0f);
    if (band.scattered) of.sunlight.assign(azimuths_ * sunlit_nodes * padded_, 0.0f);
    for_each_index(
        sunlit_nodes,
        [&](std::size_t z) {
            const double zenith_deg = horizon_.zenith_deg(side, of.nodes.at(z));
            put(background_at(input, height_km, zenith_deg, band.band.node_um, onward,
                              band.far_ground, band.from_plain()),
                &of.heat[z * padded_]);
            if (!band.scattered) return;
            const auto rows = scattered_backgrounds_at(input, *band.scattered, height_km,
                                                       zenith_deg, azimuth_deg, onward);
            for (std::size_t a = 0; a < azimuths_; ++a) {
                float* sunlit = &of.sunlight[(a * sunlit_nodes + z) * padded_];
                put(rows[a], sunlit);
                for (std::size_t c = 0; c < padded_; ++c) sunlit[c] += of.heat[z * padded_ + c];
            }
        },
        1);
}

BackgroundChannels::Place BackgroundChannels::place(const Eigen::Vector3d& direction) const {
    const double zenith_deg = zenith_deg_of(direction);
    const HorizonScale::Side side = horizon_.side_of(zenith_deg);
    const double x = part_[side].nodes.place(horizon_.of(side, zenith_deg));
    const double azimuth =
        azimuth_beside_sun_deg(direction, to_sun_) / azimuth_step_deg - double(first_azimuth_);
    return {side, stencil(std::clamp(x, 0.0, double(sunlit_nodes - 1)), sunlit_nodes),
            stencil(std::clamp(azimuth, 0.0, double(azimuths_ - 1)), azimuths_)};
}

void BackgroundChannels::add(const Place& place, float weight, std::span<float> out) const {
    const Part& of = part_[place.side];
    const Stencil& s = place.zenith;
    // Four rows that lie one after the other at a time.
    const auto add_rows = [&](const float* rows, float times) {
        const float a = times * s.weight[0], b = times * s.weight[1], c = times * s.weight[2],
                    d = times * s.weight[3];
        for (std::size_t k = 0; k < padded_; ++k) {
            out[k] += a * rows[k] + b * rows[padded_ + k] + c * rows[2 * padded_ + k] +
                      d * rows[3 * padded_ + k];
        }
    };
    if (of.sunlight.empty()) {
        add_rows(&of.heat[s.start * padded_], weight);
        return;
    }
    for (std::size_t a = 0; a < 4; ++a) {
        add_rows(&of.sunlight[((place.azimuth.start + a) * sunlit_nodes + s.start) * padded_],
                 weight * place.azimuth.weight[a]);
    }
}

void BackgroundChannels::scale(std::span<const float> factor) {
    for (Part& of : part_) {
        for (std::vector<float>* rows : {&of.heat, &of.sunlight}) {
            for (std::size_t k = 0; k < rows->size(); ++k) (*rows)[k] *= factor[k % padded_];
        }
    }
}

}  // namespace diurna
