#pragma once

#include <string>

/// What made a file, for files to say: in attributes, manifests, pages and labels.
namespace diurna {

/// The program and its version, "diurna 0.1.0".
std::string made_by();

/// The libraries it is built of with their versions, "Assimp 5.2.5, Boost 1.74.0, ...".
std::string made_with();

}  // namespace diurna
