/// Accuracy of the embedded atmosphere by band, as a table for the README, and its speed.
///
///     atmosphere_bench [FOLDER]     FOLDER holds lowtran7/ and tape7/ (default ../shared/data/...)
#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>

#include "materials/atmosphere.hpp"
#include "materials/modtran.hpp"
#include "materials/scattering.hpp"
#include "materials/tabulated.hpp"
#include "tests/lowtran_rows.hpp"
#include "tests/lowtran_sun.hpp"

using namespace diurna;
namespace fs = std::filesystem;

namespace {

void print(const char* against, const char* quantity,
           const std::array<lowtran::Errors, 9>& errors) {
    for (std::size_t b = 0; b < errors.size(); ++b) {
        if (errors[b].count == 0) continue;
        fmt::print("| {} | {} | {} | {} | {:.2f} | {:+.2f} | {:.2f} |\n", against, quantity,
                   lowtran::ranges[b].name, errors[b].count, errors[b].mean(), errors[b].bias(),
                   errors[b].worst);
    }
}

/// Mean transmittance of published MODTRAN 5 runs of tropical air, rural 23 km, against the model.
void print_modtran(const fs::path& folder) {
    struct Run {
        const char *file, *what;
        bool to_space;
        double from_um, to_um;
    };
    for (const auto& [file, what, to_space, from, to] :
         {Run{"tape7.MWIRSun", "to space", true, 3.52, 4.1},
          Run{"tape7.LWIRSun", "to space", true, 8.3, 11.6},
          Run{"horizon5kmtropical.fl7", "level 5 km", false, 3.5, 4.1},
          Run{"horizon5kmtropical.fl7", "level 5 km", false, 3.0, 5.0},
          Run{"horizon5kmtropical.fl7", "level 5 km", false, 8.0, 12.0},
          Run{"horizon5kmtropical.fl7", "level 5 km", false, 8.0, 14.0}}) {
        fs::path path = folder / file;
        if (!fs::exists(path)) {  // packed
            path = fs::temp_directory_path() / file;
            const std::string command =
                "gzip -dc '" + (folder / file).string() + ".gz' > '" + path.string() + "'";
            if (std::system(command.c_str()) != 0) continue;
        }
        const FilePath run = path_of(read_tape7(path)[0]);
        const Spectrum reference{run.wavelength_um, run.transmittance};
        double expected = 0.0;
        constexpr int steps = 4000;
        for (int i = 0; i < steps; ++i) {
            expected += reference.at(from + (to - from) * (i + 0.5) / steps) / steps;
        }
        const BandModel air{.profile = afgl_profile("TROP"), .aerosol = "rural", .co2_ppm = 380.0};
        const Band band = flat_band("", from, to, bin_edges_um());
        const SightLine line = to_space ? line_of(air, 0.0, 0.0) : SightLine{{0.0}, {5.0}};
        const double found =
            band_mean_nodes(band, path_at_nodes(air, line, band.node_um).transmittance);
        const double percent = 100.0 * (found / expected - 1.0);
        fmt::print(
            "| MODTRAN 5 tropical, {} | transmittance | {:g}-{:g} | 1 | {:.2f} | {:+.2f} | "
            "{:.2f} |\n",
            what, from, to, std::abs(percent), percent, std::abs(percent));
    }
}

template <class Work>
double microseconds(Work&& work) {
    double best = 1e300;
    for (int round = 0; round < 5; ++round) {
        constexpr int repeats = 200;
        const auto begin = std::chrono::steady_clock::now();
        for (int i = 0; i < repeats; ++i) work();
        const std::chrono::duration<double, std::micro> took =
            std::chrono::steady_clock::now() - begin;
        best = std::min(best, took.count() / repeats);
    }
    return best;
}

}  // namespace

