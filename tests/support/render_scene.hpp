#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "materials/atmosphere/atmosphere.hpp"
#include "materials/matter/library.hpp"
#include "render/light/radiance_input.hpp"
#include "render/view/observer.hpp"
#include "render/view/view.hpp"
#include "terrain/facets.hpp"
#include "terrain/visibility/ray_scene.hpp"

/// A small world for the renderer's tests, made by hand: hills with valleys, and a box of metal
/// and glass that stands in front of the camera.
namespace diurna::testing {

inline Material material(std::string name, Spectrum reflectance, Spectrum transmittance = {}) {
    Material m;
    m.name = std::move(name);
    m.reflectance = std::move(reflectance);
    m.transmittance = std::move(transmittance);
    return m;
}

enum Kind : std::uint16_t { soil, metal, glass, paint };

/// Reflectances that vary within the bands; the glass shows a room of `room` [K] below 5 µm.
inline MaterialLibrary materials(double room) {
    std::vector<Material> all;
    all.push_back(material("soil", {{0.2, 3.0, 4.0, 5.0, 8.0, 9.2, 10.0, 12.0, 20.0},
                                    {0.3, 0.25, 0.2, 0.15, 0.08, 0.15, 0.05, 0.03, 0.03}}));
    all.push_back(material("metal", flat_spectrum(0.9)));
    all.push_back(material("glass", {{0.2, 8.0, 9.5, 11.0, 20.0}, {0.06, 0.05, 0.25, 0.1, 0.1}},
                           {{0.2, 2.7, 3.5, 4.6, 5.0, 20.0}, {0.8, 0.75, 0.4, 0.1, 0.0, 0.0}}));
    all.back().thermal.bottom = Interior{room, 3.0};
    all.push_back(material("paint", {{0.2, 20.0}, {0.6, 0.02}}));
    return MaterialLibrary(std::move(all));
}

inline double hills(double x, double y) {
    const double k = 2.0 * std::numbers::pi / 1500.0;
    return 120.0 * std::sin(k * x) * std::cos(0.8 * k * y) + 0.03 * y;
}

/// Hills of (2 · half)² squares of `step` [m] about the origin, and a box of 20 m × 12 m × 8 m.
inline FacetSet hilly_world(int half = 24, double step = 80.0) {
    FacetSet facets;
    std::vector<Eigen::Vector3d> vertex;
    std::vector<std::array<std::uint32_t, 3>> triangle;
    const int n = 2 * half + 1;
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
            const double x = (i - half) * step, y = (j - half) * step;
            vertex.emplace_back(x, y, hills(x, y));
        }
    }
    for (int j = 0; j + 1 < n; ++j) {
        for (int i = 0; i + 1 < n; ++i) {
            const auto a = static_cast<std::uint32_t>(j * n + i);
            const auto up = static_cast<std::uint32_t>(n);
            triangle.push_back({a, a + 1, a + up + 1});
            triangle.push_back({a, a + up + 1, a + up});
        }
    }
    const std::vector<MaterialId> ground(triangle.size(), MaterialId{soil});
    append_facets(facets, vertex, triangle, ground, ObjectId{0});

    const double z = hills(0.0, 0.0) - 2.0;
    vertex.clear();
    for (const double up : {z, z + 10.0}) {
        for (const auto& [x, y] : {std::pair{-10., -6.}, {10., -6.}, {10., 6.}, {-10., 6.}}) {
            vertex.emplace_back(x, y, up);
        }
    }
    append_facets(facets, vertex,
                  std::vector<std::array<std::uint32_t, 3>>{{0, 1, 5},
                                                            {0, 5, 4},
                                                            {1, 2, 6},
                                                            {1, 6, 5},
                                                            {2, 3, 7},
                                                            {2, 7, 6},
                                                            {3, 0, 4},
                                                            {3, 4, 7},
                                                            {4, 5, 6},
                                                            {4, 6, 7}},
                  std::vector<MaterialId>{MaterialId{glass}, MaterialId{glass}, MaterialId{paint},
                                          MaterialId{paint}, MaterialId{paint}, MaterialId{paint},
                                          MaterialId{paint}, MaterialId{paint}, MaterialId{metal},
                                          MaterialId{metal}},
                  ObjectId{1});
    return facets;
}

/// South of the box, looking north over it at hills and sky.
inline Observer hilly_observer(int width = 64, int height = 48) {
    Observer observer;
    observer.name = "south";
    observer.position = {15.0, -120.0, hills(15.0, -120.0) + 25.0};
    observer = looking_at(observer, {0.0, 0.0, hills(0.0, 0.0) + 8.0});
    observer.horizontal_fov_deg = 40.0;
    observer.width = width;
    observer.height = height;
    return observer;
}

}  // namespace diurna::testing
