#pragma once

#include "thermal/weather_file/era5_series.hpp"

namespace diurna {

/// Converts sums since midnight, as in ERA5-Land's files, to sums of one hour, and notes it.
///
/// A value of ssrd, strd, fdir or tp at 01:00 UTC is that of one hour, at 02:00 that of two hours,
/// ... at 00:00 that of the whole previous day (ECMWF, ERA5-Land data documentation: "the
/// accumulations are from 00 UTC to the hour ending at the forecast step"). Each hour's value is
/// the difference from the row an hour before; without such a row it is missing.
///
/// Does nothing if no flux exceeds the possible sum of one hour, or if sums decrease between 01:00
/// and the next 00:00: then they are not sums since midnight.
void take_sums_apart(Era5Series& series);

}  // namespace diurna
