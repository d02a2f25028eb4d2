#include "render/path/path_table.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "materials/base/parallel.hpp"
#include "render/light/band_inverse.hpp"

namespace diurna {

namespace {

constexpr std::size_t most_ranges = 129;
constexpr auto sky_heat = static_cast<std::size_t>(Origin::sky_heat);

}  // namespace

PathTable::PathTable(const RadianceInput& input, const PathExtent& extent,
                     std::span<const BandLight> bands, double tolerance)
    : input_(input), bands_(bands), grid_(extent), error_(bands.size(), 0.0) {
    onward_.resize(bands.size() * most_few);
    // At three ranges and five heights: are two, or three, of the heights enough for all five?
    constexpr std::size_t places = 3;
    std::vector<Node> some(places * most_few);
    const auto make = [&](std::initializer_list<std::size_t> heights) {
        prepare(heights);
        for_each_index(
            places * heights.size(),
            [&](std::size_t k) {
                const std::size_t i = k / heights.size(), j = heights.begin()[k % heights.size()];
                some[i * most_few + j] =
                    make_node(grid_.root_at(i, places), grid_.height_at(j, most_few));
            },
            1);
    };
    // Where the middle alone says by far that two are, the others need not be found.
    constexpr double by_far = 0.05;
    make({0, 2, 4});
    for (std::size_t b = 0; b < bands_.size(); ++b) error_[b] = error_in_middle(b, some);
    if (*std::max_element(error_.begin(), error_.end()) < by_far * tolerance) {
        grid_.heights = 2;
    } else {
        make({1, 3});
        choose_heights(grid_, [&](std::size_t count) {
            for (std::size_t b = 0; b < bands_.size(); ++b)
                error_[b] = error_of_fewer(b, some, count);
            return *std::max_element(error_.begin(), error_.end()) < 0.5 * tolerance;
        });
    }
    const std::vector<double> of_heights = error_;
    node_ = refine_ranges<Node>(
        grid_, most_ranges, 0.5 * tolerance,
        [&](double root, double height_km) { return make_node(root, height_km); },
        [&](std::span<const Node> nodes, std::size_t ranges) {
            double worst = 0.0;
            for (std::size_t b = 0; b < bands_.size(); ++b) {
                const double error = left_by_halving * error_between(b, nodes, ranges);
                error_[b] = of_heights[b] + error;
                worst = std::max(worst, error);
            }
            return worst;
        },
        some);
    set_sky_heat();
}

/// The sky's heat at every other range. Between, its share less the transmittance is cubic: it
/// changes less from place to place than the air's radiance does.
void PathTable::set_sky_heat() {
    const std::size_t heights = grid_.heights, coarse = (grid_.ranges + 1) / 2;
    for_each_index(
        bands_.size() * heights,
        [&](std::size_t k) {
            const double height_km = grid_.height_at(k % heights, heights);
            onward_[place(k / heights, height_km)]->add_sky(height_km);
        },
        1);
    for_each_index(
        coarse * heights,
        [&](std::size_t k) {
            const std::size_t i = 2 * (k / heights), j = k % heights;
            set_sky_heat(grid_.root_at(i, grid_.ranges), grid_.height_at(j, heights),
                         node_[i * heights + j]);
        },
        1);
    const Eigen::MatrixXd between = interpolation_matrix(coarse, grid_.ranges);
    for (std::size_t i = 1; i < grid_.ranges; i += 2) {
        for (std::size_t k = 0; k < heights * bands_.size(); ++k) {
            const std::size_t j = k % heights, b = k / heights;
            const auto at = [&](std::size_t range) -> auto& {
                return node_[range * heights + j].transmittance[b];
            };
            for (std::size_t c = 0; c < bands_[b].channels.size(); ++c) {
                double beyond = 0.0;
                for (std::size_t e = 0; e < coarse; ++e) {
                    const auto& there = at(2 * e);
                    beyond += between(Eigen::Index(i), Eigen::Index(e)) *
                              (double{there[sky_heat][c]} - double{there[0][c]});
                }
                at(i)[sky_heat][c] =
                    static_cast<float>(std::max(0.0, double{at(i)[0][c]} + beyond));
            }
        }
    }
    for (Node& node : node_) node.met.clear();
}

void PathTable::set_sky_heat(double root, double height_km, Node& node) const {
    const SightLine line = grid_.line(root, height_km);
    for (std::size_t b = 0; b < bands_.size(); ++b) {
        const Channels& channels = bands_[b].channels;
        const std::vector<float>& whole = node.transmittance[b][0];
        std::vector<double> transmittance(bands_[b].band.node_um.size(), 0.0);
        for (std::size_t c = 0; c < channels.size(); ++c) {
            transmittance[channels.first[c]] = double{whole[c]};
        }
        const std::vector<double> heat =
            onward_[place(b, height_km)]->sky_heat(line, node.met[b], transmittance);
        for (std::size_t c = 0; c < channels.size(); ++c) {
            node.transmittance[b][sky_heat][c] = static_cast<float>(heat[channels.first[c]]);
        }
    }
}

void PathTable::prepare(std::initializer_list<std::size_t> heights) {
    for_each_index(
        bands_.size() * heights.size(),
        [&](std::size_t k) {
            const std::size_t b = k / heights.size(), j = heights.begin()[k % heights.size()];
            onward_[b * most_few + j].emplace(input_.atmosphere, grid_.height_at(j, most_few),
                                              input_.sun_zenith_deg, bands_[b].band.node_um, false);
        },
        1);
}

/// Of a band and a height among the five, in onward_: the heights of nodes are always some of them.
std::size_t PathTable::place(std::size_t band, double height_km) const {
    const double at = (height_km - grid_.height_at(0, most_few)) /
                      (grid_.height_at(1, most_few) - grid_.height_at(0, most_few));
    return band * most_few + static_cast<std::size_t>(std::lround(at));
}

PathTable::Node PathTable::make_node(double root, double height_km) const {
    const SightLine line = grid_.line(root, height_km);
    Node node;
    for (std::size_t b = 0; b < bands_.size(); ++b) {
        const BandLight& of = bands_[b];
        const std::size_t channels = of.channels.size();
        auto [path, sunlight, met] = onward_[place(b, height_km)]->direct(line);
        auto& transmittance = node.transmittance.emplace_back();
        transmittance.fill(std::vector<float>(of.channels.padded(), 0.0f));
        for (std::size_t c = 0; c < channels; ++c) {
            const std::size_t n = of.channels.first[c];
            transmittance[0][c] = static_cast<float>(path.transmittance[n]);
            transmittance[1][c] = static_cast<float>(sunlight[n]);
        }
        node.met.push_back(std::move(met));
        node.radiance.push_back(static_cast<float>(band_sum_nodes(of.band, path.radiance)));
        node.channel_radiance.push_back(channel_sums(of.band, of.channels, path.radiance));
    }
    return node;
}

/// Radiance of a probe behind the air before a node.
double PathTable::probe_value(std::size_t band, const Node& node, std::size_t probe) const {
    double sum = node.radiance[band];
    const auto& transmittance = node.transmittance[band];
    const auto add = [&](Origin origin, const std::vector<float>& light) {
        const auto& tau = transmittance[static_cast<std::size_t>(origin)];
        for (std::size_t c = 0; c < light.size(); ++c) sum += double{tau[c]} * double{light[c]};
    };
    add(Origin::surface, bands_[band].probe[probe].heat);
    add(Origin::sunlight, bands_[band].probe[probe].sunlight);
    return sum;
}

/// Error [K] of taking `count` of the five heights of each of a few ranges.
double PathTable::error_of_fewer(std::size_t band, std::span<const Node> nodes,
                                 std::size_t count) const {
    double worst = 0.0;
    for (std::size_t p = 0; p < bands_[band].probe.size(); ++p) {
        for (std::size_t i = 0; i < nodes.size(); i += most_few) {
            std::array<double, most_few> value;
            for (std::size_t j = 0; j < most_few; ++j) {
                value[j] = probe_value(band, nodes[i + j], p);
            }
            const double slope = radiance_per_kelvin(bands_[band].band, value[0]);
            const auto found = from_fewer(value, count);
            for (std::size_t j = 0; j < most_few; ++j) {
                worst = std::max(worst, std::abs(found[j] - value[j]) / slope);
            }
        }
    }
    return worst;
}

double PathTable::error_in_middle(std::size_t band, std::span<const Node> nodes) const {
    double worst = 0.0;
    for (std::size_t p = 0; p < bands_[band].probe.size(); ++p) {
        for (std::size_t i = 0; i < nodes.size(); i += most_few) {
            const auto at = [&](std::size_t j) { return probe_value(band, nodes[i + j], p); };
            const double low = at(0);
            const double error = 0.5 * (low + at(most_few - 1)) - at(most_few / 2);
            worst = std::max(worst, std::abs(error) / radiance_per_kelvin(bands_[band].band, low));
        }
    }
    return worst;
}

/// Error [K] at the odd ranges of a cubic through the even ones.
double PathTable::error_between(std::size_t band, std::span<const Node> nodes,
                                std::size_t ranges) const {
    double worst = 0.0;
    for (std::size_t p = 0; p < bands_[band].probe.size(); ++p) {
        for (std::size_t j = 0; j < grid_.heights; ++j) {
            std::vector<double> value(ranges);
            for (std::size_t i = 0; i < ranges; ++i) {
                value[i] = probe_value(band, nodes[i * grid_.heights + j], p);
            }
            double least = value[0];
            for (std::size_t i = 2; i < ranges; i += 2) least = std::min(least, value[i]);
            const double slope = radiance_per_kelvin(bands_[band].band, least);
            worst = std::max(
                worst, worst_between((ranges + 1) / 2, [&](std::size_t i) { return value[2 * i]; },
                                     [&](std::size_t i) { return value[2 * i + 1]; },
                                     [&](double) { return slope; }));
        }
    }
    return worst;
}

}  // namespace diurna
