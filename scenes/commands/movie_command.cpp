#include "scenes/commands/movie_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "scenes/commands/number_option.hpp"
#include "scenes/report/movie.hpp"

namespace diurna {

void add_movie_verb(CLI::App& app) {
    const auto options = std::make_shared<MovieOptions>();
    CLI::App* verb = app.add_subcommand("movie", "a run's pictures as MP4 or GIF, by ffmpeg");
    verb->add_option("FOLDER", options->folder, "of a run")->required();
    verb->add_option("--observer", options->observer, "whose pictures; needed of several");
    verb->add_option("--band", options->band, "as in the names of the pictures; needed of several");
    verb->add_option("--out", options->file,
                     "FILE.mp4 or FILE.gif (default: OBSERVER_BAND.mp4 in the folder)");
    within(verb->add_option("--fps", options->pictures_per_second,
                            "pictures a second (default: 10; of a GIF 50 at most)"),
           {0.1, 240.0});
    verb->callback([options] {
        const MovieReport report = write_movie(*options);
        fmt::print("{} pictures, {} from {:g} to {:g} {}: {}\n", report.pictures, report.plane,
                   report.scale.low, report.scale.high, report.unit, report.file.string());
    });
}

}  // namespace diurna
