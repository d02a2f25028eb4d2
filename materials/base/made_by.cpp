#include "materials/base/made_by.hpp"

namespace diurna {

std::string made_by() { return "diurna " DIURNA_VERSION; }

std::string made_with() { return DIURNA_LIBRARIES; }

}  // namespace diurna
