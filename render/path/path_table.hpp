#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "materials/radiation/band.hpp"
#include "render/light/band_channels.hpp"
#include "render/light/radiance.hpp"

namespace diurna {

/// Weights of the four nodes start .. start + 3 of a uniform grid for the place x nodes after its
/// beginning: cubic Lagrange.
struct Stencil {
    std::size_t start = 0;
    std::array<float, 4> weight{};
};
Stencil stencil(double x, std::size_t nodes);

/// What the nodes' values come to at the place x.
double interpolated(std::span<const double> value, double x);

/// Range and height of what an observer sees.
struct PathExtent {
    double observer_height_km = 0.0;  // above the sea, as the heights below
    double least_range_km = 0.0, most_range_km = 0.0;
    double least_height_km = 0.0, most_height_km = 0.0;
};

/// Transmittance and radiance of the air between an observer and the places of a scene, at the
/// nodes of a grid: uniform in range^⅓ (bands of saturated lines grow with the root of range, so
/// that nodes crowd near the eye) and in height of the far end.
///
/// Products with what leaves a surface are to be formed at the nodes, in channels, and those
/// interpolated: the eye's radiance is smooth over the grid, and exact at its nodes.
class PathTable {
 public:
    /// Halves the spacing until interpolation of the radiance of every probe, carried through the
    /// air, errs by less than `tolerance` [K] of apparent temperature in every band, as far as
    /// can be told from the nodes that the last halving added.
    ///
    /// probe  (band)(probe) radiance in the band's channels that stands for the scene's surfaces
    PathTable(const Atmosphere& atmosphere, const PathExtent& extent, std::span<const Band> bands,
              std::span<const Channels> channels,
              std::span<const std::vector<std::vector<float>>> probe, double tolerance);

    std::size_t ranges() const { return ranges_; }
    std::size_t heights() const { return heights_; }
    /// Nodes and weights for a range [m] and a height [km above the sea].
    Stencil range_stencil(float range) const;
    /// Place of a range [km, its cube root] on the grid, and places per unit of it.
    double place(double range_root) const { return (range_root - u_low_) * places_per_root(); }
    double places_per_root() const { return double(ranges_ - 1) / (u_high_ - u_low_); }
    /// The lowest of its heights [km above the sea], and how many of their steps a kilometre holds.
    double least_height_km() const { return extent_.least_height_km; }
    double places_per_height_km() const {
        return double(heights_ - 1) / (extent_.most_height_km - extent_.least_height_km);
    }
    /// Weights of the heights (two, three or five of them).
    std::array<float, 5> height_weights(float height_km) const;

    /// Transmittance to a node in the channels of a band (padded), and radiance of the air.
    const float* transmittance(std::size_t band, std::size_t range, std::size_t height) const;
    float radiance(std::size_t band, std::size_t range, std::size_t height) const;
    /// That radiance in the channels of the band (padded).
    const float* air(std::size_t band, std::size_t range, std::size_t height) const;
    /// Estimated error of interpolation [K] of apparent temperature.
    double error(std::size_t band) const { return error_[band]; }

 private:
    struct Node {
        std::vector<std::vector<float>> transmittance;  // (band)(channel)
        std::vector<float> radiance;                    // (band)
        std::vector<std::vector<float>> air;            // (band)(channel)
    };
    Node make_node(double u, double height_km) const;
    double probe_value(std::size_t band, const Node& node, std::size_t probe) const;
    void choose_heights();
    void choose_ranges();
    double height_at(std::size_t j, std::size_t count) const;
    double u_at(std::size_t i, std::size_t count) const;

    const Atmosphere& atmosphere_;
    PathExtent extent_;
    std::span<const Band> bands_;
    std::span<const Channels> channels_;
    std::span<const std::vector<std::vector<float>>> probe_;
    double tolerance_;
    int segments_;  // of every line, so that radiance is smooth over the grid
    double u_low_ = 0.0, u_high_ = 0.0;
    std::size_t ranges_ = 0, heights_ = 1;
    std::vector<Node> node_;     // (range, height)
    std::vector<double> error_;  // (band)
};

}  // namespace diurna
