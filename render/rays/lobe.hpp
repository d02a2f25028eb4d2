#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "materials/matter/microfacet.hpp"

namespace diurna {

/// Smallest roughness of mirrors whose lobe is integrated, not only sampled (rough_mirror.hpp).
inline constexpr double least_lobe = 1e-3;

/// The lobe of a rough mirror for a direction to an eye.
class Lobe {
 public:
    /// - normal, eye: unit vectors away from the surface
    Lobe(const Microfacets& surface, const Eigen::Vector3d& normal, const Eigen::Vector3d& eye)
        : surface_(surface), normal_(normal) {
        const Eigen::Vector3d aside =
            std::abs(normal.z()) < 0.9 ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitX();
        x_ = aside.cross(normal).normalized();
        y_ = normal.cross(x_);
        eye_ = {eye.dot(x_), eye.dot(y_), std::max(1e-3, eye.dot(normal))};
        eye_.normalize();
    }

    struct Ray {
        Eigen::Vector3d direction;  // unit, away from the surface
        double facing = 0.0;        // cosine at the microfacet
        double weight = 0.0;  // its mean over u, v is a lossless surface's reflectance; 0: none
    };
    /// - u, v: uniform in [0, 1)
    Ray ray(double u, double v) const {
        const Eigen::Vector3d half = surface_.normal(eye_, u, v);
        const double facing = eye_.dot(half);
        const Eigen::Vector3d out = 2.0 * facing * half - eye_;
        return {(out.x() * x_ + out.y() * y_ + out.z() * normal_).normalized(),
                std::min(1.0, facing), surface_.weight(eye_, half)};
    }

    /// Calls body(ray, its share) for rays with a weight, spread evenly over the lobe.
    ///
    /// - finely: if a horizon crosses the lobe, and the ground below differs from the sky
    template <class Body>
    void each(bool finely, const Body& body) const {
        const int rays = finely ? 768 : 192;
        for (int i = 0; i < rays; ++i) {
            const NormalPlace at = normal_place(surface_, i, rays);
            const Ray one = ray(at.u, at.v);
            if (one.weight > 0.0) body(one, at.share);
        }
    }

 private:
    const Microfacets& surface_;
    Eigen::Vector3d normal_, x_, y_, eye_;
};

/// Whether below the horizon the mean over the surrounding facets is used as a mirror's image.
inline bool counts_around(float sky_view, const Eigen::Vector3d& normal) {
    return 1.0f - sky_view > 1e-3f && normal.z() < 1.0 - 1e-9;
}

/// Open share of the sky above a rough mirror. The integral over its lobe weights the background by
/// this share and the mean of the surrounding facets by the rest.
inline float open_sky(float sky_view, const Eigen::Vector3d& normal) {
    const auto whole = static_cast<float>(0.5 * (1.0 + normal.z()));
    const bool hidden = 1.0f - sky_view > 1e-3f && whole > 1e-3f;
    return hidden ? std::min(1.0f, sky_view / whole) : 1.0f;
}

/// Cosine at the microfacet that reflects light from one direction into another.
inline double facing_between(const Eigen::Vector3d& eye, const Eigen::Vector3d& light) {
    return std::sqrt(0.5 * std::max(0.0, 1.0 + eye.dot(light)));
}

}  // namespace diurna
