#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace diurna {

/// A unit that a raster's heights may have.
struct HeightUnit {
    double metres;     // per unit
    const char* name;  // "US survey foot"
};

/// The unit of a spelling, ignoring case, blanks, underscores, dots, brackets and plurals: metre
/// (m, meters, "m above sea level"), dm, cm, mm, km, international foot (ft, feet, Foot), US survey
/// foot (us-ft, ftUS, Foot_US, US_survey_feet), geopotential (m2 s-2, m**2/s**2, J/kg: height times
/// 9.80665 m s⁻²), geopotential metre (gpm) and decametre. Nullopt: not known.
///
/// Factors: CGPM 1901 (standard gravity), NIST SP 811 (foot), 1200/3937 m (US survey foot).
std::optional<HeightUnit> height_unit(std::string_view spelling);

}  // namespace diurna
