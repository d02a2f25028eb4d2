#include "scenes/job/input/read_textures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "materials/base/error.hpp"

namespace diurna {

namespace {

constexpr double widest = 2.0;  // deviations that must fit between a parameter's bounds

void read_clutter(const Section& section, TextureInput& texture) {
    ClutterSpec clutter;
    clutter.length = section.number("correlation_length_m",
                                    "distance at which the correlation falls to 1/e", {0.01, 1e5});
    clutter.covariance = section.choice_or(
        "covariance", "correlation function of the field over distance", Covariance::exponential,
        {{"exponential", Covariance::exponential}, {"gaussian", Covariance::gaussian}});
    clutter.seed = static_cast<std::uint64_t>(
        section.integer_or("seed", "seed of the random field", 1, {0, 1 << 30}));
    texture.deviation = section.number(
        "std", "standard deviation; values are cut off at three of them and at 0 and 1",
        {1e-6, 0.5});
    const bool mixture = texture.what == TextureInput::What::mixture;
    const double mean = section.number_or(
        "mean", "mean of the values",
        {mixture ? 0.5 : std::nan(""), "that of the material; 0.5 for a mixture"}, {0.0, 1.0});
    if (!std::isnan(mean)) texture.mean = mean;
    if (texture.mean) {
        const double room = std::min(*texture.mean, 1.0 - *texture.mean);
        if (widest * texture.deviation > room + 1e-12) {
            section.mistake("std",
                            fmt::format("found {:g} about a mean of {:g}: more than 2.5 % of "
                                        "values would be cut off at 0 or 1, expected at most {:g}",
                                        texture.deviation, *texture.mean, room / widest));
        }
    }
    texture.clutter = clutter;
}

/// Scale and offset on an image's values, which have to come to lie between 0 and 1.
void scale_values(const Section& section, const std::string& file, double scale, double offset,
                  std::vector<float>& values) {
    double least = 1e300, most = -1e300;
    for (float& v : values) {
        if (std::isnan(v)) continue;
        v = static_cast<float>(scale * double{v} + offset);
        least = std::min(least, double{v});
        most = std::max(most, double{v});
    }
    constexpr double rounding = 1e-6;
    if (least > most) {
        section.mistake("file", file + " has no values");
    } else if (least < -rounding || most > 1.0 + rounding) {
        section.mistake(
            "scale", fmt::format("gives values from {:g} to {:g}, expected 0 to 1", least, most));
    }
}

bool says_where(const Section& section) {
    return section.has("place_m") || section.has("place") || section.has("heading_deg");
}

/// Where a picture lies that its file does not place.
void read_placing(const Section& section, const ScenePlaces& places, TextureInput& texture) {
    if (section.has("metres_per_texel")) {
        texture.metres_per_texel = section.number(
            "metres_per_texel", "size of a texel, for a picture without georeference", {1e-4, 1e5});
        const auto place =
            section.numbers_or("place_m",
                               "with metres_per_texel: [east, north] of the picture's centre; on "
                               "an object from that object's centre",
                               std::vector{0.0, 0.0}, 2);
        texture.place = {place[0], place[1]};
        if (section.has("place")) {
            texture.place =
                places.one(section, {"place_m", "place"}, "place of the picture's centre");
        }
        texture.heading_deg = section.number_or(
            "heading_deg",
            "with metres_per_texel: direction of the picture's upper edge, from north", 0.0,
            {-360.0, 360.0});
    } else if (says_where(section)) {
        section.mistake("metres_per_texel", "missing, but place_m and heading_deg need it");
    }
}

void read_image(const Section& section, const ScenePlaces& places, TextureInput& texture) {
    texture.file =
        section.file("file", "picture whose texels are the values: GeoTIFF, PNG, JPEG, ENVI, ...");
    const std::string name = texture.file.filename().string();
    const int channel = section.integer_or("channel", "band of the picture", 1, {1, 1000});
    const double scale = section.number_or("scale", "value = scale * texel + offset", 1.0);
    const double offset = section.number_or("offset", "value = scale * texel + offset", 0.0);
    texture.nearest =
        section.choice_or("sampling", "interpolation between texels: linear, or nearest", false,
                          {{"linear", false}, {"nearest", true}});
    texture.repeat = section.flag_or(
        "repeat", "repeat the picture; false: use the material's own value around it", false);
    read_placing(section, places, texture);
    if (texture.file.empty()) return;
    try {
        texture.image = read_texture_image(texture.file, channel, section.confines());
    } catch (const InputError& error) {
        section.mistake("file", error.mistakes().front().line());
        return;
    }
    if (texture.metres_per_texel == 0.0 && !texture.image.georeferenced && !says_where(section)) {
        section.mistake("metres_per_texel", "missing, and " + name + " has no georeference");
    }
    scale_values(section, name, scale, offset, texture.image.value);
}

/// The two materials of a mixture.
std::array<std::string, 2> read_between(const Section& section, const Reading& reading) {
    const std::vector<std::string> between =
        section.texts_or("between", "two materials: the value is the share of the second", {});
    if (between.size() != 2) {
        section.mistake("between", "expected the names of two materials");
        return {};
    }
    const std::vector<std::string>& known = reading.materials.known;
    for (const std::string& name : between) {
        if (std::find(known.begin(), known.end(), name) == known.end()) {
            section.mistake("between", fmt::format("no material \"{}\"", name),
                            did_you_mean(name, known));
        }
    }
    return {between[0], between[1]};
}

TextureInput read_texture(const Section& section, const Reading& reading) {
    using What = TextureInput::What;
    TextureInput texture;
    texture.name = section.text("name", "name by which `texture` selects it");
    texture.where = section.where();
    texture.what = section.choice_or(
        "what", "the quantity that varies over the surface", What::albedo,
        {{"albedo", What::albedo}, {"emissivity", What::emissivity}, {"mixture", What::mixture}});
    if (texture.what == What::mixture) {
        texture.between = read_between(section, reading);
    } else {
        texture.levels = section.integer_or(
            "levels",
            "number of values for which each facet is solved, each with its own heat balance",
            {0, "one for every 0.3 of albedo, 0.2 of emissivity"}, {2, 33});
    }
    // Without kind: what the keys say.
    const std::string kind =
        section.word_or("kind", "a picture, or a random field",
                        {section.has("file") ? "raster" : "clutter", "raster if file is given"},
                        {"raster", "clutter"});
    if (kind == "raster") {
        read_image(section, reading.places, texture);
    } else {
        read_clutter(section, texture);
    }
    return texture;
}

}  // namespace

std::vector<TextureInput> read_textures(const Section& root, const Reading& reading) {
    std::vector<TextureInput> textures;
    for (const Section& section : root.sections(
             "texture", "a surface property that varies in space: a random field or a picture")) {
        TextureInput texture = read_texture(section, reading);
        if (std::any_of(textures.begin(), textures.end(),
                        [&](const TextureInput& other) { return other.name == texture.name; })) {
            section.mistake("name", fmt::format("a second texture named \"{}\"", texture.name));
        }
        textures.push_back(std::move(texture));
    }
    return textures;
}

}  // namespace diurna
