#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "terrain/facets.hpp"

/// A bowl cut from a sphere, its lowest point at the origin; the rim is `half_angle` away as seen
/// from the sphere's centre. Facets are small at the bottom and large at the rim.
inline diurna::FacetSet spherical_bowl(double radius, double half_angle, int rings, int sectors) {
    std::vector<Eigen::Vector3d> vertex;
    std::vector<std::array<std::uint32_t, 3>> triangle;
    for (int j = 0; j <= sectors; ++j) {
        for (int i = 0; i <= rings; ++i) {
            const double polar = half_angle * i / rings,
                         around = 2.0 * std::numbers::pi * j / sectors;
            vertex.emplace_back(radius * std::sin(polar) * std::cos(around),
                                radius * std::sin(polar) * std::sin(around),
                                radius * (1.0 - std::cos(polar)));
        }
    }
    for (int j = 0; j < sectors; ++j) {
        for (int i = 0; i < rings; ++i) {
            const auto a = static_cast<std::uint32_t>(j * (rings + 1) + i);
            const auto b = a + static_cast<std::uint32_t>(rings) + 1;
            triangle.push_back({a, a + 1, b + 1});
            triangle.push_back({a, b + 1, b});
        }
    }
    diurna::FacetSet facets;
    append_facets(facets, vertex, triangle, std::vector<diurna::MaterialId>(triangle.size()),
                  diurna::ObjectId{0});
    return facets;
}
