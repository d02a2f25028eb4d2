#include "thermal/mode_loops.hpp"
#include "thermal/split_loops.hpp"

namespace diurna {

const SurfaceKernel surface_avx512{solve};
const ModeKernel modes_avx512{advance_all, split_some};

}  // namespace diurna
