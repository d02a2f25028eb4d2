#include "scenes/products/report/movie.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "materials/base/parallel.hpp"
#include "render/picture/exr.hpp"
#include "render/picture/quicklook.hpp"
#include "scenes/job/input/bands.hpp"
#include "scenes/job/plan/sweep_folder.hpp"
#include "scenes/products/report/ffmpeg.hpp"

namespace diurna {

namespace fs = std::filesystem;

namespace {

/// Files of each (observer, band), in the order of their instants: their names end in those.
using SeriesFiles = std::map<std::pair<std::string, std::string>, std::vector<fs::path>>;

SeriesFiles series_in(const fs::path& folder, bool display) {
    const std::string place = display ? "instrument" : "frames";
    const std::string ending = display ? "_display.png" : ".exr";
    if (!fs::is_directory(folder / place)) {
        throw InputError(folder.string(),
                         fmt::format("found no folder {}, expected the folder of a run{}", place,
                                     display ? " with an [[instrument]]" : ""),
                         variant_hint(folder));
    }
    SeriesFiles all;
    for (const auto& entry : fs::directory_iterator(folder / place)) {
        std::string name = entry.path().filename().string();  // OBSERVER_BAND_UTC and ending
        if (!name.ends_with(ending)) continue;
        name.resize(name.size() - ending.size());
        const std::size_t last = name.rfind('_');
        const std::size_t first =
            last == std::string::npos || last == 0 ? std::string::npos : name.rfind('_', last - 1);
        if (first == std::string::npos) continue;
        all[{name.substr(0, first), name.substr(first + 1, last - first - 1)}].push_back(
            entry.path());
    }
    for (auto& [key, files] : all) std::sort(files.begin(), files.end());
    return all;
}

/// The requested one.
SeriesFiles::value_type chosen(const MovieOptions& options) {
    SeriesFiles all = series_in(options.folder, options.display);
    std::vector<std::string> known;
    for (const auto& [key, files] : all) {
        known.push_back(fmt::format("--observer {} --band {}", key.first, key.second));
    }
    std::erase_if(all, [&](const auto& entry) {
        return (!options.observer.empty() && entry.first.first != options.observer) ||
               (!options.band.empty() && entry.first.second != options.band);
    });
    if (all.size() == 1) return *all.begin();
    if (known.empty()) {
        throw InputError(options.folder.string(), options.display
                                                      ? "has no pictures of a display in instrument"
                                                      : "has no pictures in frames");
    }
    throw InputError(options.folder.string(),
                     fmt::format("{} series of pictures match, expected one of: {}", all.size(),
                                 fmt::join(known, "; ")));
}

/// What is shown of a band; one of the scene's own by its temperature.
std::string plane_of(const std::string& band) {
    try {
        return shown_plane(named_band({}, band));
    } catch (const InputError&) {
        return "apparent_temperature." + band;
    }
}

MovieKind kind_of(const fs::path& file, double pictures_per_second) {
    // GIF counts hundredths of a second (89a, 23), and viewers show what is below two as ten.
    constexpr double fastest_gif = 50.0;
    if (file.extension() == ".mp4") return MovieKind::mp4;
    if (file.extension() != ".gif") {
        throw InputError(file.string(), "expected a name that ends in .mp4 or .gif");
    }
    if (pictures_per_second > fastest_gif) {
        throw InputError("--fps", fmt::format("found {:g}, expected at most {:g} for a GIF",
                                              pictures_per_second, fastest_gif));
    }
    return MovieKind::gif;
}

}  // namespace

MovieReport write_movie(const MovieOptions& options) {
    const FilesRead opened;
    const auto [key, files] = chosen(options);
    MovieReport report{.file = options.file,
                       .pictures = files.size(),
                       .scale = {1e9, -1e9},
                       .plane = plane_of(key.second),
                       .unit = ""};
    if (report.file.empty()) {
        report.file = options.folder / fmt::format("{}_{}{}.mp4", key.first, key.second,
                                                   options.display ? "_display" : "");
    }
    const MovieKind kind = kind_of(report.file, options.pictures_per_second);
    std::vector<FileRead> inputs = opened.files();
    for (const fs::path& file : files) inputs.push_back({.path = file});
    check_output_file(report.file, inputs);
    FfmpegMovie movie(report.file, kind, options.pictures_per_second);
    if (options.display) {
        for (const fs::path& file : files) {
            const std::string png = read_text(file);
            movie.add(std::as_bytes(std::span(png)));
        }
        movie.finish();
        report.plane = "display";
        report.unit = "grey levels";
        report.scale = {0.0, 255.0};
        return report;
    }
    const std::array<std::string, 2> wanted = {report.plane, "temperature"};
    std::vector<ColourScale> scales(files.size());
    for_each_index(
        files.size(),
        [&, &paths = files](std::size_t i) {
            scales[i] = colour_scale(read_exr(paths[i], wanted), report.plane);
        },
        1);
    for (const ColourScale& own : scales) {
        report.scale = {std::min(report.scale.low, own.low), std::max(report.scale.high, own.high)};
    }
    for (const fs::path& file : files) {
        const Frame frame = read_exr(file, wanted);
        report.unit = colour_unit(frame[report.plane]);
        movie.add(encode_thumbnail(frame, report.plane, report.scale, 1));
    }
    movie.finish();
    return report;
}

}  // namespace diurna
