#pragma once

#include <string>
#include <vector>

#include "render/instrument/instrument.hpp"

namespace diurna {

/// Generic cameras: typical values, of no maker's product. presets.cpp has the sources.
///
///     cooled_mwir    InSb or HgCdTe at 77 K, 15 µm, f/2.5, for 3-5 µm
///     uncooled_lwir  vanadium oxide, 12 µm, f/1, for 8-14 µm
///     swir           InGaAs, 15 µm, f/2, for 0.9-1.7 µm
///     visible        silicon, 3.45 µm, f/4, for 0.4-0.7 µm
std::vector<std::string> preset_names();
/// Throws InputError with the nearest name.
Instrument preset(const std::string& name);

}  // namespace diurna
