#include "scenes/studies/signature_aspects.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <utility>

namespace diurna {

namespace {

using Triangle = std::array<std::size_t, 3>;

/// One corner up, one down, two rings of five between at the latitudes ±atan(1/2).
std::vector<Eigen::Vector3d> icosahedron(std::vector<Triangle>& triangles) {
    std::vector<Eigen::Vector3d> corner{Eigen::Vector3d::UnitZ()};
    const double up = 1.0 / std::sqrt(5.0), out = 2.0 * up;
    for (int ring = 0; ring < 2; ++ring) {
        for (int i = 0; i < 5; ++i) {
            const double turn = 2.0 * std::numbers::pi * (i + 0.5 * ring) / 5.0;
            corner.emplace_back(out * std::sin(turn), out * std::cos(turn), ring == 0 ? up : -up);
        }
    }
    corner.emplace_back(-Eigen::Vector3d::UnitZ());
    for (std::size_t i = 0; i < 5; ++i) {
        const std::size_t next = (i + 1) % 5;
        triangles.push_back({0, 1 + i, 1 + next});
        triangles.push_back({1 + i, 6 + i, 1 + next});
        triangles.push_back({1 + next, 6 + i, 6 + next});
        triangles.push_back({11, 6 + next, 6 + i});
    }
    return corner;
}

}  // namespace

std::vector<Eigen::Vector3d> even_directions(int count) {
    std::vector<Triangle> triangles;
    std::vector<Eigen::Vector3d> corner = icosahedron(triangles);
    while (corner.size() < std::size_t(std::max(count, 0))) {
        std::map<std::pair<std::size_t, std::size_t>, std::size_t> halves;
        const auto half = [&](std::size_t a, std::size_t b) {
            const auto [at, added] = halves.try_emplace(std::minmax(a, b), corner.size());
            if (added) corner.push_back((corner[a] + corner[b]).normalized());
            return at->second;
        };
        std::vector<Triangle> finer;
        for (const auto& [a, b, c] : triangles) {
            const std::size_t ab = half(a, b), bc = half(b, c), ca = half(c, a);
            finer.push_back({a, ab, ca});
            finer.push_back({ab, b, bc});
            finer.push_back({ca, bc, c});
            finer.push_back({ab, bc, ca});
        }
        triangles = std::move(finer);
    }
    return corner;
}

}  // namespace diurna
