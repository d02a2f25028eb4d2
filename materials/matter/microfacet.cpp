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
    if (gaussian) {
        const double c2 = cosine * cosine;
        return std::exp((c2 - 1.0) / (c2 * square)) / (std::numbers::pi * square * c2 * c2);
    }
    const double d = 1.0 + (square - 1.0) * cosine * cosine;
    return square / (std::numbers::pi * d * d);
}

double Microfacets::hidden(double cosine) const {
    const double c = std::abs(cosine);
    const double tangent = std::sqrt(std::max(0.0, 1.0 - c * c)) / c;
    if (gaussian) {
        const double x = 1.0 / std::max(1e-6, roughness * tangent);
        if (x > 6.0) return 0.0;
        return 0.5 * (std::exp(-x * x) / (x * std::sqrt(std::numbers::pi)) - std::erfc(x));
    }
    return 0.5 * (std::sqrt(1.0 + roughness * roughness * tangent * tangent) - 1.0);
}

double Microfacets::lit_and_seen(double cosine_eye, double cosine_light) const {
    return 1.0 / (1.0 + hidden(cosine_eye) + hidden(cosine_light));
}

Eigen::Vector3d Microfacets::normal(const Eigen::Vector3d& eye, double u, double v) const {
    if (gaussian) {
        const double slope = roughness * std::sqrt(-2.0 * std::log(1.0 - u));
        const double turn = 2.0 * std::numbers::pi * v;
        return Eigen::Vector3d(slope * std::cos(turn), slope * std::sin(turn), 1.0).normalized();
    }
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
    if (gaussian) {
        const double facing = eye.dot(microfacet);
        if (facing <= 0.0) return 0.0;
        const double c2 = microfacet.z() * microfacet.z();
        const double rarer = 2.0 * std::exp(-(1.0 - c2) / (2.0 * c2 * roughness * roughness));
        return rarer * lit_and_seen(eye.z(), up) * facing / (microfacet.z() * eye.z());
    }
    return (1.0 + hidden(eye.z())) * lit_and_seen(eye.z(), up);
}

namespace {

/// body(weight, cosine at the microfacet) by midpoints in the variables of the sampling, in which
/// the integrand is bounded and, but for what goes below the surface, smooth. Returns the number of
/// points.
template <class Body>
double each_microfacet(const Microfacets& surface, double cosine, const Body& body) {
    const double c = std::max(cosine, 1e-3);
    const Eigen::Vector3d eye(std::sqrt(1.0 - c * c), 0.0, c);
    // Gaussian ones are smoother, and the same on either side of the plane of incidence.
    const int rings = surface.gaussian ? 16 : 24, all = surface.gaussian ? 32 : 48;
    const int spokes = surface.gaussian ? all / 2 : all;
    for (int i = 0; i < rings; ++i) {
        for (int k = 0; k < spokes; ++k) {
            const Eigen::Vector3d n = surface.normal(eye, (i + 0.5) / rings, (k + 0.5) / all);
            const double weight = surface.weight(eye, n);
            if (weight > 0.0) body(weight, std::min(1.0, eye.dot(n)));
        }
    }
    return rings * spokes;
}

}  // namespace

double microfacet_reflectance(const Microfacets& surface, double cosine,
                              const std::function<double(double)>& reflected) {
    if (surface.roughness < 1e-3) return reflected(cosine);
    double some = 0.0, all = 0.0;
    const double points = each_microfacet(surface, cosine, [&](double weight, double facing) {
        some += weight * reflected(facing);
        all += weight;
    });
    if (surface.gaussian) return some / std::max(points, all);
    return all > 0.0 ? some / all : reflected(std::max(cosine, 1e-3));
}

std::vector<double> facing_shares(const Microfacets& surface, double cosine) {
    std::vector<double> shares(facing_nodes, 0.0);
    const auto add = [&](double weight, double facing) {
        const double place = std::sqrt(std::clamp(facing, 0.0, 1.0)) * double(facing_nodes - 1);
        const auto k = std::min(static_cast<std::size_t>(place), facing_nodes - 2);
        const double t = place - double(k);
        shares[k] += (1.0 - t) * weight;
        shares[k + 1] += t * weight;
    };
    if (surface.roughness < 1e-3) {
        add(1.0, cosine);
        return shares;
    }
    double all = 0.0;
    const double points = each_microfacet(surface, cosine, [&](double weight, double facing) {
        add(weight, facing);
        all += weight;
    });
    if (surface.gaussian) all = std::max(points, all);
    if (!(all > 0.0)) {
        add(1.0, cosine);
        return shares;
    }
    for (double& share : shares) share /= all;
    return shares;
}

}  // namespace diurna
