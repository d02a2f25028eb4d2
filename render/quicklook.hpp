#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "render/frame.hpp"

namespace diurna {

struct QuicklookOptions {
    std::string title = {};  // one line above the picture; empty: observer, plane, instant
    std::optional<double> low_C = {},
                          high_C = {};  // ends of the scale [°C]; else percentiles 1 and 99
};

/// A plane of temperatures [K] as an 8-bit PNG with a title and a colour bar in °C. Colours follow
/// a palette whose lightness rises evenly, so that equal steps look equal. Not finite: grey.
void write_quicklook(const std::filesystem::path& path, const Frame& frame,
                     const std::string& plane, const QuicklookOptions& options = {});

/// Ends [°C] of the scale that a plane's percentiles give, widened to whole degrees: for a series
/// of pictures that shall share one.
struct ColourScale {
    double low_C, high_C;
};
ColourScale colour_scale(const Plane& plane);
/// The same over the pixels that see a facet, if the frame has the plane `temperature` to tell
/// them by: a cold sky shall not take up the colours.
ColourScale colour_scale(const Frame& frame, const std::string& plane);

/// The bare picture, each side divided by `shrink` (temperatures averaged), as PNG in memory: for
/// contact sheets.
std::vector<std::byte> encode_thumbnail(const Frame& frame, const std::string& plane,
                                        const ColourScale& scale, int shrink);

}  // namespace diurna
