/// Accuracy of the embedded atmosphere by band, as a table for the README, and its speed.
///
///     atmosphere_bench [FOLDER]     FOLDER holds lowtran7/ and tape7/ (default ../shared/data/...)
#include <fmt/format.h>

#include <chrono>
#include <filesystem>

#include "materials/atmosphere.hpp"
#include "tests/lowtran_rows.hpp"

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
    }
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
    return 0;
}
