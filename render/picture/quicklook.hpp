#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "materials/radiation/band.hpp"
#include "render/picture/colour_scale.hpp"
#include "render/picture/frame.hpp"

namespace diurna {

/// The plane shown for a band: radiance where sunlight exceeds emission by day (its middle below 3
/// µm), apparent temperature otherwise.
std::string shown_plane(const Band& band);

/// A plane as an 8-bit PNG with a title and a bar. Temperatures [K] are shown in °C by colours with
/// linearly increasing lightness, other quantities in their unit by a grey of proportional
/// luminance. Values that are not finite: dark grey.
void write_quicklook(const std::filesystem::path& path, const Frame& frame,
                     const std::string& plane);

/// The picture only, each side divided by `shrink` (values averaged), as PNG in memory: for contact
/// sheets.
std::vector<std::byte> encode_thumbnail(const Frame& frame, const std::string& plane,
                                        const ColourScale& scale, int shrink);

}  // namespace diurna
