#include "terrain/visibility/sky_basis.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace diurna {

namespace {

using Even = std::array<double, even_sky_functions>;
constexpr double pi = std::numbers::pi;
constexpr float least_up = 1e-4f;

/// ∫ max(0, a + b cos φ) cos mφ dφ over the circle, m = 0 to 3; b at least 0.
std::array<double, 4> ring_integrals(double a, double b) {
    if (a >= b) return {2.0 * pi * a, pi * b, 0.0, 0.0};
    if (a <= -b) return {};
    const double edge = std::acos(-a / b), s1 = std::sin(edge), s2 = std::sin(2.0 * edge),
                 s3 = std::sin(3.0 * edge), s4 = std::sin(4.0 * edge);
    return {2.0 * (a * edge + b * s1), 2.0 * a * s1 + b * (edge + 0.5 * s2),
            a * s2 + b * (s1 + s3 / 3.0), 2.0 / 3.0 * a * s3 + b * (0.5 * s2 + 0.25 * s4)};
}

/// What a plane that leans towards x by this much takes of each function from the rings of the
/// sky, from the zenith down; z = t², evenly in t, as −ln z has no end.
template <class Body>
void each_ring(double up, double across, const Body& body) {
    constexpr int rings = 800;
    for (int i = rings - 1; i >= 0; --i) {
        const double t = (i + 0.5) / rings, z = t * t, r = std::sqrt(1.0 - z * z);
        const auto c = ring_integrals(up * z, across * r);
        const double share = 2.0 * t / rings / pi, c1 = c[1] * r, c2 = c[2] * r * r;
        Even ring = {c[0],       c[0] * z, c[0] * z * z, -c[0] * std::log(z), c1, c1 * z,
                     c1 * z * z, c2,       c2 * z,       c[3] * r * r * r};
        for (double& x : ring) x *= share;
        if (!body(ring)) return;
    }
}

Even whole_sky(double slope) {
    Even sum{};
    each_ring(std::cos(slope), std::sin(slope), [&](const Even& ring) {
        for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += ring[k];
        return true;
    });
    sum[0] = 0.5 * (1.0 + std::cos(slope));
    return sum;
}

/// whole_sky by slope, linear in between.
class OpenPlanes {
 public:
    Even operator()(double slope) const {
        const double place = slope / pi * steps;
        const auto i = std::min(static_cast<std::size_t>(place), steps - 1);
        Even sky;
        for (std::size_t k = 0; k < sky.size(); ++k) {
            sky[k] = std::lerp(at_[i][k], at_[i + 1][k], place - double(i));
        }
        return sky;
    }
    OpenPlanes() {
        for (std::size_t i = 0; i <= steps; ++i) at_.push_back(whole_sky(pi * double(i) / steps));
    }

 private:
    static constexpr std::size_t steps = 360;
    std::vector<Even> at_;
};

/// A plane's slope and the way it leans in plan, unit.
struct Lean {
    double slope;
    Eigen::Vector2d towards;

    explicit Lean(const Eigen::Vector3f& normal) {
        const Eigen::Vector2d plan = normal.head<2>().cast<double>();
        const double across = plan.norm();
        slope = std::atan2(across, double{normal.z()});
        towards = across > 0.0 ? Eigen::Vector2d(plan / across) : Eigen::Vector2d::UnitX();
    }
};

/// cos and sin of m times the angle of a direction in plan.
std::array<Eigen::Vector2d, 4> turns(const Eigen::Vector2d& towards) {
    std::array<Eigen::Vector2d, 4> turn = {Eigen::Vector2d(1.0, 0.0), towards};
    for (std::size_t m = 2; m < 4; ++m) {
        turn[m] = {turn[m - 1].x() * towards.x() - turn[m - 1].y() * towards.y(),
                   turn[m - 1].x() * towards.y() + turn[m - 1].y() * towards.x()};
    }
    return turn;
}

SkyVector turned(const Even& even, const Eigen::Vector2d& towards) {
    const auto turn = turns(towards);
    SkyVector sky{};
    for (std::size_t k = 0; k < even.size(); ++k) {
        const std::size_t at = even_sky_function[k];
        const Eigen::Vector2d& by = turn[static_cast<std::size_t>(sky_order[k])];
        sky[at] = static_cast<float>(even[k] * by.x());
        if (sky_order[k] > 0) sky[at + 1] = static_cast<float>(even[k] * by.y());
    }
    return sky;
}

/// The functions' means over a ring just above the horizon.
constexpr std::array<double, 4> near_horizon = {1.0, 0.05, 0.0025, 3.0};

}  // namespace

