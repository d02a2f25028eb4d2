#include "scenes/products/report/instrument_sheet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "materials/base/parallel.hpp"
#include "render/picture/exr.hpp"
#include "render/picture/grey_png.hpp"
#include "scenes/job/plan/frame_files.hpp"
#include "scenes/products/report/contact_sheet.hpp"

namespace diurna {

namespace {

/// `shrink` times `shrink` pixels are one.
GreyPicture shrunk(const Frame& frame, const Plane& plane, int shrink) {
    GreyPicture small{.width = std::max(1, frame.width / shrink),
                      .height = std::max(1, frame.height / shrink),
                      .bits = 8,
                      .count = {},
                      .scale = "display"};
    const auto at = [&](int column, int row) {
        column = std::min(column, frame.width - 1);
        row = std::min(row, frame.height - 1);
        return double{
            plane.pixel[std::size_t(row) * std::size_t(frame.width) + std::size_t(column)]};
    };
    for (int row = 0; row < small.height; ++row) {
        for (int column = 0; column < small.width; ++column) {
            double sum = 0.0;
            for (int j = 0; j < shrink; ++j) {
                for (int i = 0; i < shrink; ++i) sum += at(shrink * column + i, shrink * row + j);
            }
            const double mean = sum / (shrink * shrink);
            small.count.push_back(static_cast<std::uint16_t>(std::lround(mean)));
        }
    }
    return small;
}

}  // namespace

PictureSeries instrument_sheet(const std::filesystem::path& folder, const std::string& observer,
                               const std::string& band, const std::string& instrument,
                               const std::vector<Instant>& frames) {
    PictureSeries series{
        .heading = fmt::format("{}, {}: display of {}", observer, band, instrument),
        .picture = std::vector<SeriesPicture>(frames.size())};
    for_each_index(
        frames.size(),
        [&](std::size_t i) {
            const std::array<std::string, 1> wanted{"display." + band};
            const Frame frame =
                read_exr(folder / (instrument_base(observer, band, frames[i]) + ".exr"), wanted);
            const int shrink = page_shrink(frame.width, frame.height, frames.size());
            series.picture[i].when = frames[i];
            series.picture[i].png = grey_png(shrunk(frame, frame[wanted[0]], shrink));
        },
        1);
    return series;
}

}  // namespace diurna
