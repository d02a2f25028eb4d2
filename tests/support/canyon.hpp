#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "terrain/facets.hpp"
#include "terrain/visibility/ray_scene.hpp"
#include "terrain/visibility/reciprocity.hpp"
#include "terrain/visibility/view_factor_sampling.hpp"

/// A long straight canyon, and what is exact for an endless one.
namespace diurna::testing {

/// Floor and two walls as strips in the plane across, equally wide within each of the three.
struct CanyonSection {
    std::vector<Eigen::Vector2d> begin, end;  // (strip) across, up [m]
    std::vector<int> side;                    // (strip) 0 floor, 1 left wall, 2 right wall
    std::size_t size() const { return side.size(); }
    Eigen::Vector2d middle(std::size_t k) const { return 0.5 * (begin[k] + end[k]); }
};
inline CanyonSection canyon_section(double height, double width, int strips) {
    CanyonSection s;
    for (int side = 0; side < 3; ++side) {
        for (int k = 0; k < strips; ++k) {
            const double a = double(k) / strips, b = double(k + 1) / strips;
            const auto at = [&](double u) -> Eigen::Vector2d {
                if (side == 0) return {width * (u - 0.5), 0.0};
                return {side == 1 ? -0.5 * width : 0.5 * width, height * u};
            };
            s.begin.push_back(at(a));
            s.end.push_back(at(b));
            s.side.push_back(side);
        }
    }
    return s;
}

/// View factors between strips, crossed less uncrossed strings over twice the strip's width: Hottel
/// 1954; Modest, Radiative Heat Transfer, eq. 4.50.
inline Eigen::MatrixXd crossed_strings(const CanyonSection& s) {
    Eigen::MatrixXd factor = Eigen::MatrixXd::Zero(Eigen::Index(s.size()), Eigen::Index(s.size()));
    for (std::size_t i = 0; i < s.size(); ++i) {
        for (std::size_t j = 0; j < s.size(); ++j) {
            if (s.side[i] == s.side[j]) continue;
            const double same = (s.begin[i] - s.begin[j]).norm() + (s.end[i] - s.end[j]).norm();
            const double other = (s.begin[i] - s.end[j]).norm() + (s.end[i] - s.begin[j]).norm();
            factor(Eigen::Index(i), Eigen::Index(j)) =
                std::abs(same - other) / (2.0 * (s.end[i] - s.begin[i]).norm());
        }
    }
    return factor;
}

/// What falls on each strip, E = own + F (ρ E + sent), all bounces of it; `own` as a function of
/// the strip and of its view of the sky.
struct CanyonLight {
    CanyonSection section;
    Eigen::VectorXd incident;  // (strip)
    /// Mean over the strips of a side between two heights.
    double mean(int side, double low, double high) const {
        double sum = 0.0, count = 0.0;
        for (std::size_t k = 0; k < section.size(); ++k) {
            const double z = section.middle(k).y();
            if (section.side[k] != side || z < low || z > high) continue;
            sum += incident(Eigen::Index(k));
            count += 1.0;
        }
        return sum / count;
    }
};
template <class Own, class Reflectance, class Sent>
CanyonLight endless_canyon(double height, double width, const Own& own,
                           const Reflectance& reflectance, const Sent& sent) {
    const CanyonSection s = canyon_section(height, width, 100);
    const Eigen::MatrixXd factor = crossed_strings(s);
    const Eigen::Index n = factor.rows();
    Eigen::VectorXd light(n), emitted(n), rho(n);
    for (Eigen::Index k = 0; k < n; ++k) {
        light(k) = own(s.side[std::size_t(k)], 1.0 - factor.row(k).sum());
        emitted(k) = sent(s.side[std::size_t(k)]);
        rho(k) = reflectance(s.side[std::size_t(k)]);
    }
    const Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(n, n) - factor * rho.asDiagonal();
    return {s, matrix.partialPivLu().solve(light + factor * emitted)};
}

/// The same canyon 40 widths long, from south to north, in triangles: what is more than a quarter
/// of its length from the ends counts as endless.
struct LongCanyon {
    double height, width;
    FacetSet facets;
    std::vector<int> side;  // (facet) as in CanyonSection
    FacetViews views;

    /// - material: of floor and walls
    LongCanyon(double high, double wide, int rays, std::array<MaterialId, 2> material)
        : height(high), width(wide) {
        constexpr int segments = 40, across = 8;
        const int up = std::max(across, int(std::lround(across * high / wide)));
        for (int s = 0; s < 3; ++s) {
            const int strips = s == 0 ? across : up;
            std::vector<Eigen::Vector3d> vertex;
            std::vector<std::array<std::uint32_t, 3>> triangle;
            for (int k = 0; k <= strips; ++k) {
                for (int j = 0; j <= segments; ++j) {
                    const double u = double(k) / strips, y = (j - 0.5 * segments) * wide;
                    if (s == 0) {
                        vertex.emplace_back(wide * (u - 0.5), y, 0.0);
                    } else {
                        // Bottom up on the right, top down on the left: both face inwards.
                        vertex.emplace_back(s == 1 ? -0.5 * wide : 0.5 * wide, y,
                                            high * (s == 1 ? 1.0 - u : u));
                    }
                }
            }
            const auto row = std::uint32_t(segments + 1);
            for (std::uint32_t k = 0; k < std::uint32_t(strips); ++k) {
                for (std::uint32_t j = 0; j < std::uint32_t(segments); ++j) {
                    const std::uint32_t a = k * row + j;
                    triangle.push_back({a, a + row, a + row + 1});
                    triangle.push_back({a, a + row + 1, a + 1});
                }
            }
            append_facets(facets, vertex, triangle,
                          std::vector<MaterialId>(triangle.size(), material[s == 0 ? 0 : 1]),
                          ObjectId{0});
            side.resize(facets.size(), s);
        }
        views = facet_views(facets, RayScene(facets), {.rays = rays});
        make_reciprocal(facets, views);
    }

    /// Mean by area of what facets of a side between two heights have, of those far from the ends.
    template <class Value>
    double mean(int of_side, double low, double high, const Value& value) const {
        double sum = 0.0, area = 0.0;
        for (std::size_t f = 0; f < facets.size(); ++f) {
            const Eigen::Vector3f& c = facets.centroid[f];
            if (side[f] != of_side || std::abs(c.y()) > 10.0 * width) continue;
            if (c.z() < low || c.z() > high) continue;
            sum += double(facets.area[f]) * value(f);
            area += double(facets.area[f]);
        }
        return sum / area;
    }
};

}  // namespace diurna::testing