int main(int argc, char** argv) {
    const fs::path data =
        argc > 1 ? fs::path(argv[1]) : fs::path(DIURNA_SOURCE_DIR "/../shared/data/atmosphere");
    fmt::print(
        "| against | quantity | band [um] | paths | mean abs. % | bias % | worst % |\n"
        "|---|---|---|---|---|---|---|\n");
    if (fs::exists(data / "lowtran7")) {
        const auto level = lowtran::rows(data / "lowtran7/horizontal_bands.csv");
        const auto slant = lowtran::rows(data / "lowtran7/slant_bands.csv");
        const auto sky = lowtran::rows(data / "lowtran7/sky_bands.csv");
        const auto all = [](const lowtran::Row&) { return true; };
        const auto steep = [](const lowtran::Row& row) { return row.zenith_deg <= 75.0; };
        const auto flat = [](const lowtran::Row& row) { return row.zenith_deg > 75.0; };
        print("LOWTRAN7 level", "transmittance", compare(level, all).transmittance);
        print("LOWTRAN7 slant", "transmittance", compare(slant, all).transmittance);
        print("LOWTRAN7 slant", "thermal radiance", compare(slant, all).thermal);
        print("LOWTRAN7 sky, zenith <= 75", "transmittance", compare(sky, steep).transmittance);
        print("LOWTRAN7 sky, zenith <= 75", "thermal radiance", compare(sky, steep).thermal);
        print("LOWTRAN7 sky, zenith > 75", "transmittance", compare(sky, flat).transmittance);
        print("LOWTRAN7 sky, zenith > 75", "thermal radiance", compare(sky, flat).thermal);
        for (const auto& [kind, what] : {std::pair{"skysolar", "LOWTRAN7 sky"},
                                         std::pair{"pathsolar", "LOWTRAN7 path to ground"}}) {
            for (const auto& [name, e] : lowtran::compare_sun(
                     data / "lowtran7", kind,
                     {{"0.4-0.7", 0.4, 0.7}, {"0.7-1.0", 0.7, 1.0}, {"1.5-1.8", 1.5, 1.8}})) {
                fmt::print("| {} | scattered sun | {} | {} | {:.2f} | {:+.2f} | {:.2f} |\n", what,
                           name, e.count, e.mean(), e.bias(), e.worst);
            }
        }
    }
    if (fs::exists(data / "tape7/modtran5_pyradi")) print_modtran(data / "tape7/modtran5_pyradi");
    const BandModel clear{.profile = afgl_profile("MLS")};
    const BandModel hazy{.profile = afgl_profile("MLS"), .aerosol = "rural"};
    const SightLine level{{0.0}, {5.0}};
    const SightLine up = line_of(hazy, 0.0, 45.0);
    const BinRange all = all_bins();
    const BinRange few = bins_of(std::vector<double>{8.0, 12.0});
    fmt::print("\ncase,method,setting,facets,threads,wall_s,error,unit\n");
    const auto row = [&](const char* name, const char* setting, double us) {
        fmt::print("{},band model,{},1,1,{:.3e},,\n", name, setting, us * 1e-6);
    };
    row("spectrum_level", "433 bins", microseconds([&] { transmittance(clear, level, all); }));
    row("spectrum_level", "433 bins rural", microseconds([&] { transmittance(hazy, level, all); }));
    row("spectrum_level", fmt::format("{} bins rural", few.size()).c_str(),
        microseconds([&] { transmittance(hazy, level, few); }));
    row("spectrum_to_space", fmt::format("{} segments rural", up.size()).c_str(),
        microseconds([&] { transmittance(hazy, up, all); }));
    const Band visible = flat_band("", 0.4, 0.7, bin_edges_um());
    row("sun_field", "0.4-0.7 um",
        microseconds([&] { SunField(hazy, {.zenith_deg = 40.0}, visible.node_um); }));
    const SunField field(hazy, {.zenith_deg = 40.0}, visible.node_um);
    row("scattered_sky", "0.4-0.7 um", microseconds([&] { field.sky(0.0, 50.0, 30.0); }));
    const std::vector<Band> bands = {flat_band("8-12", 8.0, 12.0, bin_edges_um())};
    const Tabulated table = tabulate(path_source(hazy), hazy.profile, {.most_to_km = 0.5}, bands);
    fmt::print("table_path,tabulated,8-12 um,1,1,{:.3e},,\n",
               1e-6 * microseconds([&] { table_path(table, 0.0, 0.2, 3.3, bands[0].node_um); }));
    fmt::print("table_path,tabulated,{} paths,1,1,,{:.2e},K\n", table_error(table).paths,
               table_error(table).kelvin);
    return 0;
}
