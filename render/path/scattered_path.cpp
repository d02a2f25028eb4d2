#include "render/path/scattered_path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "materials/base/parallel.hpp"
#include "materials/base/units.hpp"

namespace diurna {

namespace {

constexpr std::size_t most_ranges = 65, most_angles = 129, height_places = 5;

/// Cubic in the middle of every interval of values at even places, against what is right there.
template <class Value, class Middle>
double worst_between(std::size_t count, Value&& value, Middle&& middle, double floor) {
    double worst = 0.0;
    for (std::size_t i = 0; i + 1 < count; ++i) {
        const Stencil s = stencil(double(i) + 0.5, count);
        double sum = 0.0;
        for (std::size_t k = 0; k < 4; ++k) sum += double{s.weight[k]} * value(s.start + k);
        const double right = middle(i);
        worst = std::max(worst, std::abs(sum - right) / std::max(right, floor));
    }
    return worst;
}

/// Lagrange's weights of two, three or five even places for the place y.
std::array<float, height_places> height_weights(float y, std::size_t count) {
    if (count == 2) return {1.0f - y, y};
    const float a = y - 1.0f, b = y - 2.0f;
    if (count == 3) return {0.5f * a * b, -y * b, 0.5f * y * a};
    const float c = y - 3.0f, d = y - 4.0f;
    return {a * b * c * d / 24.0f, y * b * c * d / -6.0f, y * a * c * d / 4.0f,
            y * a * b * d / -6.0f, y * a * b * c / 24.0f};
}

}  // namespace

ScatteredPath::ScatteredPath(const SunField& field, const Band& band, const PathExtent& extent,
                             const Angles& angles, double tolerance)
    : field_(field), band_(band), extent_(extent), span_(angles), tolerance_(tolerance) {
    if (extent_.most_height_km - extent_.least_height_km < 1e-4) {
        extent_.least_height_km -= 5e-5;
        extent_.most_height_km += 5e-5;
    }
    if (span_.most_deg - span_.least_deg < 0.01) span_.most_deg = span_.least_deg + 0.01;
    segments_ =
        chord_segments(std::max(std::abs(extent.observer_height_km - extent.least_height_km),
                                std::abs(extent.observer_height_km - extent.most_height_km)));
    root_low_ = std::cbrt(extent.least_range_km);
    root_high_ = std::max(std::cbrt(extent.most_range_km), root_low_ + 1e-4);
    choose_angles();
    choose_heights();
    choose_ranges();
}

double ScatteredPath::root_at(std::size_t i, std::size_t count) const {
    return root_low_ + (root_high_ - root_low_) * double(i) / double(count - 1);
}

double ScatteredPath::height_at(std::size_t j, std::size_t count) const {
    return extent_.least_height_km +
           (extent_.most_height_km - extent_.least_height_km) * double(j) / double(count - 1);
}

std::vector<double> ScatteredPath::angle_nodes(std::size_t count) const {
    std::vector<double> angle;
    for (std::size_t k = 0; k < count; ++k) {
        angle.push_back(span_.least_deg +
                        (span_.most_deg - span_.least_deg) * double(k) / double(count - 1));
    }
    return angle;
}

ScatteredPath::Node ScatteredPath::make_node(double root, double height_km,
                                             const std::vector<double>& angle_deg) const {
    const SunField::ByTurn light = field_.path_by_turn(
        chord(extent_.observer_height_km, height_km, root * root * root, segments_), angle_deg);
    Node node;
    for (const auto& spectrum : light.at_angle) {
        node.at_angle.push_back(static_cast<float>(band_sum_nodes(band_, spectrum)));
    }
    node.by_cosine = static_cast<float>(band_sum_nodes(band_, light.by_cosine));
    return node;
}

void ScatteredPath::choose_angles() {
    // Along the longest line and a shorter one; all angles of a line cost little more than one.
    double worst = 0.0;
    for (const double part : {1.0, 0.4}) {
        const double root = root_low_ + part * (root_high_ - root_low_);
        const double height = 0.5 * (extent_.least_height_km + extent_.most_height_km);
        const Node fine = make_node(root, height, angle_nodes(2 * most_angles - 1));
        if (part == 1.0) {
            floor_ = 0.02 * double{*std::max_element(fine.at_angle.begin(), fine.at_angle.end())};
        }
        for (;;) {
            const std::size_t skip = 2 * (most_angles - 1) / (angles_ - 1);
            worst = worst_between(
                angles_, [&](std::size_t k) { return double{fine.at_angle[k * skip]}; },
                [&](std::size_t k) { return double{fine.at_angle[k * skip + skip / 2]}; }, floor_);
            if (worst < 0.3 * tolerance_ || angles_ == most_angles) break;
            angles_ = 2 * angles_ - 1;
        }
    }
    error_ = worst;
}

void ScatteredPath::choose_heights() {
    constexpr std::size_t places = 3;
    const auto angle = angle_nodes(3);
    std::vector<Node> node(places * height_places);
    for_each_index(
        node.size(),
        [&](std::size_t k) {
            node[k] = make_node(root_at(1 + k / height_places, places + 1),
                                height_at(k % height_places, height_places), angle);
        },
        1);
    double worst = 0.0;
    for (const std::size_t count : {std::size_t{2}, std::size_t{3}, height_places}) {
        heights_ = count;
        worst = 0.0;
        const std::size_t skip = (height_places - 1) / (count - 1);
        for (std::size_t i = 0; i < places; ++i) {
            for (std::size_t a = 0; a < angle.size(); ++a) {
                for (std::size_t j = 0; j < height_places; ++j) {
                    const auto weight = height_weights(float(j) / float(skip), count);
                    double sum = 0.0;
                    for (std::size_t k = 0; k < count; ++k) {
                        sum += double{weight[k]} *
                               double{node[i * height_places + k * skip].at_angle[a]};
                    }
                    const double right = node[i * height_places + j].at_angle[a];
                    worst = std::max(worst, std::abs(sum - right) / std::max(right, floor_));
                }
            }
        }
        if (worst < 0.3 * tolerance_) break;
    }
    error_ += worst;
}

void ScatteredPath::choose_ranges() {
    const auto angle = angle_nodes(angles_);
    const auto make = [&](std::size_t count, std::size_t first, std::size_t every,
                          std::vector<Node>& nodes) {
        const std::size_t made = (count - first + every - 1) / every;
        for_each_index(
            made * heights_,
            [&](std::size_t k) {
                const std::size_t i = first + every * (k / heights_), j = k % heights_;
                nodes[i * heights_ + j] =
                    make_node(root_at(i, count), height_at(j, heights_), angle);
            },
            1);
    };
    std::vector<Node> nodes(ranges_ * heights_);
    make(ranges_, 0, 1, nodes);
    double worst = 0.0;
    while (ranges_ < most_ranges) {
        const std::size_t finer = 2 * ranges_ - 1;
        std::vector<Node> next(finer * heights_);
        for (std::size_t i = 0; i < ranges_; ++i) {
            for (std::size_t j = 0; j < heights_; ++j) {
                next[2 * i * heights_ + j] = std::move(nodes[i * heights_ + j]);
            }
        }
        make(finer, 1, 2, next);
        worst = 0.0;
        for (std::size_t j = 0; j < heights_; ++j) {
            for (std::size_t a = 0; a < angles_; a += std::max<std::size_t>(1, angles_ / 8)) {
                const auto at = [&](std::size_t i) {
                    return double{next[i * heights_ + j].at_angle[a]};
                };
                worst = std::max(worst, worst_between(
                                            ranges_, [&](std::size_t i) { return at(2 * i); },
                                            [&](std::size_t i) { return at(2 * i + 1); }, floor_));
            }
        }
        // Cubic interpolation errs by the fourth power of the spacing: of the finer nodes' error
        // 1/16 in theory, 1/8 is claimed.
        worst /= 8.0;
        nodes = std::move(next);
        ranges_ = finer;
        if (worst < 0.3 * tolerance_) break;
    }
    error_ += worst;
    at_angle_.resize(ranges_ * heights_ * angles_);
    for (std::size_t k = 0; k < nodes.size(); ++k) {
        std::copy(nodes[k].at_angle.begin(), nodes[k].at_angle.end(),
                  at_angle_.begin() + static_cast<std::ptrdiff_t>(k * angles_));
        by_cosine_.push_back(nodes[k].by_cosine);
    }
}

ScatteredPath::Towards ScatteredPath::towards(double angle_from_sun_deg,
                                              double zenith_cosine) const {
    const double step = (span_.most_deg - span_.least_deg) / double(angles_ - 1);
    const double x =
        std::clamp((angle_from_sun_deg - span_.least_deg) / step, 0.0, double(angles_ - 1));
    return {stencil(x, angles_), static_cast<float>(zenith_cosine)};
}

float ScatteredPath::operator()(const Towards& direction, float range, float height_km) const {
    const double root = double{std::cbrt(1e-3f * range)};
    const double x = (root - root_low_) / (root_high_ - root_low_) * double(ranges_ - 1);
    const Stencil s = stencil(std::clamp(x, 0.0, double(ranges_ - 1)), ranges_);
    const double y = (double{height_km} - extent_.least_height_km) /
                     (extent_.most_height_km - extent_.least_height_km) * double(heights_ - 1);
    const auto up = height_weights(static_cast<float>(y), heights_);
    const auto& w = direction.angle.weight;
    float sum = 0.0f;
    for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t row = (s.start + k) * heights_;
        for (std::size_t j = 0; j < heights_; ++j) {
            const float* v = &at_angle_[(row + j) * angles_ + direction.angle.start];
            const float here = w[0] * v[0] + w[1] * v[1] + w[2] * v[2] + w[3] * v[3] +
                               direction.cosine * by_cosine_[row + j];
            sum += s.weight[k] * up[j] * here;
        }
    }
    return sum;
}

