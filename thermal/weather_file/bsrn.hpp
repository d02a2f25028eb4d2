#pragma once

#include <filesystem>

#include "thermal/weather_file/weather_table.hpp"

namespace diurna {

/// A month of a BSRN station, station-to-archive (GCOS-174, Update of the Technical Plan for BSRN
/// Data Management, 2013). Of its logical records: 0001 gives the month, 0004 the place (latitude
/// from the south pole, longitude from 180° W), 0100 the basic measurements, 0300 reflected light.
///
/// Minutes 0 to 1439 of UTC days: a mean is stamped with its start. -999 and -99.9 are missing. No
/// wind; air at 2 m.
WeatherTable read_bsrn(const std::filesystem::path& file);

}  // namespace diurna
