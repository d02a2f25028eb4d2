#pragma once

#include <string>

/// Program and version for files that it writes: attributes, manifests, pages and labels.
namespace diurna {

/// The program and its version, "diurna 0.1.0".
std::string made_by();

/// The libraries it is built of with their versions, "Boost 1.74.0, CGAL 5.5.1, ...".
std::string made_with();

}  // namespace diurna
