#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace diurna {

/// The sun of the hours before a picture, for temperatures within facets: a place that a shadow has
/// just left is still cold. Each material weighs past instants by how much of a flux at that time
/// is left in its surface (thermal/column/step_response.hpp) and by the sun's strength then.
struct PastSun {
    static constexpr std::size_t quantiles = 64;
    /// Unit vectors to the sun at instants of equal weight, the latest first.
    using Course = std::array<Eigen::Vector3d, quantiles>;
    std::vector<Course> course;
    /// (facet) Number of its course; `at_once`: its surface follows the present sun.
    std::vector<std::uint8_t> of_facet;
    static constexpr std::uint8_t at_once = 255;
    /// (facet) Share of the sun over those instants, 0 to 1; the present share where `at_once`.
    std::vector<float> share;

    /// - place: 0 to 1, share of the weight of later instants
    const Eigen::Vector3d& towards(std::size_t of, double place) const {
        const auto k = static_cast<std::size_t>(place * double(quantiles));
        return course[of][k < quantiles ? k : quantiles - 1];
    }
};

}  // namespace diurna
