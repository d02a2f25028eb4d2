#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "terrain/place/instant.hpp"

namespace diurna {

/// One quantity of every pixel, row by row from the upper left.
struct Plane {
    std::string name;          // "radiance.8-12", "temperature", "normal.X"
    std::string unit;          // "W m-2 sr-1", "K", "m", "1"
    std::vector<float> pixel;  // (row, column)
};

/// What an observer sees at one instant, as named planes of equal size.
///
///     radiance.BAND              W m-2 sr-1  at the aperture
///     apparent_temperature.BAND  K           of the black body of that radiance
///     TERM.BAND                  W m-2 sr-1  on request; they add up to radiance.BAND
///     temperature, range         K, m        at the pixel's centre; NaN where it is sky
///     facet, object, material    1           index at the pixel's centre, exact to 2^24; −1: sky
///     object_behind.BAND         1           object behind a net or pane at the pixel's centre,
///                                            −1: none; only in scenes with nets or panes
///     void                       1           1: ground filled in at missing elevations; −1: sky;
///                                            only where the scene has such ground
///     wet_share, snow_cover,     1           what lies at the pixel's centre; −1: sky; only of
///     scenes snow_albedo                            where water lies on any facet at any time
///     normal.X, .Y, .Z           1           east, north, up; NaN where it is sky
struct Frame {
    int width = 0, height = 0;
    Instant instant{};
    std::string observer;
    std::vector<Plane> planes;
    std::map<std::string, std::string> notes;       // written to files as text attributes
    std::map<std::string, std::string> attributes;  // the same, under exactly these names

    std::size_t pixels() const { return std::size_t(width) * std::size_t(height); }
    /// The plane of that name, or null.
    const Plane* find(std::string_view name) const;
    /// The plane of that name; throws InputError with the nearest name if there is none.
    const Plane& operator[](std::string_view name) const;
};

/// The planes and notes of one band and, with `truth`, the planes that belong to no band.
Frame band_frame(const Frame& frame, const std::string& band, bool truth = true);

/// "<observer>_<band>_<UTC>", valid as a file name: other characters than letters, digits, '.', '-'
/// become '-'.
std::string frame_name(const Frame& frame, const std::string& band);

}  // namespace diurna
