#include "scenes/report/instrument_sheet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "materials/base/parallel.hpp"
#include "render/picture/exr.hpp"
#include "render/picture/grey_png.hpp"
#include "scenes/plan/frame_files.hpp"
#include "scenes/report/html.hpp"

namespace diurna {

namespace {

/// Four pixels are one.
GreyPicture halved(const Frame& frame, const Plane& plane) {
    GreyPicture small{.width = std::max(1, frame.width / 2),
                      .height = std::max(1, frame.height / 2),
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
            const int c = 2 * column, r = 2 * row;
            const double mean = (at(c, r) + at(c + 1, r) + at(c, r + 1) + at(c + 1, r + 1)) / 4.0;
            small.count.push_back(static_cast<std::uint16_t>(std::lround(mean)));
        }
    }
    return small;
}

}  // namespace

std::string instrument_sheet(const std::filesystem::path& folder, const std::string& observer,
                             const std::string& band, const std::string& instrument,
                             const std::vector<Instant>& frames,
                             const std::function<std::string(Instant)>& caption) {
    std::vector<std::string> figures(frames.size());
    for_each_index(
        frames.size(),
        [&](std::size_t i) {
            const std::array<std::string, 1> wanted{"display." + band};
            const Frame frame =
                read_exr(folder / (instrument_base(observer, band, frames[i]) + ".exr"), wanted);
            figures[i] = fmt::format(
                "<figure><img alt=\"{0}\" "
                "src=\"data:image/png;base64,{1}\"/><figcaption>{0}</figcaption>"
                "</figure>\n",
                caption(frames[i]), base64(grey_png(halved(frame, frame[wanted[0]]))));
        },
        1);
    std::string out = fmt::format("<h3>{}, {}: display of {}</h3>\n<div class=\"sheet\">\n",
                                  escaped(observer), escaped(band), escaped(instrument));
    for (const std::string& figure : figures) out += figure;
    return out + "</div>\n";
}

}  // namespace diurna
