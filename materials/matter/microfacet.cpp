#include "materials/matter/microfacet.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace diurna {

double fresnel(double cosine, std::complex<double> index) {
    const double c = std::clamp(cosine, 0.0, 1.0);
    const std::complex<double> inside = std::sqrt(index * index - (1.0 - c * c));
    const std::complex<double> across = (c - inside) / (c + inside);
    const std::complex<double> along = (index * index * c - inside) / (index * index * c + inside);
    return 0.5 * (std::norm(across) + std::norm(along));
}

double Microfacets::density(double cosine) const {
    if (cosine <= 0.0) return 0.0;
    const double square = roughness * roughness;
    const double d = 1.0 + (square - 1.0) * cosine * cosine;
    return square / (std::numbers::pi * d * d);
}

double Microfacets::hidden(double cosine) const {
    const double c = std::abs(cosine);
    const double tangent = std::sqrt(std::max(0.0, 1.0 - c * c)) / c;
    return 0.5 * (std::sqrt(1.0 + roughness * roughness * tangent * tangent) - 1.0);
}

double Microfacets::lit_and_seen(double cosine_eye, double cosine_light) const {
    return 1.0 / (1.0 + hidden(cosine_eye) + hidden(cosine_light));
}

Eigen::Vector3d Microfacets::normal(const Eigen::Vector3d& eye, double u, double v) const {
    const Eigen::Vector3d stretched =
        Eigen::Vector3d(roughness * eye.x(), roughness * eye.y(), eye.z()).normalized();
    const double level = std::hypot(stretched.x(), stretched.y());
    const Eigen::Vector3d first =
        level > 0.0 ? Eigen::Vector3d(-stretched.y() / level, stretched.x() / level, 0.0)
                    : Eigen::Vector3d::UnitX();
    const Eigen::Vector3d second = stretched.cross(first);
    const double radius = std::sqrt(u), angle = 2.0 * std::numbers::pi * v;
    const double x = radius * std::cos(angle);
    const double part = 0.5 * (1.0 + stretched.z());
    const double y =
        (1.0 - part) * std::sqrt(std::max(0.0, 1.0 - x * x)) + part * radius * std::sin(angle);
    const double z = std::sqrt(std::max(0.0, 1.0 - x * x - y * y));
    const Eigen::Vector3d n = x * first + y * second + z * stretched;
    return Eigen::Vector3d(roughness * n.x(), roughness * n.y(), std::max(1e-9, n.z()))
        .normalized();
}

double Microfacets::weight(const Eigen::Vector3d& eye, const Eigen::Vector3d& microfacet) const {
    const double up = 2.0 * eye.dot(microfacet) * microfacet.z() - eye.z();
    if (up <= 0.0) return 0.0;
    return (1.0 + hidden(eye.z())) * lit_and_seen(eye.z(), up);
}

double microfacet_reflectance(const Microfacets& surface, double cosine,
                              const std::function<double(double)>& reflected) {
    if (surface.roughness < 1e-3) return reflected(cosine);
    const double c = std::max(cosine, 1e-3);
    const Eigen::Vector3d eye(std::sqrt(1.0 - c * c), 0.0, c);
    // Midpoints in the variables of the sampling, in which the integrand is bounded and, but for
    // what goes below the surface, smooth; the plane of incidence is one of symmetry.
    constexpr int rings = 24, spokes = 48;
    double some = 0.0, all = 0.0;
    for (int i = 0; i < rings; ++i) {
        for (int k = 0; k < spokes; ++k) {
            const Eigen::Vector3d n = surface.normal(eye, (i + 0.5) / rings, (k + 0.5) / spokes);
            const double weight = surface.weight(eye, n);
            some += weight * reflected(std::min(1.0, eye.dot(n)));
            all += weight;
        }
    }
    return all > 0.0 ? some / all : reflected(c);
}

}  // namespace diurna
