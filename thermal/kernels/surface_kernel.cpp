#include "thermal/kernels/surface_kernel.hpp"

#include "thermal/kernels/enthalpy_kernel.hpp"

namespace diurna {

bool wide_vectors() {
    static const bool wide =
        __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
        __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
        __builtin_cpu_supports("avx512vl");
    return wide;
}

SurfaceCount solve_surface(const AirFilm& air, const SurfaceLanes& surface) {
    return (wide_vectors() ? surface_avx512 : surface_avx2).solve(air, surface);
}

const EnthalpyKernel& enthalpy_kernel() { return wide_vectors() ? enthalpy_avx512 : enthalpy_avx2; }

}  // namespace diurna
