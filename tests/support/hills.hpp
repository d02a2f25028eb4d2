#pragma once

#include <cmath>
#include <vector>

#include "terrain/facets.hpp"
#include "terrain/visibility/ray_scene.hpp"
#include "terrain/visibility/sun_fraction.hpp"
#include "thermal/solve/solver.hpp"

/// Rolling ground of `n` × `n` cells of two triangles, 30 m apart, 60 m from valley to ridge; the
/// materials by turns.
inline diurna::FacetSet hills(int n, const std::vector<diurna::MaterialId>& materials) {
    std::vector<Eigen::Vector3d> vertex;
    std::vector<std::array<std::uint32_t, 3>> triangle;
    std::vector<diurna::MaterialId> material;
    for (int j = 0; j <= n; ++j) {
        for (int i = 0; i <= n; ++i) {
            const double x = 30.0 * i, y = 30.0 * j;
            vertex.emplace_back(x - 15.0 * n, y - 15.0 * n,
                                30.0 * std::sin(x / 80.0) * std::cos(y / 110.0));
        }
    }
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
            const auto v = static_cast<std::uint32_t>(j * (n + 1) + i);
            const auto up = static_cast<std::uint32_t>(v + n + 1);
            triangle.push_back({v, v + 1, up + 1});
            triangle.push_back({v, up + 1, up});
            const auto m = materials[std::size_t(i / 4 + j / 4) % materials.size()];
            material.push_back(m);
            material.push_back(m);
        }
    }
    diurna::FacetSet facets;
    diurna::append_facets(facets, vertex, triangle, material, diurna::ObjectId{0});
    return facets;
}

/// Who is in the sun at each step of a solve.
inline diurna::SunExposure shadows(const diurna::FacetSet& facets, const diurna::RayScene& rays,
                                   const diurna::Site& site, const diurna::SolveOptions& options) {
    diurna::SunExposure sun{.instant = diurna::step_instants(options), .fraction = {}};
    sun.fraction.resize(sun.instant.size() * facets.size());
    for (std::size_t i = 0; i < sun.instant.size(); ++i) {
        diurna::sun_fraction(facets, rays,
                             diurna::sun_direction(diurna::sun_position(site, sun.instant[i])),
                             std::span(sun.fraction).subspan(i * facets.size(), facets.size()));
    }
    return sun;
}