SkyVector sky_functions_at(const Eigen::Vector3f& direction) {
    const float x = direction.x(), y = direction.y(), z = std::max(least_up, direction.z());
    const float c2 = x * x - y * y, s2 = 2.0f * x * y;
    return {1.0f,   z,      z * z,           -std::log(z),   x,  y,
            x * z,  y * z,  x * z * z,       y * z * z,      c2, s2,
            c2 * z, s2 * z, x * c2 - y * s2, x * s2 + y * c2};
}

SkyVector open_plane(const Eigen::Vector3f& normal) {
    static const OpenPlanes planes;
    const Lean lean(normal);
    return turned(planes(lean.slope), lean.towards);
}

SkyVector plane_behind_ring(const Eigen::Vector3f& normal, double sky_view) {
    const Lean lean(normal);
    sky_view = std::min(sky_view, 0.5 * (1.0 + std::cos(lean.slope)));
    Even sum{};
    each_ring(std::cos(lean.slope), std::sin(lean.slope), [&](const Even& ring) {
        const double share =
            ring[0] > 0.0 ? std::clamp((sky_view - sum[0]) / ring[0], 0.0, 1.0) : 1.0;
        for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += share * ring[k];
        return share == 1.0;
    });
    sum[0] = sky_view;
    return turned(sum, lean.towards);
}

SkyShares with_sky_view(const SkyShares& shares, const Eigen::Vector3f& normal, double before,
                        double after) {
    constexpr double counts = 0.01;  // of the hemisphere
    const SkyVector open = open_plane(normal);
    const double hidden = double{open[0]} - before, more = after - before;
    SkyShares moved = shares;
    for (std::size_t k = 1; k < sky_functions; ++k) {
        double mean = k < near_horizon.size() ? near_horizon[k] : 0.0;
        if (hidden > counts) mean = (double{open[k]} - double{shares[k - 1]}) / hidden;
        moved[k - 1] += static_cast<float>(more * mean);
    }
    return moved;
}

SkyVector sky_of(const FacetViews& views, const FacetSet& facets, std::size_t facet) {
    if (views.shares.empty()) {
        return plane_behind_ring(facets.normal[facet], double{views.sky[facet]});
    }
    SkyVector sky;
    sky[0] = views.sky[facet];
    std::copy(views.shares[facet].begin(), views.shares[facet].end(), sky.begin() + 1);
    return sky;
}

SkyVector about(const SkyVector& sky, const Eigen::Vector2f& towards) {
    const auto turn = turns(towards.cast<double>());
    SkyVector turned = sky;
    for (std::size_t k = 0; k < even_sky_functions; ++k) {
        if (sky_order[k] == 0) continue;
        const std::size_t at = even_sky_function[k];
        const Eigen::Vector2f by = turn[static_cast<std::size_t>(sky_order[k])].cast<float>();
        turned[at] = sky[at] * by.x() + sky[at + 1] * by.y();
        turned[at + 1] = sky[at + 1] * by.x() - sky[at] * by.y();
    }
    return turned;
}

EvenSkyVector even_part(const SkyVector& sky, const Eigen::Vector2f& towards) {
    const SkyVector turned = about(sky, towards);
    EvenSkyVector even;
    for (std::size_t k = 0; k < even.size(); ++k) even[k] = turned[even_sky_function[k]];
    return even;
}

}  // namespace diurna
