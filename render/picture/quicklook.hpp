#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "materials/radiation/band.hpp"
#include "render/picture/colour_scale.hpp"
#include "render/picture/frame.hpp"

namespace diurna {

/// The plane that shows what a band sees: radiance where sunlight outshines emission by day (its
/// middle below 3 µm), apparent temperature elsewhere.
std::string shown_plane(const Band& band);

/// A plane as an 8-bit PNG with a title and a bar. Temperatures [K] are shown in °C by colours
/// whose lightness rises evenly, any other quantity in its own unit by grey as light as it.
/// Not finite: dark grey.
void write_quicklook(const std::filesystem::path& path, const Frame& frame,
                     const std::string& plane);

/// The bare picture, each side divided by `shrink` (values averaged), as PNG in memory: for
/// contact sheets.
std::vector<std::byte> encode_thumbnail(const Frame& frame, const std::string& plane,
                                        const ColourScale& scale, int shrink);

}  // namespace diurna
