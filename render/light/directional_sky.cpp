#include "render/light/directional_sky.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "materials/base/quadrature.hpp"
#include "materials/base/units.hpp"
#include "materials/radiation/planck.hpp"

namespace diurna {

namespace {

constexpr double half_turn = std::numbers::pi;
constexpr double aureole_deg = 12.0;
/// What counts in a fit: level ground's cosine, and some more for walls.
constexpr double more_for_walls = 0.3;

/// What open level ground takes of the even functions.
constexpr std::array<double, even_sky_functions> level = {1.0, 2.0 / 3.0, 0.5, 0.5};

std::array<double, even_sky_functions> even_functions_at(double up, double azimuth) {
    const double across = std::sqrt(std::max(0.0, 1.0 - up * up));
    const SkyVector at = sky_functions_at(
        Eigen::Vector3d(across * std::cos(azimuth), across * std::sin(azimuth), up).cast<float>());
    std::array<double, even_sky_functions> even;
    for (std::size_t k = 0; k < even.size(); ++k) even[k] = double{at[even_sky_function[k]]};
    return even;
}

/// Directions of a fit, and the matrix that makes coefficients of radiances there.
struct Fit {
    std::vector<double> up, azimuth, weight;
    Eigen::MatrixXd to_coefficients;  // (function, direction)

    void solve(std::size_t functions) {
        const auto n = Eigen::Index(up.size()), m = Eigen::Index(functions);
        Eigen::MatrixXd at(n, m);
        Eigen::VectorXd root(n);
        for (Eigen::Index i = 0; i < n; ++i) {
            const auto even = even_functions_at(up[std::size_t(i)], azimuth[std::size_t(i)]);
            root[i] = std::sqrt(weight[std::size_t(i)]);
            for (Eigen::Index k = 0; k < m; ++k) at(i, k) = root[i] * even[std::size_t(k)];
        }
        to_coefficients = at.colPivHouseholderQr().solve(Eigen::MatrixXd(root.asDiagonal()));
    }
};

/// Of the mean over level ground.
Quadrature mean_rule() { return gauss_legendre(8, 0.0, 1.0); }

/// Of heat by zenith angle: where the mean is taken, and nearer the horizon.
const Fit& zenith_fit() {
    static const Fit fit = [] {
        constexpr double lowest = 0.05;
        Fit f;
        const Quadrature square_of_cosine = mean_rule();
        for (std::size_t i = 0; i < square_of_cosine.size(); ++i) {
            f.up.push_back(std::sqrt(square_of_cosine.node[i]));
            const double width = square_of_cosine.weight[i] / (2.0 * f.up.back());
            f.weight.push_back(width * (f.up.back() + more_for_walls));
        }
        f.up.push_back(lowest);
        f.weight.push_back(2.0 * lowest * (lowest + more_for_walls));
        f.azimuth.assign(f.up.size(), 0.0);
        f.solve(4);
        return f;
    }();
    return fit;
}

/// Of sunlight over half the sky; the other half is its mirror image.
const Fit& sunlit_fit() {
    static const Fit fit = [] {
        Fit f;
        const HalfSky& half = half_sky();
        f.up.assign(half.up.begin(), half.up.end());
        f.azimuth.assign(half.azimuth.begin(), half.azimuth.end());
        for (std::size_t i = 0; i < sky_directions; ++i) {
            f.weight.push_back(half.ring_weight[i] * (half.up[i] + more_for_walls));
        }
        f.solve(even_sky_functions);
        return f;
    }();
    return fit;
}

/// What of the sky round the sun is brighter than at the aureole's edge, by the angle from the sun.
class Aureole {
 public:
    Aureole(const SunField& field, const BandModel& model, double height_km, double zenith_deg) {
        std::vector<double> angle_deg;
        for (std::size_t i = 0; i < steps; ++i) angle_deg.push_back(angle_of(double(i)));
        angle_deg.push_back(aureole_deg);
        const auto turned = field.path_by_turn(line_of(model, height_km, zenith_deg), angle_deg);
        excess_ = turned.at_angle;
        for (std::vector<double>& at : excess_) {
            for (std::size_t n = 0; n < at.size(); ++n) {
                at[n] = std::max(0.0, at[n] - turned.at_angle.back()[n]);
            }
        }
        // ∫ dω over what is above the horizon.
        irradiance.assign(excess_.back().size(), 0.0);
        const double elevation = 90.0 - zenith_deg;
        for (std::size_t i = 0; i < steps; ++i) {
            const double angle = angle_of(double(i) + 0.5);
            const double ring = 2.0 * half_turn *
                                (std::cos(radians(angle_of(double(i)))) -
                                 std::cos(radians(angle_of(double(i) + 1.0))));
            const double above = angle > elevation
                                     ? 1.0 - std::acos(std::max(0.0, elevation / angle)) / half_turn
                                     : 1.0;
            for (std::size_t n = 0; n < irradiance.size(); ++n) {
                irradiance[n] += ring * above * 0.5 * (excess_[i][n] + excess_[i + 1][n]);
            }
        }
    }
    double at(double angle_deg, std::size_t node) const {
        if (angle_deg >= aureole_deg) return 0.0;
        const double place = steps * std::sqrt(angle_deg / aureole_deg);
        const auto i = std::min(static_cast<std::size_t>(place), steps - 1);
        return std::lerp(excess_[i][node], excess_[i + 1][node], place - double(i));
    }

