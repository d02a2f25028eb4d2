#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "terrain/facets.hpp"
#include "terrain/visibility/copies.hpp"

namespace diurna {

/// Sectors of the compass, counterclockwise from east, of 3.6 to 7.2 degrees each: uniform along
/// the square |east| + |north| = 1, so that no angle has to be computed.
inline constexpr std::size_t compass_sectors = 64;
/// 0 to 4 round the compass, counterclockwise from east.
inline float square_angle(float east, float north) {
    const float along = east / (std::abs(east) + std::abs(north));
    return north >= 0.0f ? 1.0f - along : 3.0f + along;
}
inline std::size_t compass_sector(float east, float north) {
    return std::min(static_cast<std::size_t>(square_angle(east, north) * (compass_sectors / 4)),
                    compass_sectors - 1);
}

/// By sector the tangent of an elevation angle; what is above it is open sky.
using OpenAbove = std::array<float, compass_sectors>;

/// Boxes around the objects of a scene, with which the ground that they cannot hide anything from
/// is found without rays. An object's facets are enclosed in one box, and in smaller ones of 64
/// facets each. All tests are conservative: they never miss an object.
class ObjectBoxes {
 public:
    /// Objects are the facets from `first_object` on, and copies.
    ObjectBoxes(const FacetSet& facets, std::size_t first_object, const Copies& copies = {});
    bool empty() const { return object_.empty(); }

    /// Raises the skyline to the tops of all boxes as seen from some facets; infinite within a box.
    ///
    /// - among: numbers of the objects that count
    void raise(const Eigen::AlignedBox3f& from, std::span<const std::uint32_t> among,
               OpenAbove& skyline) const;

    /// Objects so far from a box that they look alike from all of it, and the others.
    std::pair<std::vector<std::uint32_t>, std::vector<std::uint32_t>> far_and_near(
        const Eigen::AlignedBox3f& from) const;

    /// The objects that may hide a sun at `to_sun` (unit) or part of its disc from anywhere in a
    /// box.
    void shading(const Eigen::AlignedBox3f& from, const Eigen::Vector3f& to_sun,
                 std::span<const std::uint32_t> among, std::vector<std::uint32_t>& found) const;
    /// Whether any of their smaller boxes may.
    bool may_shade(const Eigen::AlignedBox3f& from, const Eigen::Vector3f& to_sun,
                   std::span<const std::uint32_t> among) const;

    std::size_t size() const { return object_.size(); }

 private:
    struct Object {
        Eigen::AlignedBox3f box;
        std::size_t first, last;  // its smaller boxes
    };
    std::vector<Object> object_;
    std::vector<Eigen::AlignedBox3f> part_;
};

/// The box around a facet.
Eigen::AlignedBox3f box_around(const FacetSet& facets, std::size_t facet);

}  // namespace diurna
