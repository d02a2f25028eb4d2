#pragma once

#include <array>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <span>
#include <vector>

#include "materials/atmosphere/onward_light.hpp"
#include "render/light/band_light.hpp"
#include "render/path/sight_grid.hpp"

namespace diurna {

/// Transmittance and radiance of the air between an observer and the places of a scene, at the
/// nodes of a SightGrid.
///
/// Products with the light leaving a surface are to be formed at the nodes, in channels, and then
/// interpolated: the radiance at the eye is smooth over the grid, and exact at its nodes.
///
/// Transmittance depends on the origin of light: sunlight and the sky's thermal light have passed
/// air before (materials/atmosphere/onward_light.hpp), on the path to a place at the node's height.
class PathTable {
 public:
    /// Halves the spacing until interpolation of the radiance of every probe through the air has an
    /// error below `tolerance` [K] of apparent temperature in every band, as estimated from the
    /// nodes added by the last halving.
    ///
    /// - bands: their channels and probes; must outlive the table
    PathTable(const RadianceInput& input, const PathExtent& extent,
              std::span<const BandLight> bands, double tolerance);

    const SightGrid& grid() const { return grid_; }
    std::size_t nodes() const { return grid_.ranges * grid_.heights; }

    /// Transmittance to a node (range, height) in the channels of a band (padded).
    const float* transmittance(std::size_t band, std::size_t node,
                               Origin origin = Origin::surface) const {
        return node_[node].transmittance[band][static_cast<std::size_t>(origin)].data();
    }
    /// Radiance of the air before it in these channels.
    const float* channel_radiance(std::size_t band, std::size_t node) const {
        return node_[node].channel_radiance[band].data();
    }
    /// Radiance in the whole band.
    float radiance(std::size_t band, std::size_t node) const { return node_[node].radiance[band]; }
    /// Estimated error of interpolation [K] of apparent temperature.
    double error(std::size_t band) const { return error_[band]; }

 private:
    struct Node {
        std::vector<std::array<std::vector<float>, origin_count>> transmittance;  // (band)
        std::vector<float> radiance;                                              // (band)
        std::vector<std::vector<float>> channel_radiance;                         // (band)(channel)
        std::vector<Amounts> met;  // (band) on the path, until the sky's heat is known
    };
    Node make_node(double root, double height_km) const;
    double probe_value(std::size_t band, const Node& node, std::size_t probe) const;
    double error_of_fewer(std::size_t band, std::span<const Node> nodes, std::size_t count) const;
    double error_between(std::size_t band, std::span<const Node> nodes, std::size_t ranges) const;

    /// Error [K] half-way between the lowest and the highest of a few ranges' heights.
    double error_in_middle(std::size_t band, std::span<const Node> nodes) const;

    /// Prepares these of the five heights.
    void prepare(std::initializer_list<std::size_t> heights);
    std::size_t place(std::size_t band, double height_km) const;
    void set_sky_heat();
    void set_sky_heat(double root, double height_km, Node& node) const;

    const RadianceInput& input_;
    std::span<const BandLight> bands_;
    SightGrid grid_;
    std::vector<std::optional<OnwardLight>> onward_;  // (band, height of five); empty: not needed
    std::vector<Node> node_;                          // (range, height)
    std::vector<double> error_;                       // (band)
};

}  // namespace diurna
