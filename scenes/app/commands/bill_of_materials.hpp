#pragma once

#include <string>

namespace diurna {

/// The libraries the program is built with, their versions, licences and packages of Debian 12, as
/// CycloneDX 1.4 in JSON: a software bill of materials for installations that require one.
std::string bill_of_materials();

}  // namespace diurna
