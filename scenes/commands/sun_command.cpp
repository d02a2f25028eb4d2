#include "scenes/commands/sun_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>
#include <optional>
#include <string>

#include "materials/base/error.hpp"
#include "terrain/place/instant.hpp"
#include "terrain/place/sun.hpp"

namespace diurna {

namespace {

struct SunArguments {
    double latitude_deg = 0.0, longitude_deg = 0.0, height_m = 0.0;
    std::string time;
    std::optional<double> pressure_hPa;
    double temperature_C = 15.0;
};

void sun_verb(const SunArguments& arguments) {
    if (!(std::abs(arguments.latitude_deg) <= 90.0)) {
        throw InputError("--latitude-deg",
                         fmt::format("found {:g}, expected -90 to 90", arguments.latitude_deg));
    }
    if (!(std::abs(arguments.longitude_deg) <= 360.0)) {
        throw InputError("--longitude-deg",
                         fmt::format("found {:g}, expected -360 to 360", arguments.longitude_deg));
    }
    const Site site{arguments.latitude_deg, arguments.longitude_deg, arguments.height_m};
    const Instant instant = parse_instant(arguments.time, "--time");
    const SunPosition sun =
        arguments.pressure_hPa
            ? sun_position(site, instant, *arguments.pressure_hPa, arguments.temperature_C)
            : sun_position(site, instant);
    fmt::print("azimuth_deg,elevation_deg,distance_au\n{:.6f},{:.6f},{:.9f}\n", sun.azimuth_deg,
               sun.elevation_deg, sun.distance_au);
}

}  // namespace

void add_sun_verb(CLI::App& app) {
    const auto a = std::make_shared<SunArguments>();
    CLI::App* verb = app.add_subcommand("sun", "azimuth, elevation and distance of the sun");
    verb->add_option("--latitude-deg", a->latitude_deg)->required();
    verb->add_option("--longitude-deg", a->longitude_deg)->required();
    verb->add_option("--height-m", a->height_m);
    verb->add_option("--time", a->time, "ISO 8601 with offset")->required();
    verb->add_option("--pressure-hPa", a->pressure_hPa, "adds refraction");
    verb->add_option("--temperature-C", a->temperature_C);
    verb->callback([a] { sun_verb(*a); });
}

}  // namespace diurna
