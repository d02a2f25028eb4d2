#pragma once

#include "thermal/weather_file/era5_series.hpp"

namespace diurna {

/// Makes sums since midnight, as ERA5-Land's files hold them, sums of one hour, and notes it.
///
/// A value of ssrd, strd, fdir or tp at 01:00 UTC is the hour's own, at 02:00 that of two hours,
/// ... at 00:00 that of the whole day before (ECMWF, ERA5-Land data documentation: "the
/// accumulations are from 00 UTC to the hour ending at the forecast step"). Each hour's own is the
/// difference from the row an hour before; without such a row it is missing.
///
/// Does nothing where no flux is more than one hour can bring, or where sums fall between 01:00 and
/// the next 00:00: then they are of another kind.
void take_sums_apart(Era5Series& series);

}  // namespace diurna
