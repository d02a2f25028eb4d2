#pragma once

#include <span>
#include <string>

#include "materials/base/section.hpp"

namespace diurna {

inline constexpr const char* ground_name = "ground";

/// Outer faces of a part that touch those of another, or the ground.
struct ContactInput {
    std::string part, on;
    double film = 0.0;  // [W m⁻² K⁻¹]
    double gap = 0.02;  // [m] maximum distance
    std::string where{};
};

/// A table `contact` of an object or a part file. Mistakes are noted.
///
/// parts  names that it may give
ContactInput read_contact(const Section& section, std::span<const std::string> parts);

}  // namespace diurna
