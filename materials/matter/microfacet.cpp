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

namespace {

/// Where erf(x) = y, within 3e-3 (Winitzki 2008).
double inverse_erf(double y) {
    constexpr double a = 0.147;
    const double log = std::log1p(-y * y), b = 2.0 / (std::numbers::pi * a) + 0.5 * log;
    return std::copysign(std::sqrt(std::max(0.0, std::sqrt(b * b - log / a) - b)), y);
}

/// The place x up to which the share u lies of (1 + t x) exp(−x²) where it is positive. Halley's
/// method, whose last step of 1e-6 leaves less than 1e-9, between bounds.
double seen_quantile(double u, double t) {
    constexpr double reach = 6.0, last_step = 1e-6;
    static const double root_pi = std::sqrt(std::numbers::pi);
    const double least = t > 1.0 / reach ? -1.0 / t : -reach;
    const auto below = [&](double x, double exp_x) {
        return 0.5 * std::erf(x) - t * exp_x / (2.0 * root_pi);
    };
    const double start = below(least, std::exp(-least * least));
    const double aim = start + u * (0.5 - start);
    // That of exp(−x²) or, where the other part is the larger, of x exp(−x²).
    constexpr double almost_one = 1.0 - 1e-12;
    const double guess = t > 2.0 ? std::sqrt(-std::log1p(-std::min(u, almost_one)))
                                 : inverse_erf(std::clamp(2.0 * aim, -almost_one, almost_one));
    double low = least, high = reach;
    double x = guess > low && guess < high ? guess : std::max(0.0, least);
    for (int step = 0; step < 60; ++step) {
        const double exp_x = std::exp(-x * x), over = below(x, exp_x) - aim;
        (over > 0.0 ? high : low) = x;
        const double density = 1.0 + t * x, slope = density * exp_x / root_pi;
        double next = low;
        if (slope > 0.0) {
            const double newton = over / slope;
            next = x - newton / (1.0 - 0.5 * newton * (t / density - 2.0 * x));
            if (std::abs(next - x) < last_step) return next;
        }
        if (!(next > low && next < high)) next = 0.5 * (low + high);
        x = next;
    }
    return x;
}

}  // namespace

Eigen::Vector3d Microfacets::normal(const Eigen::Vector3d& eye, double u, double v) const {
    if (gaussian) {
        const double level = std::hypot(eye.x(), eye.y());
        const double x = level > 0.0 ? eye.x() / level : 1.0,
                     y = level > 0.0 ? eye.y() / level : 0.0;
        const double towards = roughness * seen_quantile(u, roughness * level / eye.z());
        const double across = roughness * seen_quantile(v, 0.0);
        return Eigen::Vector3d(towards * x - across * y, towards * y + across * x, 1.0)
            .normalized();
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
    if (up <= 0.0 || eye.dot(microfacet) <= 0.0) return 0.0;
    return (1.0 + hidden(eye.z())) * lit_and_seen(eye.z(), up);
}

NormalPlace normal_place(const Microfacets& surface, int i, int n) {
    const double turns = 0.5 + i * golden_section;
    const double u = (i + 0.5) / n, v = turns - std::floor(turns);
    if (!surface.gaussian) return {u, v, 1.0 / n};
    const auto spread = [](double p) { return p * p * (3.0 - 2.0 * p); };
    return {spread(u), spread(v), 36.0 * u * (1.0 - u) * v * (1.0 - v) / n};
}

namespace {

/// body(weight, cosine at the microfacet) in the variables of the sampling, in which the integrand
/// is bounded. The weights of a lossless surface that neither hides nor shades itself add up to
/// one.
template <class Body>
void each_microfacet(const Microfacets& surface, double cosine, const Body& body) {
    const double c = std::max(cosine, 1e-3);
    const Eigen::Vector3d eye(std::sqrt(1.0 - c * c), 0.0, c);
    const int places = surface.gaussian ? 377 : 1152;
    for (int i = 0; i < places; ++i) {
        const NormalPlace at = normal_place(surface, i, places);
        const Eigen::Vector3d n = surface.normal(eye, at.u, at.v);
        const double weight = surface.weight(eye, n) * at.share;
        if (weight > 0.0) body(weight, std::min(1.0, eye.dot(n)));
    }
}

}  // namespace

double microfacet_reflectance(const Microfacets& surface, double cosine,
                              const std::function<double(double)>& reflected) {
    if (surface.roughness < 1e-3) return reflected(cosine);
    double some = 0.0, all = 0.0;
    each_microfacet(surface, cosine, [&](double weight, double facing) {
        some += weight * reflected(facing);
        all += weight;
    });
    if (surface.gaussian) return some / std::max(1.0, all);
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
    each_microfacet(surface, cosine, [&](double weight, double facing) {
        add(weight, facing);
        all += weight;
    });
    if (surface.gaussian) all = std::max(1.0, all);
    if (!(all > 0.0)) {
        add(1.0, cosine);
        return shares;
    }
    for (double& share : shares) share /= all;
    return shares;
}

}  // namespace diurna
