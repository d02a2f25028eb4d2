#include "scenes/report/contact_sheet.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "materials/base/parallel.hpp"
#include "render/picture/exr.hpp"
#include "render/picture/quicklook.hpp"
#include "scenes/plan/frame_files.hpp"
#include "scenes/report/html.hpp"

namespace diurna {

namespace fs = std::filesystem;

namespace {

/// The plane to be shown of every frame, with the one that tells sky from ground.
std::vector<Frame> shown_frames(const fs::path& folder, const std::string& observer,
                                const Band& band, const std::vector<Instant>& frames) {
    const std::string plane = shown_plane(band);
    std::vector<Frame> pictures(frames.size());
    for_each_index(
        frames.size(),
        [&](std::size_t i) {
            const Frame whole =
                read_exr(folder / (frame_base(observer, band.name, frames[i]) + ".exr"));
            pictures[i] = whole;
            pictures[i].planes = {whole[plane]};
            if (const Plane* solid = whole.find("temperature")) {
                pictures[i].planes.push_back(*solid);
            }
        },
        1);
    return pictures;
}

}  // namespace

std::string contact_sheet(const fs::path& folder, const std::string& observer, const Band& band,
                          const std::vector<Instant>& frames,
                          const std::function<std::string(Instant)>& caption) {
    const std::string plane = shown_plane(band);
    const std::vector<Frame> pictures = shown_frames(folder, observer, band, frames);
    ColourScale scale{1e9, -1e9};
    for (const Frame& picture : pictures) {
        const ColourScale own = colour_scale(picture, plane);
        scale = {std::min(scale.low, own.low), std::max(scale.high, own.high)};
    }
    std::vector<std::string> figures(frames.size());
    for_each_index(
        frames.size(),
        [&](std::size_t i) {
            const std::vector<std::byte> png = encode_thumbnail(pictures[i], plane, scale, 2);
            figures[i] = fmt::format(
                "<figure><img alt=\"{0}\" "
                "src=\"data:image/png;base64,{1}\"/><figcaption>{0}</figcaption>"
                "</figure>\n",
                caption(frames[i]), base64(png));
        },
        1);
    const bool radiance = plane.starts_with("radiance");
    std::string out = fmt::format(
        "<h3>{}, {}, {:g} to {:g} µm: {} {:.3g} to {:.3g} {}</h3>\n<div class=\"sheet\">\n",
        escaped(observer), escaped(band.name), band.from_um(), band.to_um(),
        radiance ? "radiance" : "apparent temperature", scale.low, scale.high,
        colour_unit(pictures.front()[plane]));
    for (const std::string& figure : figures) out += figure;
    return out + "</div>\n";
}

}  // namespace diurna
