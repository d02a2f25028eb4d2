#include "thermal/surface_loops.hpp"

namespace diurna {

const SurfaceKernel surface_avx512{solve, near_steps};

}  // namespace diurna
