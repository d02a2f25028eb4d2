/// Makes three of the atmosphere's tables from published size distributions and refractive indices:
///
///     aerosol_tables_bench asymmetry > materials/atmosphere/aerosol_asymmetry.csv
///     aerosol_tables_bench phase > materials/atmosphere/aerosol_phase.csv
///     aerosol_tables_bench desert > materials/atmosphere/aerosol_desert.csv
///
/// Sizes: Shettle and Fenn 1979 (AFGL-TR-79-0214) at 70 % humidity; desert: the background model of
/// Shettle 1984 as quoted by d'Almeida 1987. Indices: their dust-like, water-soluble and sea-salt
/// tables, rounded and thinned out.
#include <fmt/format.h>

#include <map>
#include <string>

#include "materials/atmosphere/mie.hpp"
#include "materials/base/units.hpp"
#include "materials/radiation/spectrum.hpp"

using namespace diurna;

namespace {

struct Index {
    Spectrum real, imaginary;
    std::complex<double> at(double um) const {
        const double clamped =
            std::min(std::max(um, real.wavelength_um.front()), real.wavelength_um.back());
        return {real.at(clamped), imaginary.at(clamped)};
    }
};

const Index dust{
    {{0.3, 0.55, 1.06, 1.536, 2.0, 2.5, 3.0, 3.2,  3.75, 4.5,  5.0,  6.0,  6.2, 7.2,
      7.9, 8.2,  8.5,  8.7,   9.0, 9.2, 9.5, 10.0, 10.6, 11.0, 12.5, 14.8, 20.0},
     {1.53, 1.53, 1.52, 1.40, 1.26, 1.18, 1.16, 1.22, 1.27, 1.26, 1.25, 1.15, 1.14, 1.40,
      1.15, 1.13, 1.30, 1.40, 1.70, 1.72, 1.73, 1.75, 1.62, 1.62, 1.51, 1.57, 1.68}},
    {{0.3, 0.55, 1.06, 1.536, 2.0, 2.5, 3.0, 3.2,  3.75, 4.5,  5.0,  6.0,  6.2, 7.2,
      7.9, 8.2,  8.5,  8.7,   9.0, 9.2, 9.5, 10.0, 10.6, 11.0, 12.5, 14.8, 20.0},
     {0.008, 0.008, 0.008, 0.008, 0.008, 0.009, 0.012, 0.010, 0.011,
      0.012, 0.016, 0.037, 0.039, 0.055, 0.040, 0.074, 0.09,  0.10,
      0.14,  0.15,  0.162, 0.162, 0.12,  0.105, 0.09,  0.10,  0.22}}};
const Index soluble{{{0.3, 0.55, 1.06, 1.536, 2.0, 2.5, 3.0, 3.75, 5.0, 20.0},
                     {1.53, 1.53, 1.52, 1.51, 1.42, 1.42, 1.42, 1.45, 1.45, 1.6}},
                    {{0.3, 0.55, 1.06, 1.536, 2.0, 2.5, 3.0, 3.75, 5.0, 20.0},
                     {0.008, 0.006, 0.017, 0.023, 0.008, 0.012, 0.022, 0.005, 0.012, 0.2}}};
const Index water{
    {{0.3, 0.55, 1.06, 2.0, 2.5, 2.7, 3.0, 3.2, 3.75, 4.5, 5.0, 10.0, 12.5, 20.0},
     {1.35, 1.333, 1.326, 1.306, 1.26, 1.19, 1.37, 1.48, 1.374, 1.332, 1.325, 1.218, 1.12, 1.48}},
    {{0.3, 0.55, 1.06, 2.0, 2.5, 2.7, 3.0, 3.2, 3.75, 4.5, 5.0, 10.0, 12.5, 20.0},
     {1e-8, 2e-9, 2e-6, 0.001, 0.0017, 0.019, 0.27, 0.09, 0.0035, 0.013, 0.0124, 0.051, 0.26,
      0.39}}};

/// Volume mean of two substances.
Index mixed(const Index& a, double share, const Index& b, double more_imaginary = 0.0) {
    Index m;
    for (double um = 0.3; um < 20.01; um *= 1.02) {
        const std::complex<double> n = share * a.at(um) + (1.0 - share) * b.at(um);
        m.real.wavelength_um.push_back(um);
        m.imaginary.wavelength_um.push_back(um);
        m.real.value.push_back(n.real());
        m.imaginary.value.push_back(n.imag() + more_imaginary);
    }
    return m;
}

struct Aerosol {
    std::vector<SizeMode> modes;
    std::vector<Index> index;
    MieMean at(double um) const {
        std::vector<std::complex<double>> n;
        for (const Index& each : index) n.push_back(each.at(um));
        return mie_mean(modes, n, um);
    }
};

using Aerosols = std::map<std::string, Aerosol>;

/// Shettle and Fenn's, at 70 % humidity.
Aerosols all_aerosols() {
    const Index rural = mixed(mixed(soluble, 0.7, dust), 0.75, water);
    const Index salt = mixed(soluble, 0.25, water);
    const Index sooty = mixed(mixed(soluble, 0.7, dust), 0.7, water, 0.06);
    return {
        {"rural", {{{0.999875, 0.02846, 0.35}, {0.000125, 0.4571, 0.40}}, {rural, rural}}},
        {"maritime", {{{0.99, 0.02846, 0.35}, {0.01, 0.2041, 0.40}}, {rural, salt}}},
        {"urban", {{{0.999875, 0.02911, 0.35}, {0.000125, 0.4777, 0.40}}, {sooty, sooty}}},
        {"tropospheric", {{{1.0, 0.02846, 0.35}}, {rural}}},
        {"fog_advective", {{{1.0, 10.0, 0.0, 3.0, 1.0}}, {water}}},
        {"fog_radiative", {{{1.0, 2.0, 0.0, 6.0, 1.0}}, {water}}},
        {"desert",
         {{{997.0, 0.001, 0.328}, {842.4, 0.0218, 0.505}, {7.1e-4, 6.24, 0.277}},
          {dust, dust, dust}}},
    };
}

const std::vector<double> grid_um = {
    0.35, 0.4, 0.45, 0.5,  0.55, 0.633, 0.6943, 0.86, 1.06, 1.25, 1.536, 1.8,  2.0,  2.25, 2.5,
    2.7,  3.0, 3.2,  3.39, 3.5,  3.75,  4.0,    4.5,  5.0,  5.5,  6.0,   6.2,  6.5,  7.2,  7.9,
    8.2,  8.5, 8.7,  9.0,  9.2,  9.5,   10.0,   10.6, 11.0, 11.5, 12.5,  14.8, 17.2, 20.0};

void print_desert(const Aerosols& aerosols) {
    fmt::print(
        "# extinction and absorption relative to extinction at 0.55 um: Mie means of "
        "Shettle's background desert aerosol (bench/aerosol_tables_bench.cpp)\n"
        "type,RH_percent,wavelength_um,ext,abs\n");
    const Aerosol& desert = aerosols.at("desert");
    const double unit = desert.at(0.55).extinction;
    for (const double um : grid_um) {
        const MieMean m = desert.at(um);
        fmt::print("desert,1.0,{},{:.5f},{:.5f}\n", um, m.extinction / unit,
                   (m.extinction - m.scattering) / unit);
    }
}

void print_phase(const Aerosols& aerosols) {
    fmt::print(
        "# phase functions (mean 1 over the sphere) at 70 % humidity: Mie means over "
        "Shettle and Fenn's size distributions (bench/aerosol_tables_bench.cpp)\n"
        "wavelength_um,angle_deg");
    for (const auto& [name, aerosol] : aerosols) fmt::print(",{}", name);
    fmt::print("\n");
    const std::vector<double> angles = {0,   0.5, 1,   1.5, 2,   3,   4,   5,   6,   8,   10,
                                        12,  16,  20,  25,  30,  40,  50,  60,  70,  80,  90,
                                        100, 110, 120, 130, 140, 150, 160, 165, 170, 175, 180};
    std::vector<double> cosine;
    for (const double angle : angles) cosine.push_back(std::cos(radians(angle)));
    for (const double um : {0.35, 0.55, 0.86, 1.25, 1.8, 2.5, 3.0, 3.75, 5.0}) {
        std::map<std::string, std::vector<double>> phase;
        for (const auto& [name, aerosol] : aerosols) {
            std::vector<std::complex<double>> n;
            for (const Index& each : aerosol.index) n.push_back(each.at(um));
            phase[name] = mie_phase(aerosol.modes, n, um, cosine);
        }
        for (std::size_t k = 0; k < angles.size(); ++k) {
            fmt::print("{},{}", um, angles[k]);
            for (const auto& [name, values] : phase) fmt::print(",{:.4g}", values[k]);
            fmt::print("\n");
        }
    }
}

void print_asymmetry(const Aerosols& aerosols) {
    fmt::print(
        "# mean cosine of scattering at 70 % humidity: Mie means over Shettle and Fenn's size "
        "distributions (bench/aerosol_tables_bench.cpp)\nwavelength_um");
    for (const auto& [name, aerosol] : aerosols) fmt::print(",{}", name);
    fmt::print("\n");
    for (const double um : grid_um) {
        fmt::print("{}", um);
        for (const auto& [name, aerosol] : aerosols)
            fmt::print(",{:.4f}", aerosol.at(um).asymmetry);
        fmt::print("\n");
    }
}

}  // namespace

int main(int argc, char** argv) {
    const Aerosols aerosols = all_aerosols();
    const std::string what = argc == 2 ? argv[1] : "";
    if (what == "desert") {
        print_desert(aerosols);
    } else if (what == "phase") {
        print_phase(aerosols);
    } else {
        print_asymmetry(aerosols);
    }
    return 0;
}
