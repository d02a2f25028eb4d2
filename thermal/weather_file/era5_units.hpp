#pragma once

#include <string>

namespace diurna {

/// The short name under which a variable of ERA5 or ERA5-Land is read: itself, or "ssrd" for
/// "avg_sdswrf" and for CDO's "var169"; "" for one that is not used.
std::string era5_name_of(const std::string& variable);

/// What turns a variable's numbers into the unit of its short name (Era5Values).
struct Era5Unit {
    double factor = 1.0, offset = 0.0;
};

/// Means of an hour [W m⁻²] become its sums, rates of rain [kg m⁻² s⁻¹] the depth of an hour.
/// Throws InputError(where) for a unit that the quantity cannot have.
///
/// - name: as from era5_name_of()
/// - variable: as in the file; "avg_..." without a unit is in W m⁻² or kg m⁻² s⁻¹
/// - units: the attribute; "": the store's own
Era5Unit era5_unit(const std::string& name, const std::string& variable, const std::string& units,
                   const std::string& where);

}  // namespace diurna
