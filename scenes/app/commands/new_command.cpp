#include "scenes/app/commands/new_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "materials/base/number_of.hpp"
#include "materials/base/plain_text.hpp"
#include "materials/base/units.hpp"
#include "scenes/app/commands/first_scene.hpp"
#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/plan/plan_text.hpp"
#include "scenes/job/plan/prepared.hpp"
#include "terrain/place/local_time.hpp"
#include "terrain/raster/dem_places.hpp"
#include "terrain/raster/read_dem.hpp"
#include "thermal/weather_file/foreign_columns.hpp"
#include "thermal/weather_file/read_weather.hpp"

namespace diurna {

namespace {

namespace fs = std::filesystem;

constexpr double largest_radius = 2000.0, least_radius = 60.0;  // [m]

struct NewArguments {
    fs::path folder, dem, weather;
    std::string at;
};

/// "36.32,-84.2": degrees north and east.
Geodetic new_place(const std::string& text) {
    Geodetic place;
    char rest = 0;
    if (std::sscanf(text.c_str(), "%lf,%lf%c", &place.latitude_deg, &place.longitude_deg, &rest) !=
            2 ||
        !(std::abs(place.latitude_deg) <= 90.0) || !(std::abs(place.longitude_deg) <= 180.0)) {
        throw InputError("--at " + text,
                         "expected latitude and longitude in degrees: 36.32,-84.203");
    }
    return place;
}

/// "36.32000 N, 105.92000 W".
std::string place_words(const Geodetic& place) {
    return fmt::format("{:.5f} {}, {:.5f} {}", std::abs(place.latitude_deg),
                       place.latitude_deg < 0.0 ? 'S' : 'N', std::abs(place.longitude_deg),
                       place.longitude_deg < 0.0 ? 'W' : 'E');
}

/// [m] from a place to the raster's nearest edge.
double room_around(const Dem& dem, const Geodetic& place) {
    const Eigen::Vector2d post = raster_places(dem, std::span(&place, 1)).front();
    const Eigen::Vector2d spacing = post_spacing(dem);
    const double columns = std::min(post.x(), dem.columns - 1.0 - post.x());
    const double rows = std::min(post.y(), dem.rows - 1.0 - post.y());
    return std::min(columns * spacing.x(), rows * spacing.y());
}

/// Copies what a reader has opened of a file and beside it.
std::string take_along(const fs::path& file, const std::vector<FileRead>& opened,
                       const fs::path& folder) {
    for (const FileRead& one : opened) {
        std::error_code none;
        if (!fs::equivalent(one.path.parent_path().empty() ? "." : one.path.parent_path(),
                            file.parent_path().empty() ? "." : file.parent_path(), none)) {
            continue;
        }
        fs::copy_file(one.path, folder / one.path.filename());
    }
    if (!fs::exists(folder / file.filename())) fs::copy_file(file, folder / file.filename());
    return file.filename().string();
}

bool has_calendar_year(WeatherFormat format) {
    return format == WeatherFormat::epw || format == WeatherFormat::tmy3 ||
           format == WeatherFormat::pvgis;
}

/// Whether a file has weather for the scene's span; a typical year has, whatever its years.
bool covers_span(const fs::path& file, const FirstScene& scene) {
    try {
        WeatherOptions options;
        options.asked = {.begin = scene.start,
                         .end = later(scene.start, 3600.0 * scene.duration_h)};
        read_weather(file, options);
        return true;
    } catch (const InputError&) {
        return false;
    }
}

/// Of the midnights from `first` to `last`, the nearest to the scene's date in any year.
Instant nearest_midnight(const FirstScene& scene, Instant first, Instant last) {
    using namespace std::chrono;
    const auto date_of = [&](Instant instant) {
        return year_month_day(floor<days>(later(instant, scene.utc_offset)));
    };
    const year_month_day usual = date_of(scene.start);
    Instant nearest = first;
    double least = 1e18;
    for (year y = date_of(first).year() - years(1); y <= date_of(last).year() + years(1); ++y) {
        const Instant wanted = later(sys_days(y / usual.month() / usual.day()), -scene.utc_offset);
        const Instant there = std::clamp(wanted, first, last);
        const double away = std::abs(seconds_between(wanted, there));
        if (away < least) {
            least = away;
            nearest = there;
        }
    }
    return nearest;
}

/// A day that the file covers: of files of a year the one nearest to the scene's date, else the
/// first; or what there is.
void choose_span(const fs::path& file, FirstScene& scene) {
    const bool of_year = has_calendar_year(weather_format(file));
    if (of_year && covers_span(file, scene)) return;
    const std::vector<RecognisedColumn> recognised = recognised_columns_of(file);
    scene.columns = as_declarations(recognised);
    WeatherOptions options;
    options.columns = declared_columns(recognised);
    const Weather weather = read_weather(file, options);
    const Instant first = weather.instant.front(), last = weather.instant.back();
    const auto day = std::chrono::days(1);
    const auto ahead = std::chrono::milliseconds(std::llround(1000.0 * scene.utc_offset));
    Instant midnight = std::chrono::ceil<std::chrono::days>(first + ahead) - ahead;
    const Instant slack = later(last, 3600.0);  // the last row is held so long
    if (midnight + day <= slack) {
        if (of_year) {
            const Instant latest =
                std::chrono::floor<std::chrono::days>(slack - day + ahead) - ahead;
            midnight = nearest_midnight(scene, midnight, latest);
            scene.date_note = fmt::format(
                "{}: has weather from {} to {}; the scene's day is {:.10}, the nearest to {:.10}",
                file.string(), format_instant(first), format_instant(last),
                format_local(midnight, scene.utc_offset),
                format_local(scene.start, scene.utc_offset));
        }
        scene.start = midnight;
        return;
    }
    scene.start = std::chrono::ceil<std::chrono::hours>(first);
    scene.duration_h = std::floor(seconds_between(scene.start, last) / 3600.0);
    if (scene.duration_h < 1.0) {
        throw InputError(file.string(), "covers less than an hour, expected at least one day");
    }
}

/// Mistakes of a weather file's columns, with what can be done here, where there is no scene yet.
std::vector<Mistake> with_remedy_for_columns(std::vector<Mistake> mistakes) {
    for (Mistake& one : mistakes) {
        if (one.hint.find("[weather.columns]") == std::string::npos) continue;
        one.hint +=
            "; for that, run `new` without --weather, then set weather.file and [weather.columns] "
            "in scene.toml, or rename the columns";
    }
    return mistakes;
}

/// What of the files goes into a folder that is there and empty.
FirstScene fill(const NewArguments& a, const fs::path& folder) {
    FirstScene scene{.name = fs::absolute(a.folder).lexically_normal().filename().string(),
                     .elevation = {},
                     .weather = "weather.csv",
                     .place = {},
                     .start = {}};
    std::vector<FileRead> opened;
    {
        const FilesRead watching;
        const Dem dem = read_dem(a.dem, {.voids = VoidPolicy::leave});
        scene.fills_voids = dem.voids > 0;
        scene.place = a.at.empty() ? dem_centre(dem) : new_place(a.at);
        const double room = room_around(dem, scene.place);
        if (!(room >= 0.0)) {
            throw InputError(a.dem.string(),
                             fmt::format("does not contain {}, expected a place inside it",
                                         place_words(scene.place)));
        }
        if (room < least_radius) {
            throw InputError(
                a.dem.string(),
                fmt::format("extends only {:.0f} m around {}, expected at least {:.0f} m", room,
                            place_words(scene.place), least_radius));
        }
        scene.radius = std::floor(std::min(largest_radius, 0.98 * room));
        opened = watching.files();
    }
    scene.elevation = take_along(a.dem, opened, folder);
    scene.utc_offset = 3600.0 * std::round(scene.place.longitude_deg / 15.0);
    const bool north = scene.place.latitude_deg >= 0.0;
    const std::string summer = north ? "2026-07-15T00:00:00Z" : "2026-01-15T00:00:00Z";
    scene.start = later(parse_instant(summer), -scene.utc_offset);
    if (a.weather.empty()) {
        scene.weather_made_up = true;
        write_whole_file(folder / scene.weather, clear_day(scene.start, scene.utc_offset));
    } else {
        try {
            choose_span(a.weather, scene);
        } catch (const InputError& error) {
            throw InputError(with_remedy_for_columns(error.mistakes()));
        }
        scene.weather = take_along(a.weather, {}, folder);
    }
    return scene;
}

void new_verb(const NewArguments& a) {
    std::error_code none;
    if (fs::exists(a.folder, none)) {
        throw InputError(a.folder.string(), "exists, expected the name of a new folder");
    }
    if (!fs::create_directory(a.folder, none)) {
        throw InputError(a.folder.string(), "cannot create the folder: " + none.message());
    }
    try {
        const FirstScene scene = fill(a, a.folder);
        const fs::path file = a.folder / "scene.toml";
        write_whole_file(file, first_scene_text(scene));
        const Prepared prepared = prepare(read_scene(file));
        fmt::print("{}: {}, {}, from {} for {:g} h{}\n", file.string(),
                   number_of(prepared.world.surfaces().size(), "facet"),
                   picture_counts(prepared.plan), format_local(scene.start, scene.utc_offset),
                   scene.duration_h,
                   scene.weather_made_up ? "; the weather is generated, not measured" : "");
        fmt::print("next: diurna run {} --out {}\n", file.string(), (a.folder / "out").string());
        if (!scene.columns.empty()) {
            fmt::print(stderr, "note: {}: columns are read as {}\n", scene.weather,
                       plain(fmt::format("{}", fmt::join(scene.columns, ", "))));
        }
        if (!scene.date_note.empty()) fmt::print(stderr, "note: {}\n", plain(scene.date_note));
        for (const Mistake& one : prepared.warnings)
            fmt::print(stderr, "warning: {}\n", plain(one.line()));
        for (const std::string& note : prepared.notes)
            fmt::print(stderr, "note: {}\n", plain(note));
    } catch (...) {
        fs::remove_all(a.folder, none);
        throw;
    }
}

}  // namespace

void add_new_verb(CLI::App& app) {
    const auto a = std::make_shared<NewArguments>();
    CLI::App* verb =
        app.add_subcommand("new", "write a first scene for a place from its elevation data");
    verb->add_option("FOLDER", a->folder, "new folder; its name becomes the scene's name")
        ->required();
    verb->add_option("--dem", a->dem, "elevation of the place (a raster that GDAL reads)")
        ->required();
    verb->add_option("--weather", a->weather,
                     "EPW, TMY3, SURFRAD, BSRN, ERA5 or CSV file (default: a generated clear day)");
    verb->add_option("--at", a->at,
                     "LATITUDE,LONGITUDE of the centre (default: centre of the raster)");
    verb->callback([a] { new_verb(*a); });
}

}  // namespace diurna
