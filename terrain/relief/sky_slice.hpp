#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "terrain/relief/linear_table.hpp"

/// Contribution of one azimuth to the sky that a plane sees: the mean over all azimuths is the sky
/// view (Dozier & Frew 1990, eq. 7b). With h the elevation and t the tangent of the lower edge of
/// the plane's sky, n its unit normal and n_φ the normal's component in that direction:
///
///     n_z cos²h + n_φ (π/2 − h − sin h cos h)  =  n_z / (1 + t²) + n_φ (arccot t − t / (1 + t²))
///
/// For whole rows of posts the arc comes from a polynomial, vectorised (relief_sky.cpp); for single
/// facets the bracket comes from a table.
namespace diurna {

/// π/2 − atan t for t ≥ 0, within 1e-6 rad (odd polynomial on [0, 1], Abramowitz & Stegun 4.4.49).
inline float arc_cotangent(float t) {
    const bool steep = t > 1.0f;
    const float x = steep ? 1.0f / t : t;
    const float s = x * x;
    const float arc =
        x * (1.0f + s * (-0.3333314528f +
                         s * (0.1999355085f +
                              s * (-0.1420889944f +
                                   s * (0.1065626393f +
                                        s * (-0.0752896400f +
                                             s * (0.0429096138f +
                                                  s * (-0.0161657367f + s * 0.0028662257f))))))));
    constexpr float quarter = std::numbers::pi_v<float> / 2.0f;
    return steep ? arc : quarter - arc;
}

/// arccot t − t / (1 + t²) for t ≥ 0, linear in a table over t / (1 + t), in which it is smooth
/// (its derivative by t is −2 / (1 + t²)²): within 1e-6.
class SlopeTable {
 public:
    float operator()(float t) const { return value_(t / (1.0f + t) * cells); }

 private:
    static constexpr int cells = 1024;
    LinearTable<cells> value_{[](int i) {
        const double s = double(i) / cells, t = s < 1.0 ? s / (1.0 - s) : 1e12;
        return std::atan2(1.0, t) - t / (1.0 + t * t);
    }};
};

/// The contribution above a horizon's tangent and above the plane itself.
inline float sky_slice(const SlopeTable& slope, const Eigen::Vector3f& normal,
                       const Eigen::Vector2f& way, float tangent) {
    const float along = normal.head<2>().dot(way);
    if (normal.z() <= 1e-4f) {  // the plane of a vertical wall ends at the zenith
        return along > 0.0f ? along * slope(tangent) : 0.0f;
    }
    const float t = std::max(tangent, -along / normal.z());
    return normal.z() / (1.0f + t * t) + along * slope(t);
}

}  // namespace diurna
