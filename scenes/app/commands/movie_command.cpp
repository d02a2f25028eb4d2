#include "scenes/app/commands/movie_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "materials/base/number_of.hpp"
#include "scenes/app/commands/number_option.hpp"
#include "scenes/products/report/movie.hpp"

namespace diurna {

void add_movie_verb(CLI::App& app) {
    const auto options = std::make_shared<MovieOptions>();
    CLI::App* verb =
        app.add_subcommand("movie", "make an MP4 or GIF from a run's pictures, by ffmpeg");
    verb->add_option("FOLDER", options->folder, "folder of a run")->required();
    verb->add_option("--observer", options->observer,
                     "name of the observer (required if the run has several)");
    verb->add_option("--band", options->band,
                     "band, as in the names of the pictures (required if the run has several)");
    verb->add_option("--out", options->file,
                     "FILE.mp4 or FILE.gif (default: OBSERVER_BAND.mp4 in the run's folder)");
    verb->add_flag("--display", options->display,
                   "pictures on the display of an [[instrument]] instead of those of the scene");
    within(verb->add_option("--fps", options->pictures_per_second,
                            "pictures per second (default: 10; GIF: at most 50)"),
           {0.1, 240.0});
    verb->callback([options] {
        const MovieReport report = write_movie(*options);
        fmt::print("{}, {} from {:g} to {:g} {}: {}\n", number_of(report.pictures, "picture"),
                   report.plane, report.scale.low, report.scale.high, report.unit,
                   report.file.string());
    });
}

}  // namespace diurna
