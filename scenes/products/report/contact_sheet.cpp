#include "scenes/products/report/contact_sheet.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "materials/base/parallel.hpp"
#include "render/picture/exr.hpp"
#include "render/picture/quicklook.hpp"
#include "scenes/job/plan/frame_files.hpp"

namespace diurna {

namespace fs = std::filesystem;

namespace {

/// The plane to be shown of every frame, with the one that reports sky from ground.
std::vector<Frame> shown_frames(const fs::path& folder, const std::string& observer,
                                const Band& band, const std::vector<Instant>& frames) {
    const std::vector<std::string> planes{shown_plane(band), "temperature"};
    std::vector<Frame> pictures(frames.size());
    for_each_index(
        frames.size(),
        [&](std::size_t i) {
            pictures[i] =
                read_exr(folder / (frame_base(observer, band.name, frames[i]) + ".exr"), planes);
        },
        1);
    return pictures;
}

}  // namespace

int page_shrink(int width, int height, std::size_t pictures) {
    constexpr double room = 2.5e6;  // pixels: about 1.5 MB of PNG on each scale
    int shrink = 1;
    while (double(width) * height * double(pictures) / (shrink * shrink) > room) ++shrink;
    return shrink;
}

PictureSeries contact_sheet(const fs::path& folder, const std::string& observer, const Band& band,
                            const std::vector<Instant>& frames) {
    const std::string plane = shown_plane(band);
    const std::vector<Frame> pictures = shown_frames(folder, observer, band, frames);
    const bool radiance = plane.starts_with("radiance");
    PictureSeries series{
        .heading = fmt::format("{}, {}, {:g} to {:g} µm: {}", observer, band.name, band.from_um(),
                               band.to_um(), radiance ? "radiance" : "apparent temperature"),
        .unit = colour_unit(pictures.front()[plane]),
        .warm = !radiance,
        .low = 1e9,
        .high = -1e9,
        .picture = std::vector<SeriesPicture>(frames.size())};
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const ColourScale own = colour_scale(pictures[i], plane);
        series.picture[i] = {.when = frames[i], .low = own.low, .high = own.high};
        series.low = std::min(series.low, own.low);
        series.high = std::max(series.high, own.high);
    }
    const int shrink =
        page_shrink(pictures.front().width, pictures.front().height, pictures.size());
    for_each_index(
        frames.size(),
        [&](std::size_t i) {
            SeriesPicture& one = series.picture[i];
            one.png = encode_thumbnail(pictures[i], plane, {one.low, one.high}, shrink);
            one.common = encode_thumbnail(pictures[i], plane, {series.low, series.high}, shrink);
        },
        1);
    return series;
}

}  // namespace diurna
