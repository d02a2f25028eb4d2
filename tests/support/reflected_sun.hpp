#pragma once

#include <array>
#include <vector>

#include "materials/atmosphere/onward_light.hpp"
#include "tests/support/lowtran_rows.hpp"

/// LOWTRAN7's sunlight that goes down to the ground and up to an eye, and its repetition here.
namespace lowtran {

/// A picture of sunlit ground that LOWTRAN7 has run: its transmittance down and up again.
struct Reflection {
    const char *profile, *aerosol;
    double eye_km, view_zenith_deg, sun_zenith_deg;
    std::array<double, 3> both_ways;  // 0.4-0.7, 0.7-1.0, 1.5-1.8 µm
};

// LOWTRAN7 rev 4.2, sunlight that ground of albedo 0.2 reflects straight to an eye above, day 94,
// over the same without air, by its own sun (20 cm⁻¹, trapezia over the band).
inline constexpr Reflection reflections[] = {
    {"TROP", "R23", 1, 180, 30, {0.4926, 0.5714, 0.7405}},
    {"TROP", "R23", 1, 120, 60, {0.2901, 0.4076, 0.6328}},
    {"TROP", "R23", 10, 180, 60, {0.2573, 0.3858, 0.6233}},
    {"TROP", "R23", 10, 120, 30, {0.2527, 0.3744, 0.6137}},
    {"TROP", "R05", 1, 180, 30, {0.0984, 0.2055, 0.5109}},
    {"TROP", "R05", 10, 180, 30, {0.0634, 0.1538, 0.4542}},
    {"TROP", "M23", 1, 180, 30, {0.4961, 0.5178, 0.6177}},
    {"TROP", "M23", 1, 120, 60, {0.2909, 0.3408, 0.4552}},
    {"TROP", "M23", 10, 180, 60, {0.2569, 0.3238, 0.4516}},
    {"TROP", "M23", 10, 120, 30, {0.2523, 0.3113, 0.4370}},
    {"US76", "R23", 1, 180, 30, {0.4937, 0.6243, 0.8081}},
    {"US76", "R23", 1, 120, 60, {0.2908, 0.4566, 0.7133}},
    {"US76", "R23", 10, 180, 60, {0.2579, 0.4326, 0.7033}},
    {"US76", "R23", 10, 120, 30, {0.2537, 0.4207, 0.6948}},
    {"US76", "R05", 1, 180, 30, {0.0989, 0.2274, 0.5629}},
    {"US76", "R05", 10, 180, 30, {0.0638, 0.1725, 0.5080}},
    {"US76", "M23", 1, 180, 30, {0.4969, 0.5738, 0.6981}},
    {"US76", "M23", 1, 120, 60, {0.2915, 0.3917, 0.5469}},
    {"US76", "M23", 10, 180, 60, {0.2575, 0.3722, 0.5423}},
    {"US76", "M23", 10, 120, 30, {0.2532, 0.3590, 0.5284}},
};

/// Errors of a band, the b-th of those above, both ways taken for one path; and of the product of
/// their transmittances.
struct ReflectedSun {
    Errors joined, product;
};
inline ReflectedSun compare_reflected_sun(const Band& band, std::size_t b) {
    ReflectedSun errors;
    const auto sum = [&](const std::vector<double>& light, const std::vector<double>& share) {
        double total = 0.0;
        for (std::size_t n = 0; n < light.size(); ++n) {
            total += band.weight[n] * light[n] * share[n];
        }
        return total;
    };
    for (const Reflection& row : reflections) {
        const BandModel air = model_of(row.profile, row.aerosol);
        const Atmosphere through = air;
        const SightLine down = line_of(air, row.eye_km, row.view_zenith_deg);
        const auto sun = solar_at_nodes(through, 0.0, row.sun_zenith_deg, 1.0, band.node_um);
        const auto way = OnwardLight(through, 0.0, row.sun_zenith_deg, band.node_um).way(down);
        const double above = band_sum_nodes(
            band, solar_at_nodes(Vacuum{}, 0.0, row.sun_zenith_deg, 1.0, band.node_um));
        errors.joined.add(sum(sun, way.sunlight) / above, row.both_ways[b]);
        errors.product.add(sum(sun, way.path.transmittance) / above, row.both_ways[b]);
    }
    return errors;
}

}  // namespace lowtran
