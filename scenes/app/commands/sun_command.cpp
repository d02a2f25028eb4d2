#include "scenes/app/commands/sun_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>

#include "materials/base/error.hpp"
#include "scenes/app/commands/number_option.hpp"
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
    within(verb->add_option("--latitude-deg", a->latitude_deg, "latitude, positive north"),
           {-90.0, 90.0})
        ->required();
    within(verb->add_option("--longitude-deg", a->longitude_deg, "longitude, positive east"),
           {-360.0, 360.0})
        ->required();
    within(verb->add_option("--height-m", a->height_m, "height above the ellipsoid (default: 0)"),
           {-1e4, 1e5}, "m");
    verb->add_option("--time", a->time, "instant, ISO 8601 with UTC offset")->required();
    within(verb->add_option("--pressure-hPa", a->pressure_hPa, "air pressure; adds refraction"),
           {0.0, 1200.0}, "hPa");
    within(verb->add_option("--temperature-C", a->temperature_C,
                            "air temperature, for refraction (default: 15)"),
           {-100.0, 80.0}, "degC");
    verb->callback([a] { sun_verb(*a); });
}

}  // namespace diurna
