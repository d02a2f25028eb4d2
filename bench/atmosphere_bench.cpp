/// Accuracy of the embedded atmosphere by band, as a table for the README, and its speed.
///
///     atmosphere_bench accuracy [FOLDER]     FOLDER holds lowtran7/ and tape7/ of reference runs
///     atmosphere_bench times
#include <fmt/format.h>

#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <limits>
#include <string>

#include "materials/atmosphere/atmosphere.hpp"
#include "materials/atmosphere/band_transmittance.hpp"
#include "materials/atmosphere/sun_field.hpp"
#include "materials/modtran/tape7.hpp"
#include "tests/support/lowtran_rows.hpp"
#include "tests/support/lowtran_sun.hpp"

using namespace diurna;
namespace fs = std::filesystem;

namespace {

/// "mean / worst" error in per cent.
std::string cell(const lowtran::Errors& e) {
    return e.count == 0 ? "" : fmt::format("{:.2f} / {:.1f}", e.mean(), e.worst);
}

/// Transmittance of a published MODTRAN 5 run, tropical air, rural 23 km, over 5 km level or to
/// space, against the model's.
lowtran::Errors against_modtran(const fs::path& folder, bool to_space, double from_um,
                                double to_um) {
    lowtran::Errors errors;
    const std::string file = !to_space       ? "horizon5kmtropical.fl7"
                             : from_um < 5.0 ? "tape7.MWIRSun"
                                             : "tape7.LWIRSun";
    fs::path path = folder / file;
    if (!fs::exists(path)) {  // packed
        path = fs::temp_directory_path() / file;
        const std::string command =
            "gzip -dc '" + (folder / file).string() + ".gz' > '" + path.string() + "'";
        if (std::system(command.c_str()) != 0) return errors;
    }
    const Tape7Spectra run = spectra_of(read_tape7(path)[0]);
    if (from_um < run.wavelength_um.front() || to_um > run.wavelength_um.back()) return errors;
    const Spectrum reference{run.wavelength_um, run.transmittance};
    double expected = 0.0;
    constexpr int steps = 4000;
    for (int i = 0; i < steps; ++i) {
        expected += reference.at(from_um + (to_um - from_um) * (i + 0.5) / steps) / steps;
    }
    const BandModel air{.profile = afgl_profile("TROP"), .aerosol = "rural", .co2_ppm = 380.0};
    const Band band = flat_band("", from_um, to_um, bin_edges_um());
    const SightLine line = to_space ? line_of(air, 0.0, 0.0) : SightLine{{0.0}, {5.0}};
    errors.add(band_mean_nodes(band, path_at_nodes(air, line, band.node_um).transmittance),
               expected);
    return errors;
}

/// One row a band: mean and worst error in per cent.
void print_accuracy(const fs::path& data) {
    const auto level = lowtran::rows(data / "lowtran7/horizontal_bands.csv");
    const auto slant = lowtran::rows(data / "lowtran7/slant_bands.csv");
    const auto sky = lowtran::rows(data / "lowtran7/sky_bands.csv");
    const auto all = [](const lowtran::Row&) { return true; };
    const auto steep = [](const lowtran::Row& row) { return row.zenith_deg <= 75.0; };
    const auto on_level = compare(level, all), on_slant = compare(slant, all),
               on_sky = compare(sky, steep);
    const auto sun = [&](const char* kind) {
        return lowtran::compare_sun(
            data / "lowtran7", kind,
            {{"0.4-0.7", 0.4, 0.7}, {"0.7-1.0", 0.7, 1.0}, {"1.5-1.8", 1.5, 1.8}});
    };
    const auto sky_sun = sun("skysolar"), path_sun = sun("pathsolar");
    fmt::print(
        "| band µm | level τ | slant τ | sky τ | slant thermal | sky thermal | sky sun | path sun "
        "| MODTRAN 5: 5 km | to space |\n|---|---|---|---|---|---|---|---|---|---|\n");
    const fs::path modtran = data / "tape7/modtran5_pyradi";
    for (std::size_t b = 0; b < lowtran::ranges.size(); ++b) {
        const lowtran::Range& range = lowtran::ranges[b];
        const auto of = [&](const auto& errors) {
            const auto found = errors.find(range.name);
            return found == errors.end() ? std::string() : cell(found->second);
        };
        const auto signed_cell = [&](bool to_space) {
            if (!fs::exists(modtran)) return std::string();
            const lowtran::Errors e =
                against_modtran(modtran, to_space, range.from_um, range.to_um);
            return e.count == 0 ? std::string() : fmt::format("{:+.2f}", e.bias());
        };
        fmt::print("| {} | {} | {} | {} | {} | {} | {} | {} | {} | {} |\n", range.name,
                   cell(on_level.transmittance[b]), cell(on_slant.transmittance[b]),
                   cell(on_sky.transmittance[b]), cell(on_slant.thermal[b]),
                   cell(on_sky.thermal[b]), of(sky_sun), of(path_sun), signed_cell(false),
                   signed_cell(true));
    }
}

double cpu_microseconds() {
    timespec now{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return 1e6 * double(now.tv_sec) + 1e-3 * double(now.tv_nsec);
}

/// CPU time of one call, the best of seven rounds.
template <class Work>
double microseconds(Work&& work) {
    double best = 1e300;
    for (int round = 0; round < 7; ++round) {
        constexpr int repeats = 60;
        const double begin = cpu_microseconds();
        for (int i = 0; i < repeats; ++i) work();
        best = std::min(best, (cpu_microseconds() - begin) / repeats);
    }
    return best;
}

void print_times() {
    const BandModel clear{.profile = afgl_profile("MLS")};
    const BandModel hazy{.profile = afgl_profile("MLS"), .aerosol = "rural"};
    const Atmosphere air = hazy;
    const SightLine level{{0.0}, {5.0}};
    const BinRange all{0, bin_count()};
    constexpr double no_end = std::numeric_limits<double>::infinity();
    fmt::print("case,method,setting,facets,threads,cpu_s,error,unit\n");
    const auto row = [&](const char* name, const std::string& setting, double us,
                         const std::string& error = ",") {
        fmt::print("{},band model,{},1,1,{:.3e},{}\n", name, setting, us * 1e-6, error);
    };
    row("spectrum_level", "433 bins", microseconds([&] { transmittance(clear, level, all); }));
    row("spectrum_level", "433 bins rural", microseconds([&] { transmittance(hazy, level, all); }));
    // Only the bins a band needs: time in proportion to them, besides what a path costs at all.
    for (const std::size_t bins : {13, 54, 108, 216}) {
        const BinRange some{200, 200 + bins};
        row("spectrum_level", fmt::format("{} bins rural", bins),
            microseconds([&] { transmittance(hazy, level, some); }));
    }
    // Against a line of ten times as many segments: the worst band of the accuracy table.
    const Segmentation fine{
        .first_km = 0.001, .growth = 0.03, .ceiling_km = 0.02, .thinning_km = 8.0};
    const auto finest = line_of(hazy, 0.0, 45.0, no_end, fine);
    const auto worst = [&](const SightLine& line, bool thermal) {
        double most = 0.0;
        for (const lowtran::Range& range : lowtran::ranges) {
            const Band band = range.band();
            const PathSpectrum a = path_at_nodes(air, line, band.node_um),
                               b = path_at_nodes(air, finest, band.node_um);
            const double ratio =
                thermal
                    ? band_sum_nodes(band, a.radiance) / band_sum_nodes(band, b.radiance)
                    : band_sum_nodes(band, a.transmittance) / band_sum_nodes(band, b.transmittance);
            if (thermal && range.to_um < 2.6) continue;
            most = std::max(most, std::abs(ratio - 1.0));
        }
        return fmt::format("{:.1e},relative", most);
    };
    const SightLine usual = line_of(hazy, 0.0, 45.0);
    const SightLine beam = line_of(hazy, 0.0, 45.0, no_end, beam_segmentation);
    row("transmittance_to_space", fmt::format("{} segments and their ray", usual.size()),
        microseconds([&] { transmittance(hazy, line_of(hazy, 0.0, 45.0), all); }),
        worst(usual, false));
    row("transmittance_to_space", fmt::format("{} segments and their ray", beam.size()),
        microseconds(
            [&] { transmittance(hazy, line_of(hazy, 0.0, 45.0, no_end, beam_segmentation), all); }),
        worst(beam, false));
    row("thermal_to_space", fmt::format("{} segments", usual.size()),
        microseconds([&] { path_at_nodes(air, usual, bin_middles_um()); }), worst(usual, true));
    row("thermal_to_space", fmt::format("{} segments", beam.size()),
        microseconds([&] { path_at_nodes(air, beam, bin_middles_um()); }), worst(beam, true));
    const Band visible = flat_band("", 0.4, 0.7, bin_edges_um());
    row("sun_field", "0.4-0.7 um",
        microseconds([&] { SunField(hazy, {.zenith_deg = 40.0}, visible.node_um); }));
    const SunField field(hazy, {.zenith_deg = 40.0}, visible.node_um);
    row("scattered_sky", "0.4-0.7 um", microseconds([&] { field.sky(0.0, 50.0, 30.0); }));
}

}  // namespace

/// accuracy [FOLDER] or times
int main(int argc, char** argv) {
    const std::string what = argc > 1 ? argv[1] : "";
    const fs::path data =
        argc > 2 ? fs::path(argv[2]) : fs::path(DIURNA_SOURCE_DIR "/../shared/data/atmosphere");
    if (what == "accuracy" && fs::exists(data / "lowtran7")) {
        print_accuracy(data);
    } else if (what == "times") {
        print_times();
    } else {
        fmt::print(stderr,
                   "usage: atmosphere_bench accuracy [FOLDER] | times\n"
                   "FOLDER holds lowtran7/ and tape7/, here {}\n",
                   data.string());
        return 2;
    }
    return 0;
}
