#include "scenes/job/input/bands.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "materials/base/error.hpp"

namespace diurna {

namespace {

struct Word {
    const char* name;
    double from_um, to_um;
};
constexpr std::array<Word, 5> words = {{{"visible", 0.4, 0.7},
                                        {"nir", 0.75, 1.0},
                                        {"swir", 1.5, 1.8},
                                        {"mwir", 3.0, 5.0},
                                        {"lwir", 8.0, 12.0}}};

/// A name for planes and files: letters, digits, '_' and '-', the first a letter.
std::string read_name(const Section& section, const char* says, std::set<std::string>& taken) {
    const std::string name = section.text("name", says);
    const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
    const bool fits =
        !name.empty() && letter(name[0]) && std::all_of(name.begin(), name.end(), [&](char c) {
            return letter(c) || (c >= '0' && c <= '9') || c == '_' || c == '-';
        });
    if (!fits) {
        section.mistake(
            "name", fmt::format("found \"{}\", expected a letter, then letters, digits, '_' or '-'",
                                name.substr(0, 40)));
    } else if (!taken.insert(name).second) {
        section.mistake("name", fmt::format("a second \"{}\"", name));
    }
    return name;
}

/// [from, to] in µm; a harmless range where it is wrong.
std::array<double, 2> read_range(const Section& section, const char* says) {
    const std::vector<double> range = section.numbers("range_um", says, 2);
    if (range.size() == 2 && range[0] >= 0.2 && range[0] < range[1] && range[1] <= 100.0) {
        return {range[0], range[1]};
    }
    section.mistake("range_um", "expected [from, to] in µm, ascending within 0.2 to 100");
    return {8.0, 12.0};
}

}  // namespace

std::vector<BandInput> read_bands(const Section& root) {
    constexpr const char* flat = "[from, to] of a band with uniform response; or give response";
    std::vector<BandInput> bands;
    std::set<std::string> taken;
    for (const Section& section : root.sections("bands", "a user-defined band of an instrument")) {
        BandInput band{.name = read_name(section, "name by which observers select it", taken),
                       .file = {},
                       .response = {}};
        if (section.has("response") == section.has("range_um")) {
            section.mistake("", "expected either response (a CSV file) or range_um = [from, to]");
            if (section.has("range_um")) section.numbers("range_um", flat, 2);
        }
        if (section.has("response")) {
            band.file = section.file("response", "CSV file of wavelength_um and response, 0 to 1");
            band.response = flat_spectrum(1.0, 8.0, 12.0);
            try {
                if (!band.file.empty()) band.response = read_response(band.file);
            } catch (const InputError& error) {
                section.mistake("response", error.what());
            }
        } else if (section.has("range_um")) {
            const auto [from, to] = read_range(section, flat);
            band.response = flat_spectrum(1.0, from, to);
        }
        bands.push_back(std::move(band));
    }
    return bands;
}

std::vector<CubeInput> read_cubes(const Section& root) {
    std::vector<CubeInput> cubes;
    std::set<std::string> taken;
    for (const Section& section : root.sections(
             "cubes", "a hyperspectral cube: adjacent channels, written as OpenEXR and ENVI")) {
        CubeInput cube;
        cube.name = read_name(section, "name by which observers select it", taken);
        const auto [from, to] = read_range(section, "[from, to] of all channels together");
        cube.from_um = from;
        cube.to_um = to;
        cube.channels =
            section.integer_or("channels", "number of channels of equal width", 64, {1, 2000});
        cubes.push_back(std::move(cube));
    }
    return cubes;
}

std::string band_name(const std::vector<BandInput>& own, const std::string& name) {
    std::string found;
    for (const Word& w : words) {
        if (small_letters(name) == w.name) found = w.name;
    }
    for (const BandInput& band : own) {
        if (band.name == name) return name;
        if (small_letters(band.name) == small_letters(name)) found = band.name;
    }
    return found.empty() ? name : found;
}

std::vector<std::string> read_band_names(const Section& section, const char* says,
                                         const Or<std::vector<std::string>>& fallback,
                                         const std::vector<BandInput>& own) {
    std::vector<std::string> names = section.texts_or("bands", says, fallback);
    for (std::string& name : names) name = band_name(own, name);
    return names;
}

Band named_band(const std::vector<BandInput>& own, const std::string& name,
                std::span<const double> breakpoints_um) {
    const auto mine = std::find_if(own.begin(), own.end(),
                                   [&](const BandInput& band) { return band.name == name; });
    if (mine != own.end()) return response_band(name, mine->response, breakpoints_um);
    const auto word =
        std::find_if(words.begin(), words.end(), [&](const Word& w) { return name == w.name; });
    if (word != words.end()) return flat_band(name, word->from_um, word->to_um, breakpoints_um);
    const bool range = !name.empty() && (name[0] == '.' || (name[0] >= '0' && name[0] <= '9'));
    if (range) return parse_band(name, breakpoints_um);
    std::vector<std::string> known;
    for (const Word& w : words) known.emplace_back(w.name);
    for (const BandInput& band : own) known.push_back(band.name);
    throw InputError(
        "band",
        fmt::format("no band \"{}\", expected a name of [[bands]] or FROM-TO in µm, such as 8-12",
                    name.substr(0, 40)),
        did_you_mean(name, known));
}

}  // namespace diurna
