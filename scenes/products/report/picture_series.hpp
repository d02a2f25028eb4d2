#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "scenes/job/plan/prepared.hpp"
#include "terrain/place/instant.hpp"

namespace diurna {

/// One picture of a series as PNG.
struct SeriesPicture {
    Instant when{};
    std::vector<std::byte> png{};     // on its own scale
    std::vector<std::byte> common{};  // on the scale of the series; empty: none
    double low = 0.0, high = 0.0;     // ends of its own scale
};

/// The pictures of one observer in one band, in the order of time.
struct PictureSeries {
    std::string heading;
    std::string unit{};            // of the scales; "": pictures without a scale
    bool warm = true;              // colours of temperature, else grey
    double low = 0.0, high = 0.0;  // ends of the common scale
    std::vector<SeriesPicture> picture{};
};

/// A contact sheet as HTML, each picture with the scene's clock, the date and solar time: with a
/// choice between separate scales and a common one, the bar of their colours, and a slider that
/// shows one of them large (page_script()). Without scripts the sheet and the choice remain.
///
/// number  of the series in the page, for unique element names
std::string picture_series(const PictureSeries& series, const Prepared& prepared,
                           std::size_t number);

}  // namespace diurna
