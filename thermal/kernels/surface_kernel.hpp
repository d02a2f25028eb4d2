#pragma once

#include "thermal/surface/heat_balance.hpp"

namespace diurna {

/// What a width of vectors offers.
struct SurfaceKernel {
    SurfaceCount (*solve)(const AirFilm&, const SurfaceLanes&);
};
extern const SurfaceKernel surface_avx2, surface_avx512;

/// Whether the processor has AVX-512; else it has AVX2.
bool wide_vectors();

}  // namespace diurna
