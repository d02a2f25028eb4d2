#include "thermal/point/spin_up.hpp"

#include <algorithm>
#include <cmath>

#include "thermal/point/store_start.hpp"

namespace diurna {

namespace {

/// Finds the state that a span of steps leads back to itself, by Newton on the periodic map. The
/// first pass chooses the steps, the others repeat them; what stands on the surface follows from
/// pass to pass.
SpunUp make_periodic(PointFacet& facet, Instant from, Instant to, double tolerance) {
    constexpr int most_passes = 30;
    const auto n = static_cast<Eigen::Index>(facet.u.size());
    std::vector<double> steps;
    SpunUp spun;
    StoreStart store;
    double before = 1e9;
    bool plain = false;
    while (spun.passes < most_passes) {
        ++spun.passes;
        const std::vector<double> start = facet.u;
        const Standing standing = facet.standing;
        facet.renew_snow();
        Eigen::MatrixXd map = Eigen::MatrixXd::Identity(n, n);
        if (spun.passes == 1) {
            facet.advance(from, to, &steps, &map);
        } else {
            facet.repeat(from, steps, map);
        }
        spun.residual = facet.change_since(start);
        const bool store_settled = store.next(spun.passes, standing, facet.standing);
        spun.standing_residual = store.growth;
        spun.store_held = store.held;
        spun.converged = spun.residual <= periodic_tolerance && store_settled;
        if (spun.converged) break;
        // Where a front of freezing passes other nodes than it did, the map before misleads: a
        // plain pass brings it closer.
        const bool astray = spun.residual > 0.5 * before && !plain;
        plain = astray && !facet.column.linear();
        before = spun.residual;
        // A column that loses nothing has no move, though it warms from day to day.
        spun.error = spun.residual;
        if (!plain) spun.error = std::max(spun.error, facet.close_period(start, map));
        spun.converged = !plain && spun.error <= tolerance && store_settled;
    }
    return spun;
}

/// Takes the freezing out of a surface's layers; whether there was any.
bool forget_freezing(ThermalSurface& surface) {
    bool any = false;
    for (Layer& layer : surface.layers) {
        if (!std::holds_alternative<Freezing>(layer.law)) continue;
        layer.law = Constant{};
        any = true;
    }
    return any;
}

/// The temperatures of another facet of the same nodes.
void take_temperatures(const PointFacet& other, PointFacet& facet) {
    for (std::size_t i = 0; i < facet.u.size(); ++i) {
        facet.u[i] = facet.column.state_of(i, other.column.temperature(i, other.u[i]));
    }
}

}  // namespace

SpunUp spin_up(PointFacet& facet, const ThermalSurface& surface, Instant from, Instant to,
               double tolerance, const std::function<PointFacet(const ThermalSurface&)>& facet_of) {
    int passes = 0;
    if (ThermalSurface plain = surface; forget_freezing(plain)) {
        PointFacet first = facet_of(plain);
        take_temperatures(facet, first);
        passes = make_periodic(first, from, to, tolerance).passes;
        take_temperatures(first, facet);
    }
    PointFacet settled = facet_of(surface);
    settled.u = facet.u;
    SpunUp spun = make_periodic(settled, from, to, tolerance);
    facet.go_on_from(settled);
    spun.passes += passes;
    return spun;
}

}  // namespace diurna
