#pragma once

#include <span>
#include <string>

#include "scenes/products/export/run_heat.hpp"

namespace diurna {

/// A line for each stored instant (or those given) and group, one group after the other:
///
///     utc,local_time,kind,name,facets,area_m2,mean_K,least_K,most_K
///
/// The mean is weighted by area. Facets of textures' levels count each with its whole area; both
/// sides of a sheet count. The first line is the header; names with commas are quoted.
std::string curve_csv(const RunHeat& heat, std::span<const NamedGroup> groups,
                      std::span<const Instant> instants);

}  // namespace diurna