namespace {

/// What a pixel's sightings have in common.
struct Seen {
    float weight = 0.0f, range = 0.0f, height = 0.0f;  // sums, then means
    float nearest = 1e30f, farthest = 0.0f;
};
Seen seen_in(const View& view, std::size_t pixel) {
    Seen seen;
    for (std::uint32_t k = view.row[pixel]; k < view.row[pixel + 1]; ++k) {
        const Sighting& s = view.sighting[k];
        const float range = view.range_of(s);
        seen.weight += s.weight;
        seen.range += s.weight * range;
        seen.height += s.weight * view.height_of(s);
        seen.nearest = std::min(seen.nearest, range);
        seen.farthest = std::max(seen.farthest, range);
    }
    if (seen.weight > 0.0f) {
        seen.range /= seen.weight;
        seen.height /= seen.weight;
    }
    return seen;
}

/// Unit vector to the sun, under the zenith angle that SunField has.
Eigen::Vector3d sun_direction(const RadianceInput& input) {
    const double zenith = radians(input.sun_zenith_deg);
    const double azimuth = std::atan2(input.to_sun.x(), input.to_sun.y());
    return {std::sin(zenith) * std::sin(azimuth), std::sin(zenith) * std::cos(azimuth),
            std::cos(zenith)};
}

}  // namespace

