#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "render/tracer.hpp"
#include "render/view/cast_view.hpp"
#include "render/view/pixel_rays.hpp"
#include "render/view/pixel_sun.hpp"
#include "terrain/place/site.hpp"
#include "terrain/visibility/sun_fraction.hpp"
#include "tests/support/render_scene.hpp"

/// A box on level ground in the sun, and the outline of its shadow from the sun's direction alone.
namespace diurna::testing {

inline const Band near_infrared = flat_band("0.7-1.0", 0.7, 1.0, bin_edges_um());
inline const Eigen::Vector3d box_half(2.5, 1.25, 3.0);  // [m] of the box in plan; its height

/// Whether a ray from a place on the ground meets the box: the slabs between its walls.
inline bool meets_box(const Eigen::Vector3d& place, const Eigen::Vector3d& towards) {
    double first = 0.0, last = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        const double low = axis == 2 ? 0.0 : -box_half[axis], high = box_half[axis];
        const double a = (low - place[axis]) / towards[axis],
                     b = (high - place[axis]) / towards[axis];
        first = std::max(first, std::min(a, b));
        last = std::min(last, std::max(a, b));
    }
    return first < last;
}

/// A black box on grey ground of triangles of `edge` [m], without air.
struct BoxStage {
    FacetSet facets;
    std::size_t ground = 0;  // facets of it
    std::vector<float> temperature, fraction;
    MaterialLibrary materials{
        {material("ground", flat_spectrum(0.4)), material("box", flat_spectrum(0.0))}};
    Eigen::Vector3d to_sun;
    double elevation;
    int sun_samples = 4;  // a facet
    Observer eye;

    BoxStage(double edge, double sun_elevation_deg, bool with_box = true)
        : to_sun(direction(205.0, sun_elevation_deg)), elevation(sun_elevation_deg) {
        std::vector<Eigen::Vector3d> vertex;
        std::vector<std::array<std::uint32_t, 3>> triangle;
        const int n = static_cast<int>(60.0 / edge);
        const auto row = static_cast<std::uint32_t>(n + 1);
        for (int j = 0; j <= n; ++j) {
            for (int i = 0; i <= n; ++i) {
                vertex.emplace_back(edge * i - 30.0 + 0.13 * edge, edge * j - 30.0, 0.0);
            }
        }
        for (std::uint32_t j = 0; j + 1 < row; ++j) {
            for (std::uint32_t i = 0; i + 1 < row; ++i) {
                const std::uint32_t k = j * row + i;
                triangle.push_back({k, k + 1, k + row + 1});
                triangle.push_back({k, k + row + 1, k + row});
            }
        }
        append_facets(facets, vertex, triangle,
                      std::vector<MaterialId>(triangle.size(), MaterialId{0}), ObjectId{0});
        ground = facets.size();
        if (with_box) add_box();
        temperature.assign(facets.size(), 3.0f);
        eye.position = {24.0, 14.0, 24.0};
        eye.width = 320;
        eye.height = 256;
        eye.horizontal_fov_deg = 34.0;
        eye = looking_at(eye, {1.0, 3.0, 0.0});
    }
    void add_box() {
        std::vector<Eigen::Vector3d> vertex;
        for (const double z : {0.0, box_half.z()}) {
            for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
                vertex.emplace_back(x * box_half.x(), y * box_half.y(), z);
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
                      std::vector<MaterialId>(10, MaterialId{1}), ObjectId{1});
    }

    struct Picture {
        View view;
        PixelSun sun;
        std::vector<float> by_facet, by_pixel;  // radiance
    };
    Picture picture() {
        const RayScene rays(facets);
        fraction.resize(facets.size());
        sun_fraction(facets, rays, to_sun, fraction, {.samples = sun_samples});
        const ViewOptions options{.samples = 16};
        Picture out{.view = cast_view(rays, facets, eye, options),
                    .sun = {},
                    .by_facet = {},
                    .by_pixel = {}};
        out.sun = cast_pixel_sun(out.view, {rays, facets, fraction, to_sun}, eye, options);
        const Atmosphere none = Vacuum{.space_temperature = 3.0};
        FacetViews views;
        views.sky.assign(facets.size(), 1.0f);
        views.below.assign(facets.size(), 0.0f);
        views.others.row.assign(facets.size() + 1, 0);
        const RadianceInput input{.facets = facets,
                                  .views = views,
                                  .materials = materials,
                                  .atmosphere = none,
                                  .temperature = temperature,
                                  .sun_fraction = fraction,
                                  .to_sun = to_sun,
                                  .sun_zenith_deg = 90.0 - elevation};
        const auto radiance = [&](const PixelSun* sun) {
            return render(out.view, eye, {&near_infrared, 1}, input,
                          {.pixel_sun = sun})["radiance." + near_infrared.name]
                .pixel;
        };
        out.by_facet = radiance(nullptr);
        out.by_pixel = radiance(&out.sun);
        return out;
    }
};

/// Intersection over union of what is darker than half the lit ground with where the sun's ray
/// meets the box, over pixels that see ground alone.
inline double overlap(const BoxStage& stage, const View& view, const std::vector<float>& radiance) {
    const PixelRays rays = pixel_rays(stage.eye);
    const float lit = *std::max_element(radiance.begin(), radiance.end());
    std::size_t both = 0, either = 0;
    for (std::size_t p = 0; p < view.pixels(); ++p) {
        bool plain = view.sky[p] == 0.0f;
        for (std::uint32_t k = view.row[p]; k < view.row[p + 1]; ++k) {
            plain = plain && index(view.surface[view.sighting[k].target]) < stage.ground;
        }
        if (!plain) continue;
        int shaded = 0;
        for (int s = 0; s < 64; ++s) {
            const Eigen::Vector3d towards =
                rays.towards(double(p % std::size_t(view.width)) + (s % 8 + 0.5) / 8.0,
                             double(p / std::size_t(view.width)) + (s / 8 + 0.5) / 8.0);
            const double range = -stage.eye.position.z() / towards.z();
            shaded += meets_box(stage.eye.position + range * towards, stage.to_sun);
        }
        const bool expected = shaded >= 32, found = radiance[p] < 0.5f * lit;
        both += expected && found;
        either += expected || found;
    }
    return double(both) / double(either);
}

}  // namespace diurna::testing
