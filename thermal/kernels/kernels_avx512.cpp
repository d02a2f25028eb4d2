#include "thermal/kernels/enthalpy_loops.hpp"
#include "thermal/kernels/mode_loops.hpp"
#include "thermal/kernels/shadow_edge_loops.hpp"

namespace diurna {

const SurfaceKernel surface_avx512{solve};
const ModeKernel modes_avx512{advance_all, split_some, balance_all};
const EnthalpyKernel enthalpy_avx512{solve_enthalpy, store_at, carry_enthalpy};

}  // namespace diurna