std::string add_scattered_paths(const View& view, const Observer& observer,
                                const RadianceInput& input, const Band& band,
                                const SunField& scattered, const PathExtent& extent,
                                std::span<float> plane) {
    if (view.sighting.empty()) return "no path";
    const PixelRays rays = pixel_rays(observer);
    const Eigen::Vector3d sun = sun_direction(input);
    const auto width = static_cast<std::size_t>(view.width);
    std::vector<float> angle(view.pixels(), -1.0f), cosine(view.pixels(), 0.0f);
    for_each_block(view.pixels(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p) {
            if (view.row[p] == view.row[p + 1]) continue;
            const Eigen::Vector3d to =
                rays.towards(double(p % width) + 0.5, double(p / width) + 0.5);
            angle[p] = static_cast<float>(degrees(std::acos(std::clamp(to.dot(sun), -1.0, 1.0))));
            cosine[p] = static_cast<float>(to.z());
        }
    });
    ScatteredPath::Angles angles{180.0, 0.0};
    for (const float a : angle) {
        if (a < 0.0f) continue;
        angles.least_deg = std::min(angles.least_deg, double{a});
        angles.most_deg = std::max(angles.most_deg, double{a});
    }
    const ScatteredPath table(scattered, band, extent, angles);
    for_each_block(view.pixels(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p) {
            if (angle[p] < 0.0f) continue;
            const auto direction = table.towards(double{angle[p]}, double{cosine[p]});
            const auto height_km = [&](float height) {
                return static_cast<float>(input.ground_height_km + 1e-3 * double{height});
            };
            const Seen seen = seen_in(view, p);
            if (seen.farthest < 1.03f * seen.nearest) {
                plane[p] += seen.weight * table(direction, seen.range, height_km(seen.height));
                continue;
            }
            for (std::uint32_t k = view.row[p]; k < view.row[p + 1]; ++k) {
                const Sighting& s = view.sighting[k];
                plane[p] +=
                    s.weight * table(direction, view.range_of(s), height_km(view.height_of(s)));
            }
        }
    });
    return fmt::format("{:.2g} % from {} ranges, {} heights, {} angles", 100.0 * table.error(),
                       table.ranges(), table.heights(), table.angles());
}

}  // namespace diurna
