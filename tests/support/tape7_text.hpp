#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "materials/atmosphere/atmosphere.hpp"
#include "materials/modtran/tape7.hpp"

namespace diurna {

/// A path as MODTRAN would be asked for it: between heights, or to space.
struct AskedPath {
    double from_km, to_km, range_km;
    double zenith_deg = 0.0;
    bool to_space = false;
};

/// Its spectrum through an air, at the middles of bins.
inline PathSpectrum asked_spectrum(const BandModel& air, const AskedPath& path, BinRange bins) {
    const SightLine line = path.to_space ? line_of(air, path.from_km, path.zenith_deg)
                                         : chord(path.from_km, path.to_km, path.range_km);
    return path_at_nodes(air, line, bin_middles_um().subspan(bins.first, bins.size()));
}

/// The cards of a MODTRAN 5 run of IEMSCT 1.
inline std::string tape7_cards(const AskedPath& path) {
    std::string text = fmt::format(
        "T F 6    {}    1    0    6    6    6    6    6    6    1    0    0   0.000"
        "   0.00\n",
        path.to_space ? 3 : 2);
    text += "    1    0    0    0    0    0  23.00000   0.00000   0.00000   0.00000   0.00000\n";
    text += " -99.000 -99.000 -99.000\n";
    text += " -99.00000 -99.00000 -99.00000  1.416445  0.000736 ! H2O & O3 COLUMNS [GM/CM2]\n";
    text += "   36MODEL               \n";
    text += fmt::format("{:10.5f}{:10.5f}{:10.5f}{:10.5f}   0.00000   0.00000    0\n", path.from_km,
                        path.to_km, path.zenith_deg, path.range_km);
    text += "  -99  -99  -99  -99\n";
    text += " -99.00000 -99.00000 -99.00000 -99.00000 -99.00000 -99.00000 -99.00000 -99.00000\n";
    text += "     830.0    1255.0       1.0       1.0NW              \n";
    text += "    0   0    0.000  0    0.000  0    1.000\n";
    return text;
}

/// A run of a tape7: two rows within each bin, values constant there.
inline std::string tape7_run(const AskedPath& path, const PathSpectrum& spectrum, BinRange bins) {
    std::string text = tape7_cards(path);
    text +=
        "    FREQ  TOT_TRANS  PTH_THRML  THRML_SCT  SURF_EMIS   SOL_SCAT  SING_SCAT  GRND_RFLT  "
        "DRCT_RFLT  TOTAL_RAD  REF_SOL  SOL@OBS   DEPTH DIR_EM    TOA_SUN BBODY_T[K]\n";
    const auto edges = bin_edges_um();
    for (std::size_t b = bins.last; b-- > bins.first;) {
        const double low = 1e4 / edges[b + 1], high = 1e4 / edges[b];
        const std::size_t i = b - bins.first;
        const double per_cm =
            spectrum.radiance[i] / per_um_from_modtran(1.0, 1e4 / bin_middles_um()[b]);
        for (const double part : {0.25, 0.75}) {
            text += fmt::format(
                "{:8.2f}{:11.8f}{:11.4E}{:>11}{:11.4E}{:>11}{:>11}{:11.4E}{:>11}"
                "{:11.4E}{:>9}{:>9}{:8.3f}{:7.4f}{:>11}{:11.3f}\n",
                low + part * (high - low), spectrum.transmittance[i], per_cm, "", 0.0, "", "", 0.0,
                "", per_cm, "", "", std::min(99.99, -std::log(spectrum.transmittance[i] + 1e-40)),
                1.0, "", 250.0);
        }
    }
    return text + " -9999.\n";
}

/// The same convolved, as a .7sc prints it over µm: radiances in W cm⁻² sr⁻¹ µm⁻¹.
inline std::string convolved_run(const AskedPath& path, const PathSpectrum& spectrum,
                                 BinRange bins) {
    std::string text = tape7_cards(path);
    text += "  WAVLEN(MCRN)    TRANS   PTH THRML   SURF EMIS   SOL SCAT   GRND RFLT   TOTAL RAD\n";
    const auto edges = bin_edges_um();
    for (std::size_t b = bins.first; b < bins.last; ++b) {
        const double low = 1e4 / edges[b + 1], high = 1e4 / edges[b];
        const std::size_t i = b - bins.first;
        for (const double part : {0.75, 0.25}) {
            const double nu = low + part * (high - low), middle = 1e4 / bin_middles_um()[b];
            const double per_um = 1e-4 * spectrum.radiance[i] * (nu * nu) / (middle * middle);
            text += fmt::format("{:14.6f}{:9.6f}{:12.5E}{:12.5E}{:>11}{:>12}{:12.5E}\n", 1e4 / nu,
                                spectrum.transmittance[i], per_um, 0.0, "", "", per_um);
        }
    }
    return text + " -9999.\n";
}

/// Every path of a table: from heights to heights over ranges that crowd as their cube root, and
/// from heights to space.
inline std::vector<AskedPath> asked_paths(const std::vector<double>& from,
                                          const std::vector<double>& to, double farthest_km,
                                          int ranges = 28) {
    std::vector<AskedPath> paths;
    const double least = std::cbrt(0.05), most = std::cbrt(farthest_km);
    for (const double a : from) {
        for (const double b : to) {
            for (int i = 0; i < ranges; ++i) {
                paths.push_back({a, b, std::pow(least + (most - least) * i / (ranges - 1), 3)});
            }
        }
    }
    for (const double a : to) {
        for (const double zenith :
             {0.0, 20.0, 35.0, 50.0, 60.0, 68.0, 74.0, 79.0, 83.0, 86.0, 88.0, 89.0, 89.6, 90.0}) {
            paths.push_back({a, 0.0, 0.0, zenith, true});
        }
    }
    return paths;
}

}  // namespace diurna
