#include "materials/modtran/tape7.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "materials/atmosphere/atmosphere.hpp"
#include "tests/support/modtran_files.hpp"
#include "tests/support/shared_data.hpp"

using namespace diurna;

TEST_CASE("published tape7 files keep MODTRAN's own identities",
          "[materials][modtran][reference][by_comparison]") {
    const auto folder = shared_data("data/atmosphere/tape7/modtran5_pyradi");
    if (!folder) return;
    for (const char* name : {"tape7-01", "tape7-01b", "horizon5kmtropical.fl7"}) {
        for (const Tape7Run& run : read_tape7(sample(*folder, name))) {
            REQUIRE(run.emission == 0);
            const Tape7Table& t = run.table;
            // Line by line the parts are correlated; in the mean over a band they multiply.
            double depth = 0.0;
            for (const auto& [from, to] :
                 {std::pair{650.0, 800.0}, std::pair{833.0, 1250.0}, std::pair{2000.0, 2222.0},
                  std::pair{2439.0, 2857.0}, std::pair{4000.0, 5000.0}, std::pair{5556.0, 6667.0},
                  std::pair{14286.0, 25000.0}}) {
                double totals = 0.0, products = 0.0;
                for (std::size_t i = 0; i < t.wavenumber.size(); ++i) {
                    if (t.wavenumber[i] < from || t.wavenumber[i] > to) continue;
                    double product = 1.0;
                    for (const char* part :
                         {"H2O_TRANS", "UMIX_TRANS", "O3_TRANS", "TRACE_TRANS", "N2_CONT",
                          "H2O_CONT", "MOLEC_SCAT", "AER+CLD_TRANS", "HNO3_TRANS"}) {
                        product *= t.column(part)[i];
                    }
                    totals += t.column("TOT_TRANS")[i];
                    products += product;
                }
                if (totals < 1.0) continue;
                CAPTURE(name, from);
                CHECK(products / totals == Approx(1.0).epsilon(0.0017));
            }
            for (std::size_t i = 0; i < t.wavenumber.size(); ++i) {
                const double total = t.column("TOT_TRANS")[i];
                if (total > 0.01) {
                    depth = std::max(
                        depth, std::abs(t.column("DEPTH")[i] + std::log(total)) - 1e-4 / total);
                }
            }
            CAPTURE(name);
            CHECK(depth < 1e-3);  // of one printed to three
            CHECK(t.column("DEPTH").back() > 0.0);
        }
    }
    int radiance_runs = 0;
    for (const char* name :
         {"tape7-02", "tape7-02b", "tape7-02c", "tape7-03", "tape7-03b", "tape7-05", "tape7-05b",
          "tape7.LWIRSun", "tape7.MWIRSun", "NIRscat.fl7"}) {
        for (const Tape7Run& run : read_tape7(sample(*folder, name))) {
            ++radiance_runs;
            REQUIRE((run.emission == 1 || run.emission == 2));
            const Tape7Table& t = run.table;
            double black = 0.0, sum = 0.0, depth = 0.0, surface = 0.0;
            for (std::size_t i = 0; i < t.wavenumber.size(); ++i) {
                const auto of = [&](const char* column) {
                    const double value = t.column(column)[i];
                    return std::isnan(value) ? 0.0 : value;
                };
                const double total = of("TOTAL_RAD"), kelvins = of("BBODY_T[K]");
                // B(T) magnifies the last printed digit of T by x / T; its c2 was 1.4388.
                const double slack = 5e-4 * 1.4388 * t.wavenumber[i] / (kelvins * kelvins) + 5e-5 +
                                     1e-5 * 1.4388 * t.wavenumber[i] / kelvins;
                black = std::max(
                    black, std::abs(planck_per_cm(t.wavenumber[i], kelvins) / total - 1.0) - slack);
                const double parts =
                    of("PTH_THRML") + of("SURF_EMIS") + of("SOL_SCAT") + of("GRND_RFLT");
                sum = std::max(sum, std::abs(parts / total - 1.0));
                const double tau = of("TOT_TRANS");
                if (tau > 1e-4) {
                    depth = std::max(depth, std::abs(-std::log(tau) - of("DEPTH")) - 1e-8 / tau);
                }
                CHECK(of("DEPTH") <= 99.990);
                if (of("SURF_EMIS") > 0.0) {
                    const double emitted =
                        tau * of("DIR_EM") * planck_per_cm(t.wavenumber[i], run.ground_temperature);
                    surface = std::max(surface, std::abs(of("SURF_EMIS") / emitted - 1.0));
                }
                CHECK(of("THRML_SCT") <= of("PTH_THRML") * 1.0001);
                CHECK(of("SING_SCAT") <= of("SOL_SCAT") * 1.0001);
                CHECK(of("DRCT_RFLT") <= of("GRND_RFLT") * 1.0001);
            }
            CAPTURE(name);
            CHECK(black < 1.5e-4);
            CHECK(sum < 1.2e-4);
            CHECK(depth < 6e-4);
            CHECK(surface < 2e-4);
        }
    }
    CHECK(radiance_runs >= 10);
    for (const char* name : {"tape7-04", "tape7-sunE"}) {
        for (const Tape7Run& run : read_tape7(sample(*folder, name))) {
            REQUIRE(run.emission == 3);
            double worst = 0.0;
            for (std::size_t i = 0; i < run.table.wavenumber.size(); ++i) {
                const double direct = std::exp(-run.table.column("DEPTH")[i]);
                const double ratio = run.table.column("SOL_TR")[i] / run.table.column("SOLAR")[i];
                if (direct > 1e-3) worst = std::max(worst, std::abs(ratio / direct - 1.0));
                // Half a unit of the last of four digits in each.
                const double rounding = 6e-5 + 5e-4 * direct * run.table.column("DEPTH")[i];
                CHECK(run.table.column("TOT_TRANS")[i] == Approx(direct).margin(rounding));
            }
            CAPTURE(name);
            CHECK(worst < 0.012);  // three digits in each of two numbers
        }
    }
}

