#include "render/view/sky_angles.hpp"

#include <cmath>
#include <numbers>

#include "materials/base/units.hpp"

namespace diurna {

namespace {

constexpr std::size_t lanes = RayBundles::lanes;
constexpr float degree = 180.0f / std::numbers::pi_v<float>;

/// Angle of (x, y) from the x axis [rad], −π to π.
inline float angle(float x, float y) {
    const float a = std::abs(x), b = std::abs(y);
    const float small = a < b ? a : b, large = a < b ? b : a;
    const float t = small / (large > 1e-30f ? large : 1e-30f), u = t * t;
    float p = 0.0028662257f;
    p = p * u - 0.0161657367f;
    p = p * u + 0.0429096138f;
    p = p * u - 0.0752896400f;
    p = p * u + 0.1065626393f;
    p = p * u - 0.1420889944f;
    p = p * u + 0.1999355085f;
    p = p * u - 0.3333314528f;
    const float first = t + t * u * p;  // octant
    const float quarter = a < b ? 0.5f * std::numbers::pi_v<float> - first : first;
    const float half = x < 0.0f ? std::numbers::pi_v<float> - quarter : quarter;
    return y < 0.0f ? -half : half;
}

}  // namespace

void sky_angles(const SkyDirections& directions, double axis_azimuth_deg,
                std::vector<float>& zenith_deg, std::vector<float>& azimuth_deg) {
    const std::size_t n = directions.size();
    zenith_deg.resize(n);
    azimuth_deg.resize(n);
    const auto east = static_cast<float>(std::sin(radians(axis_azimuth_deg)));
    const auto north = static_cast<float>(std::cos(radians(axis_azimuth_deg)));
    const float *middle_x = directions.middle_x.data(), *middle_y = directions.middle_y.data();
    const float *x = directions.x.data(), *y = directions.y.data(), *z = directions.z.data();
    float *zenith = zenith_deg.data(), *azimuth = azimuth_deg.data();
#pragma omp simd
    for (std::size_t k = 0; k < n; ++k) {
        const float ahead = middle_x[k] * east + middle_y[k] * north;
        const float right = middle_x[k] * north - middle_y[k] * east;
        azimuth[k] = degree * angle(ahead, right);
        zenith[k] = degree * angle(z[k], std::sqrt(x[k] * x[k] + y[k] * y[k]));
    }
}

std::uint32_t add_open_lanes(const RayBundles& rays, std::size_t bundle, std::size_t used,
                             float* sum) {
    const std::size_t at = bundle * lanes;
    const std::uint32_t* facet = rays.facet + at;
    const float *dx = rays.direction_x + at, *dy = rays.direction_y + at,
                *dz = rays.direction_z + at;
    const auto most = static_cast<std::uint32_t>(used);
    float count = 0.0f, x = 0.0f, y = 0.0f, z = 0.0f;
#pragma omp simd reduction(+ : count, x, y, z)
    for (std::uint32_t s = 0; s < lanes; ++s) {
        const float open = (s < most) & (facet[s] == index(no_facet)) ? 1.0f : 0.0f;
        count += open;
        x += open * dx[s];
        y += open * dy[s];
        z += open * dz[s];
    }
    sum[0] += x, sum[1] += y, sum[2] += z;
    return static_cast<std::uint32_t>(count);
}

}  // namespace diurna
