#pragma once

#include <cstddef>
#include <vector>

#include "materials/atmosphere/sun_field.hpp"
#include "materials/radiation/band.hpp"
#include "render/path/sight_grid.hpp"

namespace diurna {

/// Sunlight scattered towards an observer by the air in front of a scene's points, in one band [W
/// m⁻² sr⁻¹]: a table over the nodes of a SightGrid and the angle between the line of sight and the
/// sun. The part that depends only on the line's slope is linear in its cosine (SunField) and has a
/// separate smaller table.
///
/// The spacings are halved until the error of scattered light half-way between the nodes is less
/// than `tolerance`.
class ScatteredPath {
 public:
    /// Range of the picture's angles from the sun.
    struct Angles {
        double least_deg = 0.0, most_deg = 180.0;
        double at(std::size_t k, std::size_t count) const {
            return least_deg + (most_deg - least_deg) * double(k) / double(count - 1);
        }
    };

    /// - field: of the band's nodes; must outlive the table, as must the band
    /// - tolerance: relative error of scattered radiance, or of a fiftieth of its largest value
    ScatteredPath(const SunField& field, const Band& band, const PathExtent& extent,
                  const Angles& angles, double tolerance = 8e-4);

    /// Table weights of a direction of sight.
    struct Towards {
        Stencil angle;
        float cosine;  // of its zenith angle
    };
    Towards towards(double angle_from_sun_deg, double zenith_cosine) const;

    /// range [m], height of the far end [km above the sea]
    float operator()(const Towards& direction, float range, float height_km) const;

    /// Estimated error, as `tolerance`.
    double error() const { return error_; }
    std::size_t ranges() const { return grid_.ranges; }
    std::size_t heights() const { return grid_.heights; }
    std::size_t angles() const { return angles_; }

 private:
    struct Node {
        std::vector<float> at_angle;  // (angle)
        float by_cosine = 0.0f;
    };
    Node make_node(double root, double height_km, std::size_t angles) const;
    void choose_angles(double tolerance);
    double error_of_fewer_heights(const std::vector<Node>& nodes, std::size_t count) const;
    double error_between_ranges(const std::vector<Node>& nodes, std::size_t ranges) const;

    const SunField& field_;
    const Band& band_;
    SightGrid grid_;
    Angles span_;
    double error_ = 0.0, floor_ = 0.0;
    std::size_t angles_ = 9;
    std::vector<float> at_angle_;   // (range, height, angle)
    std::vector<float> by_cosine_;  // (range, height)
};

}  // namespace diurna
