#pragma once

#include "thermal/heat_balance.hpp"

namespace diurna {

/// What a width offers: solve_surface and the two plain steps of solve_surface_near.
struct SurfaceKernel {
    SurfaceCount (*solve)(const AirFilm&, const SurfaceLanes&);
    double (*two_steps)(const AirFilm&, const SurfaceLanes&);
};
extern const SurfaceKernel surface_avx2, surface_avx512;

}  // namespace diurna