TEST_CASE("published tape7 files have the columns and headers that FORMATS.md lists",
          "[materials][modtran][reference]") {
    const auto folder = shared_data("data/atmosphere/tape7/modtran5_pyradi");
    if (!folder) return;
    // 36 columns of MODTRAN 5.2, 40 of 5.3; the wavenumber is one of them.
    const Tape7Run older = read_tape7(sample(*folder, "tape7-01"))[0];
    const Tape7Run newer = read_tape7(sample(*folder, "tape7-01b"))[0];
    CHECK(older.table.name.size() == 35);
    CHECK(newer.table.name.size() == 39);
    // Level paths echo H2 and ANGLE unused: H1 and RANGE count.
    CHECK(older.path_type == 1);
    CHECK(older.h1_km == 2.0);
    CHECK(older.range_km == 2.0);
    // SURREF runs into the field before it: "   0.0000.30000".
    CHECK(newer.ground_temperature == 0.0);
    CHECK(newer.range_km == 1.0);
    // Without a cloud its transmittance is printed as 0 in 5.2, and is no factor of the total.
    const Tape7Run level = read_tape7(sample(*folder, "horizon5kmtropical.fl7"))[0];
    CHECK(level.range_km == 5.0);
    const std::vector<double>& cloud = level.table.value.at(21);
    CHECK(level.table.name.at(21).find("CLOUD") != std::string::npos);
    CHECK(*std::max_element(cloud.begin(), cloud.end()) == 0.0);
    const std::vector<double>& total = level.table.column("TOT_TRANS");
    CHECK(*std::max_element(total.begin(), total.end()) > 0.5);
    const auto all_blank = [&](const char* name, const char* column) {
        const Tape7Table table = read_tape7(sample(*folder, name))[0].table;
        const std::vector<double>& value = table.column(column);
        return std::all_of(value.begin(), value.end(), [](double v) { return std::isnan(v); });
    };
    for (const char* column :
         {"SOL_SCAT", "SING_SCAT", "DRCT_RFLT", "REF_SOL", "SOL@OBS", "TOA_SUN"}) {
        CAPTURE(column);
        CHECK(all_blank("tape7-02", column));
        CHECK_FALSE(all_blank("tape7-02c", column));
    }
    CHECK(all_blank("tape7-02b", "THRML_SCT"));
    CHECK(all_blank("tape7-02c", "THRML_SCT"));
    CHECK_FALSE(all_blank("tape7-02", "THRML_SCT"));
    // DRCT_RFLT = REF_SOL (1 - DIR_EM) cos(sun) / pi: these grounds are black, and reflect none.
    for (const char* name : {"tape7-03b", "tape7-05b", "tape7.MWIRSun"}) {
        const Tape7Table t = read_tape7(sample(*folder, name))[0].table;
        for (std::size_t i = 0; i < t.wavenumber.size(); ++i) {
            CHECK(t.column("DIR_EM")[i] == 1.0);
            CHECK(t.column("DRCT_RFLT")[i] == 0.0);
            CHECK((i == 0 || t.wavenumber[i] > t.wavenumber[i - 1]));
        }
    }
}

TEST_CASE("the embedded model keeps to MODTRAN 5's published paths",
          "[materials][modtran][atmosphere][reference][by_comparison]") {
    const auto folder = shared_data("data/atmosphere/tape7/modtran5_pyradi");
    if (!folder) return;
    struct Path {
        const char* file;
        double visibility_km;
        bool to_space;
        double from_um, to_um, within;  // of the band's mean transmittance, relative
    };
    // The first is the run the tables were solved from; the others are independent of it.
    for (const Path& p : {Path{"horizon5kmtropical.fl7", 23, false, 3.5, 4.1, 0.03},
                          Path{"horizon5kmtropical.fl7", 23, false, 3.0, 5.0, 0.03},
                          Path{"horizon5kmtropical.fl7", 23, false, 8.0, 12.0, 0.03},
                          Path{"horizon5kmtropical.fl7", 23, false, 8.0, 14.0, 0.03},
                          Path{"tape7.MWIRSun", 23, true, 3.52, 4.1, 0.03},
                          Path{"tape7.LWIRSun", 23, true, 8.3, 11.6, 0.04}}) {
        const Tape7Spectra path = spectra_of(read_tape7(sample(*folder, p.file))[0]);
        const BandModel air{.profile = afgl_profile("TROP"),
                            .aerosol = "rural",
                            .visibility_km = p.visibility_km,
                            .co2_ppm = 380.0};
        const Spectrum reference{path.wavelength_um, path.transmittance};
        double expected = 0.0;
        constexpr int steps = 4000;
        for (int i = 0; i < steps; ++i) {
            expected += reference.at(p.from_um + (p.to_um - p.from_um) * (i + 0.5) / steps) / steps;
        }
        const Band band = flat_band("", p.from_um, p.to_um, bin_edges_um());
        const SightLine line = p.to_space ? line_of(air, 0.0, 0.0) : SightLine{{0.0}, {5.0}};
        const double found =
            band_mean_nodes(band, path_at_nodes(air, line, band.node_um).transmittance);
        fmt::print("  {:24} {:4.1f}-{:4.1f} um  {:.4f}  MODTRAN 5 {:.4f}  {:+.2f} %\n", p.file,
                   p.from_um, p.to_um, found, expected, 100.0 * (found / expected - 1.0));
        CAPTURE(p.file, p.from_um);
        CHECK(found == Approx(expected).epsilon(p.within));
    }
}
