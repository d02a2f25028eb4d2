#include "scenes/job/input/read_signature.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "materials/base/error.hpp"
#include "scenes/job/input/object_names.hpp"
#include "scenes/job/input/read_frames.hpp"

namespace diurna {

StudiedObject read_studied(const Section& section, const TerrainInput& terrain,
                           const TimeInput& time, const std::optional<Site>& site) {
    Names known{.what = "object or building", .known = {}};
    add_objects(known, terrain);
    for (const Building& building : terrain.buildings) known.known.push_back(building.name);
    StudiedObject studied{
        .object = section.name("object", "object or building to be studied", known),
        .frames = time.frames,
        .where = section.where()};
    if (section.has("frames") || section.has("frame_every_s") || section.has("frames_at_sun")) {
        const FrameSpan span{.begin = time.start,
                             .end = time.end(),
                             .utc_offset = time.utc_offset,
                             .every = 3600.0,
                             .every_said = "the pictures of [time]",
                             .site = site};
        studied.frames = read_frames(section, span).frame;
    }
    return studied;
}

std::string study_name(const Section& section, const Or<std::string>& usual,
                       std::vector<std::string>& names) {
    const std::string name = section.text_or("name", "name, used in the names of files", usual);
    const bool fits = std::all_of(name.begin(), name.end(), [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-' || c == '.';
    });
    if (!fits || name.starts_with('.')) {
        section.mistake("name",
                        "is used in file names, expected letters, digits, '_', '-' and '.'");
    } else if (!name.empty() && std::find(names.begin(), names.end(), name) != names.end()) {
        section.mistake("name", fmt::format("the name \"{}\" is used twice", name));
    }
    names.push_back(name);
    return name;
}

std::vector<SignatureInput> read_signatures(const Section& root, const TerrainInput& terrain,
                                            const std::vector<BandInput>& bands,
                                            const TimeInput& time,
                                            const std::optional<Site>& site) {
    std::vector<SignatureInput> found;
    std::vector<std::string> names;
    for (const Section& section : root.sections(
             "signature",
             "radiant and contrast intensity of an object in all directions: diurna signature")) {
        SignatureInput input;
        input.studied = read_studied(section, terrain, time, site);
        input.name = study_name(section, {input.studied.object, "name of the object"}, names);
        input.bands =
            read_band_names(section, "bands in µm, words or names of [[bands]]; at least one",
                            {std::vector<std::string>{}, "none"}, bands);
        if (input.bands.empty()) section.mistake("bands", "missing, expected at least one band");
        for (const std::string& band : input.bands) {
            try {
                named_band(bands, band);
            } catch (const InputError& error) {
                section.mistake("bands", error.mistakes().front().problem,
                                error.mistakes().front().hint);
            }
        }
        input.directions =
            section.integer_or("directions",
                               "number of directions, evenly distributed over the sphere: 42, 162 "
                               "or 642; those above the horizontal are rendered",
                               input.directions, {42, 642});
        if (input.directions != 42 && input.directions != 162 && input.directions != 642) {
            section.mistake("directions", "expected 42, 162 or 642");
        }
        if (section.has("range_m")) {
            input.range = section.number("range_m",
                                         "distance to its centre, through the atmosphere; without "
                                         "it, parallel rays begin at the target",
                                         {1.0, 200000.0});
        }
        input.pixels = section.integer_or(
            "pixels",
            "pixels per side of its pictures, which are three times as wide as the object",
            input.pixels, {16, 2048});
        input.samples = section.integer_or("samples", "rays per pixel", input.samples, {1, 4096});
        found.push_back(std::move(input));
    }
    return found;
}

}  // namespace diurna
