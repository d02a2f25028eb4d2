#include "materials/matter/measured_brdf.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <utility>
#include <variant>

#include "materials/base/quadrature.hpp"
#include "materials/base/units.hpp"

namespace diurna {

namespace {

double angle_deg(double cosine) { return degrees(std::acos(std::clamp(cosine, -1.0, 1.0))); }

/// A place between two nodes.
struct Place {
    std::size_t low;
    double share;
};
Place line_place(const std::vector<double>& axis, double x) {
    if (axis.size() < 2 || x <= axis.front()) return {0, 0.0};
    if (x >= axis.back()) return {axis.size() - 2, 1.0};
    const auto above = std::upper_bound(axis.begin(), axis.end(), x);
    const auto low = static_cast<std::size_t>(above - axis.begin()) - 1;
    return {low, (x - axis[low]) / (axis[low + 1] - axis[low])};
}

double value_at(const MeasuredBrdf& table, const std::array<double, 3>& x) {
    const std::array<Place, 3> at = {line_place(table.first, x[0]), line_place(table.second, x[1]),
                                     line_place(table.third, x[2])};
    double sum = 0.0;
    for (std::size_t corner = 0; corner < 8; ++corner) {
        double weight = 1.0;
        std::array<std::size_t, 3> node{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const bool high = (corner >> axis) & 1u;
            weight *= high ? at[axis].share : 1.0 - at[axis].share;
            node[axis] = at[axis].low + (high ? 1 : 0);
        }
        if (weight == 0.0) continue;
        sum += weight *
               double{table.value[(node[0] * table.second.size() + node[1]) * table.third.size() +
                                  node[2]]};
    }
    return sum;
}

std::array<double, 3> between_directions(const Eigen::Vector3d& eye, const Eigen::Vector3d& light) {
    const double azimuth = std::atan2(light.y(), light.x()) - std::atan2(eye.y(), eye.x());
    return {angle_deg(light.z()), angle_deg(eye.z()), angle_deg(std::cos(azimuth))};
}

std::array<double, 3> about_half_vector(const Eigen::Vector3d& eye, const Eigen::Vector3d& light) {
    const Eigen::Vector3d half = (eye + light).normalized();
    // The plane of normal and half vector; light's azimuth about the latter counts from it.
    Eigen::Vector3d across = Eigen::Vector3d::UnitZ().cross(half);
    across = across.norm() > 1e-9 ? Eigen::Vector3d(across.normalized()) : Eigen::Vector3d::UnitY();
    const Eigen::Vector3d along = across.cross(half);
    double about = degrees(std::atan2(light.dot(across), light.dot(along)));
    if (about < 0.0) about += 180.0;  // light and eye change places: the same
    return {angle_deg(half.z()), angle_deg(half.dot(light)), about};
}

/// A table's factor at a cosine, as its finish has it.
double reflectance_at(const ByAngle& finish, double cosine) {
    const Place at = line_place(finish.angle_deg, angle_deg(cosine));
    return finish.measured->at_ten *
           std::lerp(finish.factor[at.low], finish.factor[at.low + 1], at.share);
}

}  // namespace

double brdf(const MeasuredBrdf& table, const Eigen::Vector3d& eye, const Eigen::Vector3d& light) {
    return value_at(table, table.axes == MeasuredBrdf::Axes::directions
                               ? between_directions(eye, light)
                               : about_half_vector(eye, light));
}

double directional_hemispherical(const MeasuredBrdf& table, double cosine) {
    constexpr int rings = 160, spokes = 96;
    const double c = std::clamp(cosine, 1e-3, 1.0);
    const Eigen::Vector3d eye(std::sqrt(1.0 - c * c), 0.0, c);
    double sum = 0.0;
    for (int i = 0; i < rings; ++i) {
        // Half vectors to 90° from the normal, θ = u² π/2.
        const double u = (i + 0.5) / rings, theta = 0.5 * std::numbers::pi * u * u;
        const double ring = std::sin(theta) * std::numbers::pi * u / rings;
        for (int k = 0; k < spokes; ++k) {
            const double phi = std::numbers::pi * (k + 0.5) / spokes;  // either side is alike
            const Eigen::Vector3d half(std::sin(theta) * std::cos(phi),
                                       std::sin(theta) * std::sin(phi), std::cos(theta));
            const double facing = eye.dot(half);
            const Eigen::Vector3d light = 2.0 * facing * half - eye;
            if (facing <= 0.0 || light.z() <= 0.0) continue;
            sum += brdf(table, eye, light) * light.z() * 4.0 * facing * ring;  // dω = 4 cosθ_d dω_h
        }
    }
    return sum * 2.0 * std::numbers::pi / spokes;
}

ByAngle finish_of(MeasuredBrdf table) {
    ByAngle finish;
    for (const double angle :
         {0.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0, 65.0, 70.0, 75.0, 80.0, 84.0, 87.0, 89.0}) {
        finish.angle_deg.push_back(angle);
        finish.factor.push_back(directional_hemispherical(table, std::cos(radians(angle))));
    }
    table.at_ten = finish.factor[1];
    for (double& factor : finish.factor) factor /= table.at_ten;
    const auto kept = std::make_shared<MeasuredBrdf>(std::move(table));
    finish.measured = kept;
    const Quadrature rule = gauss_legendre(32, 0.0, 1.0);
    for (std::size_t i = 0; i < rule.size(); ++i) {
        kept->mean += rule.weight[i] * 2.0 * rule.node[i] * reflectance_at(finish, rule.node[i]);
    }
    return finish;
}

double measured_lobe(const Finish& finish, const Eigen::Vector3d& normal,
                     const Eigen::Vector3d& eye, const Eigen::Vector3d& light) {
    const auto* by_angle = std::get_if<ByAngle>(&finish);
    if (by_angle == nullptr || !by_angle->measured) return 1.0;
    const double eye_cosine = normal.dot(eye), light_cosine = normal.dot(light);
    if (eye_cosine <= 0.0 || light_cosine <= 0.0) return 1.0;
    const Eigen::Quaterniond upright =
        Eigen::Quaterniond::FromTwoVectors(normal, Eigen::Vector3d::UnitZ());
    const double alone = reflectance_at(*by_angle, eye_cosine) *
                         reflectance_at(*by_angle, light_cosine) / by_angle->measured->mean;
    if (!(alone > 0.0)) return 1.0;
    return std::numbers::pi * brdf(*by_angle->measured, upright * eye, upright * light) / alone;
}

}  // namespace diurna
