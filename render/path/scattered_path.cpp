#include "render/path/scattered_path.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "materials/base/parallel.hpp"

namespace diurna {

namespace {

constexpr std::size_t most_scattered_ranges = 65, most_angles = 129;
/// What is tried first, as many angles as most pictures need.
constexpr std::size_t usual_angles = 17;

}  // namespace

ScatteredPath::ScatteredPath(const SunField& field, const Band& band, const PathExtent& extent,
                             const Angles& angles, double tolerance)
    : field_(field), band_(band), grid_(extent), span_(angles) {
    if (span_.most_deg - span_.least_deg < 0.01) span_.most_deg = span_.least_deg + 0.01;
    const double enough = 0.3 * tolerance;
    choose_angles(enough);

    constexpr std::size_t places = 3, some_angles = 3;
    std::vector<Node> some(places * most_few);
    for_each_index(
        some.size(),
        [&](std::size_t k) {
            some[k] = make_node(grid_.root_at(1 + k / most_few, places + 1),
                                grid_.height_at(k % most_few, most_few), some_angles);
        },
        1);
    double worst = 0.0;
    choose_heights(grid_, [&](std::size_t count) {
        worst = error_of_fewer_heights(some, count);
        return worst < enough;
    });
    error_ += worst;

    const std::vector<Node> nodes = refine_ranges<Node>(
        grid_, most_scattered_ranges, enough,
        [&](double root, double height_km) { return make_node(root, height_km, angles_); },
        [&](const std::vector<Node>& finer, std::size_t ranges) {
            return worst = left_by_halving * error_between_ranges(finer, ranges);
        });
    error_ += worst;
    at_angle_.reserve(nodes.size() * angles_);
    for (const Node& node : nodes) {
        at_angle_.insert(at_angle_.end(), node.at_angle.begin(), node.at_angle.end());
        by_cosine_.push_back(node.by_cosine);
    }
}

ScatteredPath::Node ScatteredPath::make_node(double root, double height_km,
                                             std::size_t angles) const {
    std::vector<double> angle_deg;
    for (std::size_t k = 0; k < angles; ++k) angle_deg.push_back(span_.at(k, angles));
    const SunField::ByTurn light = field_.path_by_turn(grid_.line(root, height_km), angle_deg);
    Node node;
    for (const auto& spectrum : light.at_angle) {
        node.at_angle.push_back(static_cast<float>(band_sum_nodes(band_, spectrum)));
    }
    node.by_cosine = static_cast<float>(band_sum_nodes(band_, light.by_cosine));
    return node;
}

/// Along the longest line and a shorter one; all angles of a line cost little more than one.
void ScatteredPath::choose_angles(double tolerance) {
    for (const double part : {1.0, 0.4}) {
        const double root = grid_.root_low + part * (grid_.root_high - grid_.root_low);
        const double height = 0.5 * (grid_.extent.least_height_km + grid_.extent.most_height_km);
        std::size_t most = std::max(usual_angles, angles_);
        Node fine = make_node(root, height, 2 * most - 1);
        if (part == 1.0) {
            floor_ = 0.02 * double{*std::max_element(fine.at_angle.begin(), fine.at_angle.end())};
        }
        for (;;) {
            const std::size_t skip = 2 * (most - 1) / (angles_ - 1);
            error_ = worst_between(
                angles_, [&](std::size_t k) { return double{fine.at_angle[k * skip]}; },
                [&](std::size_t k) { return double{fine.at_angle[k * skip + skip / 2]}; },
                [&](double right) { return std::max(right, floor_); });
            if (error_ < tolerance || angles_ == most_angles) break;
            angles_ = 2 * angles_ - 1;
            if (angles_ <= most) continue;
            most = most_angles;
            fine = make_node(root, height, 2 * most - 1);
        }
    }
}

/// Of taking `count` of the five heights of each of a few ranges.
double ScatteredPath::error_of_fewer_heights(const std::vector<Node>& nodes,
                                             std::size_t count) const {
    double worst = 0.0;
    for (std::size_t i = 0; i < nodes.size(); i += most_few) {
        for (std::size_t a = 0; a < nodes[i].at_angle.size(); ++a) {
            std::array<double, most_few> value;
            for (std::size_t j = 0; j < most_few; ++j) value[j] = nodes[i + j].at_angle[a];
            const auto found = from_fewer(value, count);
            for (std::size_t j = 0; j < most_few; ++j) {
                worst = std::max(worst, std::abs(found[j] - value[j]) / std::max(value[j], floor_));
            }
        }
    }
    return worst;
}

/// At the odd ranges of a cubic through the even ones, under some of the angles.
double ScatteredPath::error_between_ranges(const std::vector<Node>& nodes,
                                           std::size_t ranges) const {
    double worst = 0.0;
    for (std::size_t j = 0; j < grid_.heights; ++j) {
        for (std::size_t a = 0; a < angles_; a += std::max<std::size_t>(1, angles_ / 8)) {
            const auto at = [&](std::size_t i) {
                return double{nodes[i * grid_.heights + j].at_angle[a]};
            };
            worst = std::max(
                worst, worst_between((ranges + 1) / 2, [&](std::size_t i) { return at(2 * i); },
                                     [&](std::size_t i) { return at(2 * i + 1); },
                                     [&](double right) { return std::max(right, floor_); }));
        }
    }
    return worst;
}

ScatteredPath::Towards ScatteredPath::towards(double angle_from_sun_deg,
                                              double zenith_cosine) const {
    const double step = (span_.most_deg - span_.least_deg) / double(angles_ - 1);
    const double x =
        std::clamp((angle_from_sun_deg - span_.least_deg) / step, 0.0, double(angles_ - 1));
    return {stencil(x, angles_), static_cast<float>(zenith_cosine)};
}

float ScatteredPath::operator()(const Towards& direction, float range, float height_km) const {
    const std::size_t heights = grid_.heights;
    const Stencil s =
        stencil(std::clamp(grid_.range_place(range), 0.0, double(grid_.ranges - 1)), grid_.ranges);
    const auto up = weights_of_few(grid_.height_place(height_km), heights);
    const auto& w = direction.angle.weight;
    float sum = 0.0f;
    for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t row = (s.start + k) * heights;
        for (std::size_t j = 0; j < heights; ++j) {
            const float* v = &at_angle_[(row + j) * angles_ + direction.angle.start];
            const float here = w[0] * v[0] + w[1] * v[1] + w[2] * v[2] + w[3] * v[3] +
                               direction.cosine * by_cosine_[row + j];
            sum += s.weight[k] * up[j] * here;
        }
    }
    return sum;
}

}  // namespace diurna
