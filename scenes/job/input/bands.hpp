#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "materials/base/section.hpp"
#include "materials/radiation/band.hpp"

namespace diurna {

/// A named band, [[bands]]: the response curve of a file, or a flat range.
struct BandInput {
    std::string name;
    std::filesystem::path file;  // empty: flat
    Spectrum response;           // 0 to 1
};

/// A hyperspectral cube, [[cubes]]: equal, adjacent channels.
struct CubeInput {
    std::string name;
    double from_um = 0.0, to_um = 0.0;
    int channels = 0;
};

/// Reads every table of [[bands]] and [[cubes]]. A name may be used once, and must not look like a
/// range.
std::vector<BandInput> read_bands(const Section& root);
std::vector<CubeInput> read_cubes(const Section& root);

/// The name of a band as used in files and planes, ignoring case: one of the scene's own, or a
/// predefined word; any other name unchanged.
std::string band_name(const std::vector<BandInput>& own, const std::string& name);
/// The key `bands`: each name converted by band_name().
std::vector<std::string> read_band_names(const Section& section, const char* says,
                                         const Or<std::vector<std::string>>& fallback,
                                         const std::vector<BandInput>& own);

/// The band named by an observer: one of the scene's own, a range such as "3-5", or a word:
/// "visible" 0.4-0.7, "nir" 0.75-1, "swir" 1.5-1.8, "mwir" 3-5, "lwir" 8-12 µm. Throws InputError
/// with the nearest name.
Band named_band(const std::vector<BandInput>& own, const std::string& name,
                std::span<const double> breakpoints_um = {});

}  // namespace diurna
