#include "scenes/app/commands/path_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "materials/air/radiosonde.hpp"
#include "materials/atmosphere/atmosphere.hpp"
#include "materials/atmosphere/paths_in_bands.hpp"
#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "materials/base/units.hpp"
#include "materials/modtran/run.hpp"
#include "materials/modtran/tape7.hpp"
#include "materials/radiation/planck.hpp"
#include "materials/radiation/spectrum.hpp"
#include "scenes/app/commands/number_option.hpp"
#include "scenes/app/commands/printed_lines.hpp"

namespace diurna {

namespace {

struct PathArguments {
    std::string profile = "US76";  // or a radiosonde's CSV file
    std::string aerosol = "none";
    double visibility_km = 23.0;
    double co2_ppm = todays_co2_ppm;
    double ground_km = 0.0;  // where the haze begins
    double rain_mm_h = 0.0;
    AirPath path;
    std::vector<std::string> bands;
    std::filesystem::path csv;  // whole spectrum, if named
    std::string modtran;        // absolute path of MODTRAN 5, which then stands in for the model
};

/// The same path for MODTRAN.
ModtranDeck deck_of(const PathArguments& a, const BandModel& model, const SightLine& line,
                    std::span<const Band> bands) {
    ModtranDeck deck;
    deck.emission = a.path.sun_zenith_deg ? ModtranDeck::Emission::thermal_and_sun
                                          : ModtranDeck::Emission::thermal;
    deck.multiple_scattering = a.path.sun_zenith_deg.has_value();
    const auto names = afgl_profile_names();
    if (std::find(names.begin(), names.end(), a.profile) != names.end()) {
        deck.model = a.profile;
    } else {
        deck.profile = model.profile;
    }
    deck.aerosol = a.aerosol;
    deck.visibility_km = a.visibility_km;
    deck.rain_mm_h = a.rain_mm_h;
    deck.co2_ppm = a.co2_ppm;
    deck.ground_km = a.ground_km;
    deck.albedo = a.path.ground_albedo;
    deck.h1_km = a.path.height_km;
    deck.zenith_deg = a.path.zenith_deg;
    deck.range_km = line.range_km();
    deck.h2_km = std::max(0.0, line.height_within(line.size() - 1, 1.0));
    deck.path = a.path.to_space             ? ModtranDeck::PathType::to_space
                : a.path.zenith_deg == 90.0 ? ModtranDeck::PathType::level
                                            : ModtranDeck::PathType::between_heights;
    if (a.path.sun_zenith_deg) deck.sun_zenith_deg = *a.path.sun_zenith_deg;
    deck.sun_azimuth_deg = a.path.azimuth_from_sun_deg;
    double from_um = 1e9, to_um = 0.0;
    for (const Band& band : bands) {
        from_um = std::min(from_um, band.from_um());
        to_um = std::max(to_um, band.to_um());
    }
    deck.first_per_cm = deck.step_per_cm * std::floor(1e4 / to_um / deck.step_per_cm);
    deck.last_per_cm = deck.step_per_cm * std::ceil(1e4 / from_um / deck.step_per_cm);
    return deck;
}

std::vector<PathInBand> by_modtran(const ModtranRunner& runner, const ModtranDeck& deck,
                                   std::span<const Band> bands) {
    const Tape7Spectra path = spectra_of(run_decks(runner, {deck}).front());
    std::vector<PathInBand> results;
    for (const Band& band : bands) {
        const double from = band.from_um(), to = band.to_um();
        const auto sum = [&](const std::vector<double>& value) {
            return integral(Spectrum{path.wavelength_um, value}, from, to);
        };
        if (from < path.wavelength_um.front() - 1e-9 || to > path.wavelength_um.back() + 1e-9) {
            throw std::runtime_error(
                fmt::format("MODTRAN computed {:g} to {:g} um, the band needs {:g} to {:g} um",
                            path.wavelength_um.front(), path.wavelength_um.back(), from, to));
        }
        std::vector<double> slope, left;
        for (std::size_t i = 0; i < path.wavelength_um.size(); ++i) {
            slope.push_back(planck_derivative(path.wavelength_um[i], contrast_body));
            left.push_back(slope.back() * path.transmittance[i]);
        }
        const double mean = sum(path.transmittance) / (to - from), all = sum(slope);
        results.push_back(
            {mean, sum(path.thermal), sum(path.scattered), all > 0.0 ? sum(left) / all : mean});
    }
    return results;
}

/// The embedded model's spectrum, bin by bin.
void write_spectrum(const std::filesystem::path& file, const BandModel& model,
                    const SightLine& line) {
    const PathSpectrum spectrum = path_at_nodes(model, line, bin_middles_um());
    const auto edges = bin_edges_um();
    std::string text = "from_um,to_um,transmittance,thermal_path_radiance_W_m2_sr_um\n";
    for (std::size_t bin = 0; bin + 1 < edges.size(); ++bin) {
        text += fmt::format("{:.6f},{:.6f},{:.6f},{:.6g}\n", edges[bin], edges[bin + 1],
                            spectrum.transmittance[bin], spectrum.radiance[bin]);
    }
    write_whole_file(file, text);
}

void path_verb(const PathArguments& arguments) {
    const FilesRead opened;
    const BandModel model{.profile = named_profile(arguments.profile),
                          .aerosol = arguments.aerosol,
                          .visibility_km = arguments.visibility_km,
                          .co2_ppm = arguments.co2_ppm,
                          .ground_km = arguments.ground_km,
                          .rain_mm_h = arguments.rain_mm_h};
    print_notes(model.profile.notes);
    check(model);
    const SightLine line = line_of(arguments.path, model);
    if (!arguments.csv.empty()) check_output_file(arguments.csv, opened.files());
    std::vector<Band> bands;
    for (const std::string& band : arguments.bands) {
        bands.push_back(parse_band(band, bin_edges_um()));
    }
    std::vector<PathInBand> results;
    if (arguments.modtran.empty()) {
        results = paths_in_bands(arguments.path, model, line, bands);
    } else {
        if (!arguments.csv.empty()) {
            throw InputError("--csv", "writes the spectrum of the embedded model, not MODTRAN's");
        }
        const auto runner = modtran_runner(arguments.modtran);
        results = by_modtran(*runner, deck_of(arguments, model, line, bands), bands);
    }
    std::string out = "band_um,transmittance,thermal_path_radiance_W_m2_sr";
    out += arguments.path.sun_zenith_deg ? ",scattered_sun_W_m2_sr" : "";
    out += ",contrast_transmittance\n";
    for (std::size_t b = 0; b < bands.size(); ++b) {
        out += fmt::format("{:g}-{:g},{:.6f},{:.6g}", bands[b].from_um(), bands[b].to_um(),
                           results[b].transmittance, results[b].thermal);
        if (arguments.path.sun_zenith_deg) out += fmt::format(",{:.6g}", results[b].scattered);
        out += fmt::format(",{:.6f}\n", results[b].contrast);
    }
    if (!arguments.csv.empty()) write_spectrum(arguments.csv, model, line);
    fmt::print("{}", out);
}

}  // namespace

void add_path_verb(CLI::App& app) {
    const auto a = std::make_shared<PathArguments>();
    CLI::App* verb =
        app.add_subcommand("path", "transmittance and radiance of one path through the atmosphere");
    verb->add_option(
        "--profile", a->profile,
        "air: TROP, MLS, MLW, SAS, SAW, US76, or a radiosonde's .csv file (default: US76)");
    verb->add_option("--aerosol", a->aerosol,
                     "aerosol, one of those that diurna doctor lists (default: none)");
    within(verb->add_option("--visibility-km", a->visibility_km,
                            "visibility at the ground (default: 23)"),
           {0.05, 300.0}, "km");
    within(verb->add_option("--co2-ppm", a->co2_ppm,
                            "carbon dioxide (default: 425, the value of 2025)"),
           {0.0, 1e4}, "ppm");
    within(
        verb->add_option("--ground-km", a->ground_km,
                         "height of the ground above the sea, where the haze begins (default: 0)"),
        {-0.5, 5.5}, "km");
    within(verb->add_option("--rain-mm-h", a->rain_mm_h,
                            "rain rate along the whole path (default: 0)"),
           {0.0, 300.0}, "mm/h");
    within(verb->add_option("--height-km", a->path.height_km,
                            "height of the path's start above the sea"),
           AirPath::heights_km, "km");
    within(verb->add_option("--zenith-deg", a->path.zenith_deg, "zenith angle at the path's start"),
           {0.0, 180.0});
    within(verb->add_option("--range-km", a->path.range_km,
                            "length of the path; or give one of the next three options"),
           AirPath::ranges_km, "km");
    within(verb->add_option("--to-height-km", a->path.to_height_km,
                            "height above the sea at the path's end"),
           AirPath::heights_km, "km");
    verb->add_flag("--to-ground", a->path.to_ground, "the path ends at the ground");
    verb->add_flag("--to-space", a->path.to_space, "the path ends above the atmosphere");
    within(verb->add_option("--sun-zenith-deg", a->path.sun_zenith_deg,
                            "zenith angle of the sun; adds scattered sunlight"),
           {0.0, 180.0});
    within(verb->add_option("--azimuth-from-sun-deg", a->path.azimuth_from_sun_deg,
                            "azimuth of the path, measured from that of the sun"),
           {-360.0, 360.0});
    within(verb->add_option("--ground-albedo", a->path.ground_albedo,
                            "albedo of the ground below the path (with --sun-zenith-deg)"),
           {0.0, 1.0});
    verb->add_option("--band", a->bands, "FROM:TO in micrometres; may be repeated")->required();
    verb->add_option("--csv", a->csv, "write the whole spectrum to this file");
    verb->add_option("--modtran", a->modtran,
                     "run this MODTRAN 5 instead of the embedded model (absolute path)");
    verb->callback([a] { path_verb(*a); });
}

}  // namespace diurna
