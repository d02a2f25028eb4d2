#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <vector>

#include "terrain/facets.hpp"
#include "terrain/place/site.hpp"

/// Plates of all slopes on open ground and in a street, for sums over directions one by one.
namespace diurna::testing {

inline constexpr std::array<double, 4> tilt_deg = {0.0, 45.0, 90.0, 135.0};
inline constexpr double wall = 12.0, half_width = 6.0, plate_height = 2.0;

/// Small plates that lean to the south-west, high above ground or over the middle of a long street
/// that runs towards 30°.
struct Plates {
    FacetSet facets;
    std::array<std::size_t, 4> plate{};
    bool street;
    Eigen::Vector3d along = direction(30.0, 0.0), over = along.cross(Eigen::Vector3d::UnitZ());

    static Eigen::Vector3d normal(double tilt) { return direction(225.0, 90.0 - tilt); }

    explicit Plates(bool in_street) : street(in_street) {
        std::vector<Eigen::Vector3d> vertex;
        std::vector<std::array<std::uint32_t, 3>> triangle;
        const auto add = [&](Eigen::Vector3d at, Eigen::Vector3d u, Eigen::Vector3d v, bool whole) {
            const auto n = std::uint32_t(vertex.size());
            vertex.insert(vertex.end(), {at, at + u, at + u + v, at + v});
            triangle.push_back({n, n + 1, n + 2});
            if (whole) triangle.push_back({n, n + 2, n + 3});
        };
        const Eigen::Vector3d up(0.0, 0.0, wall);
        constexpr double far = 20e3;
        if (street) {
            add(half_width * over + far * along, -2.0 * far * along, up, true);
            add(-half_width * over - far * along, 2.0 * far * along, up, true);
        }
        for (std::size_t k = 0; k < tilt_deg.size(); ++k) {
            const Eigen::Vector3d n = normal(tilt_deg[k]), u = direction(135.0, 0.0),
                                  v = n.cross(u);
            add(8.0 * double(k) * along + Eigen::Vector3d(0.0, 0.0, plate_height), 0.01 * u,
                0.01 * v, false);
        }
        append_facets(facets, vertex, triangle, std::vector<MaterialId>(triangle.size()),
                      ObjectId{0});
        for (std::size_t f = 0; f < facets.size(); ++f) {
            if (facets.area[f] > 1.0f) continue;
            plate[std::size_t(std::lround(facets.centroid[f].cast<double>().dot(along) / 8.0))] = f;
        }
    }

    /// 1/π ∫ L cosθ dω over the open sky of a plate.
    double sum(double tilt, const std::function<double(const Eigen::Vector3d&)>& radiance) const {
        constexpr int rings = 400, sectors = 720;
        const Eigen::Vector3d n = normal(tilt);
        double sum = 0.0;
        for (int i = 0; i < rings; ++i) {
            const double t = (i + 0.5) / rings, z = t * t, r = std::sqrt(1.0 - z * z);
            for (int j = 0; j < sectors; ++j) {
                const double a = 2.0 * std::numbers::pi * (j + 0.5) / sectors;
                const Eigen::Vector3d way(r * std::cos(a), r * std::sin(a), z);
                const bool open =
                    !street || z * half_width > std::abs(way.dot(over)) * (wall - plate_height);
                const double cosine = n.dot(way);
                if (open && cosine > 0.0) sum += radiance(way) * cosine * 2.0 * t;
            }
        }
        return sum * 2.0 / (double(rings) * sectors);
    }
};

}  // namespace diurna::testing
