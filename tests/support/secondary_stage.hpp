#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <utility>
#include <vector>

#include "materials/base/units.hpp"
#include "render/light/incident_light.hpp"
#include "render/rays/follow_rays.hpp"
#include "render/rays/secondary_light.hpp"
#include "render/rays/secondary_radiance.hpp"
#include "render/view/cast_view.hpp"
#include "terrain/place/site.hpp"
#include "terrain/visibility/view_factor_sampling.hpp"
#include "tests/support/render_scene.hpp"

namespace diurna {

/// A wall to the north, 40 m wide and high, with something in front of it; the eye stands at the
/// origin, the air is none and space is cold.
struct SecondaryStage {
    FacetSet facets;
    std::vector<Material> all;
    std::vector<Plume> plumes;
    std::vector<float> temperature, sun;
    Atmosphere air = Vacuum{.space_temperature = 3.0};
    double ground_km = 0.3;
    double wind_speed = 3.0;
    Eigen::Vector3d to_sun = direction(200.0, 40.0);

    /// An upright rectangle across the line of sight, `north` metres away, that faces south.
    void wall(double north, double half, Material material, float kelvins,
              bool faces_south = true) {
        rectangle({{-half, north, -half},
                   {half, north, -half},
                   {half, north, half},
                   {-half, north, half}},
                  std::move(material), kelvins, faces_south);
    }
    void rectangle(std::vector<Eigen::Vector3d> corner, Material material, float kelvins,
                   bool as_given = true) {
        std::vector<std::array<std::uint32_t, 3>> triangle = {{0, 1, 2}, {0, 2, 3}};
        if (!as_given) triangle = {{0, 2, 1}, {0, 3, 2}};
        material.name += std::to_string(all.size());  // a library holds a name once
        all.push_back(std::move(material));
        append_facets(facets, corner, triangle,
                      std::vector<MaterialId>(2, MaterialId{std::uint16_t(all.size() - 1)}),
                      ObjectId{0});
        temperature.resize(facets.size(), kelvins);
    }
    void plume(double north, double thickness, double absorption, double kelvins) {
        Plume box{.name = "gas",
                  .vertex = {},
                  .triangle = {},
                  .absorption = flat_spectrum(absorption),
                  .temperature = kelvins};
        for (const double up : {-5.0, 5.0}) {
            for (const auto& [x, y] :
                 {std::pair{-5.0, 0.0}, {5.0, 0.0}, {5.0, thickness}, {-5.0, thickness}}) {
                box.vertex.emplace_back(x, north + y, up);
            }
        }
        box.triangle = {{0, 1, 5}, {0, 5, 4}, {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6},
                        {3, 0, 4}, {3, 4, 7}, {4, 5, 6}, {4, 6, 7}, {0, 2, 1}, {0, 3, 2}};
        plumes.push_back(std::move(box));
    }

    struct Seen {
        SecondaryRays secondary_rays;
        View view;
        std::vector<std::vector<float>> planes;  // (term)
        std::vector<double> reference;           // (every 41st pixel of the secondary rays)
        double at(std::size_t pixel) const {
            double sum = 0.0;
            for (const auto& plane : planes) sum += double{plane[pixel]};
            return sum;
        }
    };
    Observer observer(int size = 5, double fov_deg = 2.0) const {
        Observer eye;
        eye.horizontal_fov_deg = fov_deg;
        eye.width = eye.height = size;
        return eye;
    }
    Seen look(const Observer& eye, const Band& band, int samples = 16,
              bool with_reference = false) {
        const RayScene scene(facets);
        const MaterialLibrary materials(all);
        const FacetViews sky = facet_views(facets, scene, {.rays = 64});
        Seen seen;
        seen.view = cast_view(scene, facets, eye, {.samples = samples});
        const PlumeScene volumes(plumes);
        const SecondaryScene place{.rays = scene,
                                   .facets = facets,
                                   .materials = materials,
                                   .plumes = volumes,
                                   .wind_speed = wind_speed};
        seen.secondary_rays = follow_rays(seen.view, place, eye, {.samples = samples});
        const RadianceInput input{.facets = facets,
                                  .views = sky,
                                  .materials = materials,
                                  .atmosphere = air,
                                  .temperature = temperature,
                                  .sun_fraction = sun,
                                  .to_sun = to_sun,
                                  .sun_zenith_deg = degrees(std::acos(to_sun.z())),
                                  .ground_height_km = ground_km,
                                  .wind_speed = wind_speed};
        seen.planes.assign(term_count, std::vector<float>(seen.view.pixels(), 0.0f));
        const SecondaryLight light(seen.secondary_rays, plumes, {&band, 1}, input);
        light.add(seen.planes);
        if (with_reference) {
            const auto scattered = scattered_sun(input, band.node_um);
            for (std::size_t k = 0; k < seen.secondary_rays.pixel.size(); k += 41) {
                seen.reference.push_back(secondary_radiance(seen.secondary_rays, k, plumes, band,
                                                            input,
                                                            scattered ? &*scattered : nullptr));
            }
        }
        return seen;
    }
};

inline Material plain(double reflectance) {
    return testing::material("wall", flat_spectrum(reflectance));
}

inline Material pane(double reflectance, double transmittance, Finish finish = Lambert{}) {
    Material material =
        testing::material("pane", flat_spectrum(reflectance), flat_spectrum(transmittance));
    material.see_through = true;
    material.finish = std::move(finish);
    return material;
}

inline Material metal(double reflectance, double roughness) {
    Material material = testing::material("metal", flat_spectrum(reflectance));
    material.finish = Glossy{.roughness = roughness, .metal = true, .index = {}, .extinction = {}};
    return material;
}

inline const Band lwir = flat_band("8-12", 8.0, 12.0, bin_edges_um());
inline const Band mwir = flat_band("3-5", 3.0, 5.0, bin_edges_um());

}  // namespace diurna