    std::vector<double> irradiance;  // (node) on a plane facing the sun

 private:
    static constexpr std::size_t steps = 8;  // denser near the sun
    static double angle_of(double step) { return aureole_deg * std::pow(step / steps, 2); }
    std::vector<std::vector<double>> excess_;  // (angle)(node)
};

/// Unit; any while the sun stands overhead.
Eigen::Vector2f sun_in_plan(const RadianceInput& input) {
    const Eigen::Vector2d plan = input.to_sun.head<2>();
    const double across = plan.norm();
    return across > 1e-9 ? Eigen::Vector2f((plan / across).cast<float>())
                         : Eigen::Vector2f::UnitX();
}

UnevenView uneven(const EvenSkyVector& even) {
    UnevenView view;
    for (std::size_t k = 1; k < even.size(); ++k) {
        view[k - 1] = even[k] - even[0] * static_cast<float>(level[k]);
    }
    return view;
}

}  // namespace

UnevenView uneven_view(const RadianceInput& input, SurfaceId facet) {
    return uneven(even_part(sky_of(input.views, input.facets, index(facet)), sun_in_plan(input)));
}

NarrowView narrow_view(const RadianceInput& input, SurfaceId facet) {
    NarrowView view;
    narrow_views(input, {&facet, 1}, {&view, 1});
    return view;
}

void narrow_views(const RadianceInput& input, std::span<const SurfaceId> facet,
                  std::span<NarrowView> view) {
    const Eigen::Vector2f towards = sun_in_plan(input);
    std::vector<SkyVector> sky;
    std::vector<Eigen::Vector3f> turned;
    for (const SurfaceId id : facet) {
        const Eigen::Vector3f& normal = input.facets.normal[index(id)];
        turned.emplace_back(normal.x() * towards.x() + normal.y() * towards.y(),
                            normal.y() * towards.x() - normal.x() * towards.y(), normal.z());
        sky.push_back(about(sky_of(input.views, input.facets, index(id)), towards));
    }
    narrow_views(sky, turned, view);
}

UnevenView uneven_view_of_wall(bool sunward) {
    const Eigen::Vector3f normal(sunward ? 1.0f : -1.0f, 0.0f, 0.0f);
    return uneven(even_part(open_plane(normal), Eigen::Vector2f::UnitX()));
}

HeatOfSky heat_of_sky(const Atmosphere& atmosphere, double height_km,
                      std::span<const double> node_um) {
    const Fit& fit = zenith_fit();
    HeatOfSky heat{.mean = std::vector<double>(node_um.size(), 0.0), .uneven = {}};
    for (std::vector<double>& c : heat.uneven) c.assign(node_um.size(), 0.0);
    if (const auto* vacuum = std::get_if<Vacuum>(&atmosphere)) {
        for (std::size_t n = 0; n < node_um.size(); ++n) {
            heat.mean[n] = planck(node_um[n], vacuum->space_temperature);
        }
        return heat;
    }
    const Quadrature square_of_cosine = mean_rule();
    for (std::size_t i = 0; i < fit.up.size(); ++i) {
        const std::vector<double> sky =
            sky_at_nodes(atmosphere, height_km, degrees(std::acos(fit.up[i])), node_um);
        const double weight = i < square_of_cosine.size() ? square_of_cosine.weight[i] : 0.0;
        for (std::size_t n = 0; n < sky.size(); ++n) heat.mean[n] += weight * sky[n];
        for (std::size_t k = 0; k < heat.uneven.size(); ++k) {
            const double share = fit.to_coefficients(Eigen::Index(k + 1), Eigen::Index(i));
            for (std::size_t n = 0; n < sky.size(); ++n) heat.uneven[k][n] += share * sky[n];
        }
    }
    return heat;
}

namespace {

/// The sky without its aureole in the directions of half_sky, (direction)(node).
std::vector<std::vector<double>> smooth_sky(const SunField& field, double height_km,
                                            const Aureole& aureole) {
    const HalfSky& half = half_sky();
    std::vector<double> azimuth_deg;
    for (std::size_t j = 0; j < sky_sectors; ++j) azimuth_deg.push_back(degrees(half.azimuth[j]));
    std::vector<std::vector<double>> smooth;
    for (std::size_t i = 0; i < sky_rings; ++i) {
        const double here_deg = degrees(std::acos(half.up[i * sky_sectors]));
        auto skies = field.skies(height_km, here_deg, azimuth_deg);
        for (std::size_t j = 0; j < sky_sectors; ++j) {
            const double angle_deg = field.angle_from_sun_deg(here_deg, azimuth_deg[j]);
            for (std::size_t n = 0; n < skies[j].size(); ++n) {
                skies[j][n] = std::max(0.0, skies[j][n] - aureole.at(angle_deg, n));
            }
            smooth.push_back(std::move(skies[j]));
        }
    }
    return smooth;
}

/// What is left of the sky where its sum of functions is taken away, times `scale` (node).
void take_fit_away(const std::array<std::vector<double>, even_sky_functions>& coefficient,
                   const std::vector<double>& scale, std::vector<std::vector<double>>& sky) {
    const Fit& fit = sunlit_fit();
    for (std::size_t i = 0; i < sky.size(); ++i) {
        const auto even = even_functions_at(fit.up[i], fit.azimuth[i]);
        for (std::size_t n = 0; n < scale.size(); ++n) {
            for (std::size_t k = 0; k < even.size(); ++k) {
                sky[i][n] -= coefficient[k][n] * even[k];
            }
            sky[i][n] *= scale[n];
        }
    }
}

}  // namespace

SunlitShape sunlit_shape(const SunField& field, const BandModel& model, double height_km,
                         double zenith_deg) {
    const Aureole aureole(field, model, height_km, zenith_deg);
    const Fit& fit = sunlit_fit();
    const std::size_t nodes = aureole.irradiance.size();
    std::array<std::vector<double>, even_sky_functions> coefficient;
    for (std::vector<double>& c : coefficient) c.assign(nodes, 0.0);
    std::vector<std::vector<double>> smooth = smooth_sky(field, height_km, aureole);
    for (std::size_t i = 0; i < smooth.size(); ++i) {
        const auto share = fit.to_coefficients.col(Eigen::Index(i));
        for (std::size_t k = 0; k < coefficient.size(); ++k) {
            for (std::size_t n = 0; n < nodes; ++n) {
                coefficient[k][n] += share[Eigen::Index(k)] * smooth[i][n];
            }
        }
    }
    SunlitShape shape{.aureole = aureole.irradiance,
                      .mean = std::vector<double>(nodes, 0.0),
                      .left = std::move(smooth)};
    for (std::vector<double>& c : shape.uneven) c.assign(nodes, 0.0);
    std::vector<double> scales(nodes, 0.0);
    for (std::size_t n = 0; n < nodes; ++n) {
        double mean = 0.0;
        for (std::size_t k = 0; k < level.size(); ++k) mean += coefficient[k][n] * level[k];
        const double whole =
            half_turn * mean + aureole.irradiance[n] * std::cos(radians(zenith_deg));
        const double scale = mean > 0.0 ? 1.0 / whole : 0.0;
        scales[n] = scale;
        shape.mean[n] = mean > 0.0 ? scale * mean : 1.0 / half_turn;
        shape.aureole[n] *= scale;
        for (std::size_t k = 0; k < uneven_functions; ++k) {
            shape.uneven[k][n] = scale * coefficient[k + 1][n];
        }
    }
    take_fit_away(coefficient, scales, shape.left);
    return shape;
}

}  // namespace diurna
