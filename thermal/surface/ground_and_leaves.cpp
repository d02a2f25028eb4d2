#include "thermal/surface/ground_and_leaves.hpp"

#include "thermal/surface/canopy.hpp"
#include "thermal/surface/surface_part.hpp"

namespace diurna {

SurfaceTerms surface_terms(const SurfaceConditions& c, double ground) {
    if (const auto* leaf = std::get_if<BigLeaf>(&c.canopy)) {
        return skin_terms(c, leaf->skin_conductance, ground);
    }
    if (const auto* two = std::get_if<TwoSource>(&c.canopy)) {
        return two_source_terms(c, *two, ground);
    }
    if (c.snow_conductance > 0.0) return skin_terms(c, c.snow_conductance, ground);
    const PartTerms e = part_terms(c, whole_ground(c), ground);
    SurfaceTerms terms{};
    terms.balance.internal = c.internal;
    add(e, terms);
    terms.radiometric = terms.leaf = ground;
    terms.into_ground = e.flux;
    terms.into_ground_slope = e.slope;
    return terms;
}

}  // namespace diurna
