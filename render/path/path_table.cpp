#include "render/path/path_table.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "materials/base/parallel.hpp"
#include "materials/radiation/planck.hpp"

namespace diurna {

namespace {

constexpr std::size_t fewest_ranges = 9, most_ranges = 129;

/// Lagrange weights of `count` nodes at 0, 1, 2 ... for the place y.
template <std::size_t Size>
std::array<float, Size> lagrange(double y, std::size_t count) {
    std::array<float, Size> weight{};
    for (std::size_t j = 0; j < count; ++j) {
        double w = 1.0;
        for (std::size_t k = 0; k < count; ++k) {
            if (k != j) w *= (y - double(k)) / (double(j) - double(k));
        }
        weight[j] = static_cast<float>(w);
    }
    return weight;
}

}  // namespace

Stencil stencil(double x, std::size_t nodes) {
    assert(nodes >= 4);
    const double before = std::clamp(std::floor(x) - 1.0, 0.0, double(nodes) - 4.0);
    const auto t = static_cast<float>(x - before);
    const float a = t - 1.0f, b = t - 2.0f, c = t - 3.0f;
    return {.start = static_cast<std::size_t>(before),
            .weight = {a * b * c * (-1.0f / 6.0f), t * b * c * 0.5f, t * a * c * -0.5f,
                       t * a * b * (1.0f / 6.0f)}};
}

double interpolated(std::span<const double> value, double x) {
    const Stencil s = stencil(x, value.size());
    double sum = 0.0;
    for (std::size_t k = 0; k < 4; ++k) sum += double(s.weight[k]) * value[s.start + k];
    return sum;
}

PathTable::PathTable(const Atmosphere& atmosphere, const PathExtent& extent,
                     std::span<const Band> bands, std::span<const Channels> channels,
                     std::span<const std::vector<std::vector<float>>> probe, double tolerance)
    : atmosphere_(atmosphere),
      extent_(extent),
      bands_(bands),
      channels_(channels),
      probe_(probe),
      tolerance_(tolerance),
      segments_(
          chord_segments(std::max(std::abs(extent.observer_height_km - extent.least_height_km),
                                  std::abs(extent.observer_height_km - extent.most_height_km)))),
      error_(bands.size(), 0.0) {
    u_low_ = std::cbrt(extent.least_range_km);
    u_high_ = std::max(std::cbrt(extent.most_range_km), u_low_ + 1e-4);
    if (extent_.most_height_km - extent_.least_height_km < 1e-4) {
        extent_.least_height_km -= 5e-5;
        extent_.most_height_km += 5e-5;
    }
    choose_heights();
    choose_ranges();
}

double PathTable::u_at(std::size_t i, std::size_t count) const {
    return u_low_ + (u_high_ - u_low_) * double(i) / double(count - 1);
}

double PathTable::height_at(std::size_t j, std::size_t count) const {
    return extent_.least_height_km +
           (extent_.most_height_km - extent_.least_height_km) * double(j) / double(count - 1);
}

PathTable::Node PathTable::make_node(double u, double height_km) const {
    const SightLine line = chord(extent_.observer_height_km, height_km, u * u * u, segments_);
    Node node;
    for (std::size_t b = 0; b < bands_.size(); ++b) {
        const PathSpectrum path = path_at_nodes(atmosphere_, line, bands_[b].node_um);
        std::vector<float> transmittance(channels_[b].padded(), 0.0f);
        for (std::size_t c = 0; c < channels_[b].size(); ++c) {
            transmittance[c] = static_cast<float>(path.transmittance[channels_[b].first[c]]);
        }
        node.transmittance.push_back(std::move(transmittance));
        node.radiance.push_back(static_cast<float>(band_sum_nodes(bands_[b], path.radiance)));
        const std::vector<double> one(bands_[b].node_um.size(), 1.0);
        node.air.push_back(channel_sums(bands_[b], channels_[b], one, path.radiance));
    }
    return node;
}

double PathTable::probe_value(std::size_t band, const Node& node, std::size_t probe) const {
    double sum = node.radiance[band];
    for (std::size_t c = 0; c < channels_[band].size(); ++c) {
        sum += double(node.transmittance[band][c]) * double(probe_[band][probe][c]);
    }
    return sum;
}

void PathTable::choose_heights() {
    // At three ranges and five heights: are two, or three, of the heights enough for all five?
    constexpr std::size_t places = 3, all = 5;
    std::vector<Node> node(places * all);
    for_each_index(
        node.size(),
        [&](std::size_t k) { node[k] = make_node(u_at(k / all, places), height_at(k % all, all)); },
        1);
    std::vector<double> worst(bands_.size(), 0.0);
    for (const std::size_t count : {std::size_t{2}, std::size_t{3}, all}) {
        heights_ = count;
        const std::size_t skip = (all - 1) / (count - 1);
        std::fill(worst.begin(), worst.end(), 0.0);
        for (std::size_t b = 0; b < bands_.size(); ++b) {
            for (std::size_t p = 0; p < probe_[b].size(); ++p) {
                for (std::size_t i = 0; i < places; ++i) {
                    std::array<double, all> value;
                    for (std::size_t j = 0; j < all; ++j) {
                        value[j] = probe_value(b, node[i * all + j], p);
                    }
                    const double slope = band_radiance_derivative(
                        bands_[b], brightness_temperature(bands_[b], value[0]));
                    for (std::size_t j = 0; j < all; ++j) {
                        const auto weight = lagrange<all>(double(j) / double(skip), count);
                        double sum = 0.0;
                        for (std::size_t k = 0; k < count; ++k) {
                            sum += double(weight[k]) * value[k * skip];
                        }
                        worst[b] = std::max(worst[b], std::abs(sum - value[j]) / slope);
                    }
                }
            }
        }
        if (*std::max_element(worst.begin(), worst.end()) < 0.5 * tolerance_) break;
    }
    error_ = worst;
}

void PathTable::choose_ranges() {
    const auto make = [&](std::size_t count, std::size_t first, std::size_t every,
                          std::vector<Node>& nodes) {
        nodes.resize(count * heights_);
        const std::size_t made = (count - first + every - 1) / every;
        for_each_index(
            made * heights_,
            [&](std::size_t k) {
                const std::size_t i = first + every * (k / heights_), j = k % heights_;
                nodes[i * heights_ + j] = make_node(u_at(i, count), height_at(j, heights_));
            },
            1);
    };
    ranges_ = fewest_ranges;
    make(ranges_, 0, 1, node_);
    const std::vector<double> of_heights = error_;
    while (ranges_ < most_ranges) {
        const std::size_t finer = 2 * ranges_ - 1;
        std::vector<Node> nodes(finer * heights_);
        for (std::size_t i = 0; i < ranges_; ++i) {
            for (std::size_t j = 0; j < heights_; ++j) {
                nodes[2 * i * heights_ + j] = std::move(node_[i * heights_ + j]);
            }
        }
        make(finer, 1, 2, nodes);

        double worst_of_all = 0.0;
        for (std::size_t b = 0; b < bands_.size(); ++b) {
            double worst = 0.0;
            for (std::size_t p = 0; p < probe_[b].size(); ++p) {
                for (std::size_t j = 0; j < heights_; ++j) {
                    std::vector<double> coarse;
                    for (std::size_t i = 0; i < finer; i += 2) {
                        coarse.push_back(probe_value(b, nodes[i * heights_ + j], p));
                    }
                    const double least = *std::min_element(coarse.begin(), coarse.end());
                    const double slope = band_radiance_derivative(
                        bands_[b], brightness_temperature(bands_[b], least));
                    for (std::size_t i = 1; i < finer; i += 2) {
                        const double exact = probe_value(b, nodes[i * heights_ + j], p);
                        const double error =
                            std::abs(interpolated(coarse, 0.5 * double(i)) - exact) / slope;
                        worst = std::max(worst, error);
                    }
                }
            }
            // Cubic interpolation errs by the fourth power of the spacing: 1/16 is left in theory,
            // 1/8 is claimed.
            error_[b] = of_heights[b] + worst / 8.0;
            worst_of_all = std::max(worst_of_all, worst / 8.0);
        }
        node_ = std::move(nodes);
        ranges_ = finer;
        if (worst_of_all < 0.5 * tolerance_) break;
    }
}

Stencil PathTable::range_stencil(float range) const {
    const double u = std::cbrt(1e-3f * range);
    return stencil((u - u_low_) / (u_high_ - u_low_) * double(ranges_ - 1), ranges_);
}

std::array<float, 5> PathTable::height_weights(float height_km) const {
    const double per_km = double(heights_ - 1) / (extent_.most_height_km - extent_.least_height_km);
    const auto y = static_cast<float>((double{height_km} - extent_.least_height_km) * per_km);
    // Products of the distances to the nodes before and after each.
    const auto count = static_cast<int>(heights_);
    std::array<float, 6> before{1.0f}, after{};
    for (int j = 0; j < count; ++j) {
        const auto k = static_cast<std::size_t>(j);
        before[k + 1] = before[k] * (y - static_cast<float>(j));
    }
    after[heights_] = 1.0f;
    for (int j = count - 1; j > 0; --j) {
        const auto k = static_cast<std::size_t>(j);
        after[k] = after[k + 1] * (y - static_cast<float>(j));
    }
    static constexpr std::array<std::array<float, 5>, 6> norms = {
        {{},
         {},
         {-1.0f, 1.0f},
         {0.5f, -1.0f, 0.5f},
         {},
         {1.0f / 24, -1.0f / 6, 0.25f, -1.0f / 6, 1.0f / 24}}};
    std::array<float, 5> weight{};
    for (std::size_t j = 0; j < heights_; ++j) {
        weight[j] = norms[heights_][j] * before[j] * after[j + 1];
    }
    return weight;
}

const float* PathTable::transmittance(std::size_t band, std::size_t range,
                                      std::size_t height) const {
    return node_[range * heights_ + height].transmittance[band].data();
}

const float* PathTable::air(std::size_t band, std::size_t range, std::size_t height) const {
    return node_[range * heights_ + height].air[band].data();
}

float PathTable::radiance(std::size_t band, std::size_t range, std::size_t height) const {
    return node_[range * heights_ + height].radiance[band];
}

}  // namespace diurna
