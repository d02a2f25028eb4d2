#include "terrain/relief/march_kernel.hpp"

namespace diurna {

void march_avx2(const MarchField& field, const MarchWay& way, const MarchPart& part, float* tangent,
                std::ptrdiff_t tangent_pitch) {
    march(field, way, part, tangent, tangent_pitch);
}

}  // namespace diurna
