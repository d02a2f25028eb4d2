#include "scenes/job/input/read_air.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>

#include "materials/air/radiosonde.hpp"
#include "materials/atmosphere/haze_column.hpp"
#include "materials/atmosphere/path_file.hpp"

namespace diurna {

namespace {

/// The table of paths, its own mistakes reported where the scene names it.
void read_table(const Section& section, AirInput& air) {
    air.table_file =
        section.file("table",
                     "a MODTRAN 4/5 tape7 that replaces the embedded atmosphere: IEMSCT 1 or 2, "
                     "one run per path, from every H1 to every H2 and to space; for bands above 3 "
                     "µm, without scattered sunlight, the same at every instant");
    if (air.vacuum) section.mistake("table", "a vacuum has no table of paths");
    if (!std::filesystem::is_regular_file(air.table_file)) return;
    try {
        air.table = read_path_table(air.table_file);
    } catch (const InputError& error) {
        section.mistake("table", error.mistakes().front().line());
    } catch (const std::runtime_error& error) {
        section.mistake("table", fmt::format("{}: {}", air.table_file.string(), error.what()));
    }
}

void read_sounding(const Section& section, AirInput& air) {
    air.sounding_file = section.file(
        "sounding",
        "a radiosonde ascent that replaces the profile up to its top level: list of the University "
        "of Wyoming, file of the Integrated Global Radiosonde Archive (IGRA v2), or CSV with "
        "height, pressure, temperature and humidity as in materials/air/radiosonde.hpp; the same "
        "at every instant, except that its lowest 1.5 km are adjusted to the weather");
    const std::string time = section.text_or(
        "sounding_time",
        "time of the sounding in an IGRA file with several, such as 2018-07-15T00 (UTC)", "");
    if (air.vacuum) section.mistake("sounding", "a vacuum has no sounding");
    if (air.vacuum || !std::filesystem::is_regular_file(air.sounding_file)) return;
    try {
        air.sounding = std::make_shared<const Profile>(
            read_radiosonde(air.sounding_file, air.by_season ? "" : air.profile, time));
    } catch (const InputError& error) {
        section.mistake("sounding", error.mistakes().front().line());
    }
}

}  // namespace

AirInput read_air(const Section& section) {
    std::vector<std::string> profiles = afgl_profile_names();
    profiles.insert(profiles.end(), {"season", "vacuum"});
    AirInput air;
    air.profile =
        section.word_or("profile",
                        "AFGL profile; season: between the two AFGL profiles whose "
                        "temperatures enclose the mean of the weather's; at the ground "
                        "it is replaced by the weather's air, with a transition up to "
                        "1.5 km; vacuum: no air: sunlight that was not measured is that in "
                        "space, the sky sends no light and no longwave radiation",
                        air.profile, profiles);
    air.vacuum = air.profile == "vacuum";
    air.by_season = air.profile == "season";
    air.aerosol = section.word_or("aerosol", "type of the haze near the ground", air.aerosol,
                                  aerosol_names());
    air.visibility_km = section.number_or("visibility_km", "visibility in the haze near the ground",
                                          air.visibility_km, {0.05, 300.0});
    air.co2_ppm = section.number_or("co2_ppm", "volume mixing ratio of carbon dioxide", air.co2_ppm,
                                    {0.0, 10000.0});
    air.cloud_base_km = section.number_or(
        "cloud_base_km", "height of the cloud base above the ground, for the weather's cloud cover",
        air.cloud_base_km, {0.05, 15.0});
    air.cloud_depth_km = section.number_or(
        "cloud_depth_km",
        "thickness of the cloud; observers above it see the temperature of its top",
        air.cloud_depth_km, {0.0, 10.0});
    if (section.has("sounding")) read_sounding(section, air);
    const bool has_fluxes = !air.vacuum && !section.has("table");
    air.drives_heat = section.flag_or(
        "drives_heat",
        "compute sunlight and longwave radiation that were not measured from this atmosphere; "
        "false: from the broadband formulas of [sky]. Pictures and heat balance use the same "
        "radiation. The default is false with a table, which has no fluxes, and in a vacuum, where "
        "the formulas have the sun in space and nothing else",
        has_fluxes);
    if (air.vacuum && air.drives_heat) {
        section.mistake("drives_heat", "a vacuum has no sky and no air to drive the heat balance");
    } else if (!has_fluxes && air.drives_heat) {
        section.mistake("table", "a table has no fluxes, which drives_heat = true needs");
    }
    if (section.has("table")) read_table(section, air);
    if (section.has("table") && section.has("sounding")) {
        section.mistake("sounding",
                        "cannot be combined with a sounding: a table of paths has its own air");
    }
    return air;
}

void take_haze(const AirInput& air, const Section& section, ClearSky& sky) {
    if (air.vacuum) {
        sky = in_vacuum(sky);
        return;
    }
    BandModel model;
    // Before the weather is read, "season" has the haze of spring and summer.
    model.profile =
        air.sounding ? *air.sounding : afgl_profile(air.by_season ? "MLS" : air.profile);
    model.aerosol = air.aerosol;
    model.visibility_km = air.visibility_km;
    if (!section.has("aerosol_380nm")) sky.aerosol_380nm = aerosol_depth(model, 0.38);
    if (!section.has("aerosol_500nm")) sky.aerosol_500nm = aerosol_depth(model, 0.50);
}

void check_table_bands(const Section& section, const AirInput& air,
                       std::span<const SeenRange> ranges) {
    if (!air.table) return;
    constexpr double least_um = 3.0;
    const TableSpan span = air.table->span;
    for (const auto& [name, from_um, to_um] : ranges) {
        if (from_um < least_um) {
            section.mistake("table", fmt::format("band {} begins at {:g} um: a table has no "
                                                 "scattered sunlight, expected at least {:g} um",
                                                 name, from_um, least_um));
        } else if (from_um < span.least_um || to_um > span.most_um) {
            section.mistake(
                "table",
                fmt::format("band {} needs {:g} to {:g} um, the table has {:.4g} to {:.4g} um",
                            name, from_um, to_um, span.least_um, span.most_um));
        }
    }
}

}  // namespace diurna
