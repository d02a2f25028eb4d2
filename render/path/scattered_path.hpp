#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "materials/atmosphere/sun_field.hpp"
#include "materials/radiation/band.hpp"
#include "render/light/radiance.hpp"
#include "render/path/path_table.hpp"
#include "render/view/observer.hpp"
#include "render/view/view.hpp"

namespace diurna {

/// Sunlight that the air scatters towards an observer before the places of a scene, in one band
/// [W m⁻² sr⁻¹]: a table over range, height of the far end, and angle between the line of sight and
/// the sun. The part that depends on the line's slope alone is linear in its cosine (SunField) and
/// has a smaller table beside it.
///
/// Cubic in range^⅓ and angle; a parabola, or of fourth degree, in height. The spacings are halved
/// until the scattered light errs by less than `tolerance` half-way between the nodes.
class ScatteredPath {
 public:
    /// Angles at which a picture looks, from the sun.
    struct Angles {
        double least_deg = 0.0, most_deg = 180.0;
    };

    /// segments   of every line (chord_segments), so that radiance is smooth over the table
    /// tolerance  of scattered radiance, as a share of it or of a fiftieth of its greatest value
    ScatteredPath(const SunField& field, const Band& band, const PathExtent& extent,
                  const Angles& angles, double tolerance = 8e-4);

    /// A direction of sight: what of the table it needs.
    struct Towards {
        Stencil angle;
        float cosine;  // of its zenith angle
    };
    Towards towards(double angle_from_sun_deg, double zenith_cosine) const;

    /// range [m], height of the far end [km above the sea]
    float operator()(const Towards& direction, float range, float height_km) const;

    /// Estimated error, as `tolerance`.
    double error() const { return error_; }
    std::size_t ranges() const { return ranges_; }
    std::size_t heights() const { return heights_; }
    std::size_t angles() const { return angles_; }

 private:
    struct Node {
        std::vector<float> at_angle;  // (angle)
        float by_cosine = 0.0f;
    };
    Node make_node(double root, double height_km, const std::vector<double>& angle_deg) const;
    void choose_angles();
    void choose_heights();
    void choose_ranges();
    std::vector<double> angle_nodes(std::size_t count) const;
    double root_at(std::size_t i, std::size_t count) const;
    double height_at(std::size_t j, std::size_t count) const;

    const SunField& field_;
    const Band& band_;
    PathExtent extent_;
    Angles span_;
    double tolerance_, error_ = 0.0, floor_ = 0.0;
    int segments_;
    double root_low_ = 0.0, root_high_ = 1.0;
    std::size_t ranges_ = 9, heights_ = 2, angles_ = 9;
    std::vector<float> at_angle_;   // (range, height, angle)
    std::vector<float> by_cosine_;  // (range, height)
};

/// Adds the sunlight that the air scatters before what every pixel sees to a plane [W m⁻² sr⁻¹].
/// Directions are those of the pixels' middles; a pixel whose sightings lie within 3 % of range is
/// looked up once, at their mean. Returns what the table was like, for the frame's notes.
std::string add_scattered_paths(const View& view, const Observer& observer,
                                const RadianceInput& input, const Band& band,
                                const SunField& scattered, const PathExtent& extent,
                                std::span<float> plane);

}  // namespace diurna
