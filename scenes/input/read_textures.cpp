#include "scenes/input/read_textures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "materials/base/error.hpp"

namespace diurna {

namespace {

constexpr double widest = 2.0;  // deviations that must fit between a parameter's bounds

void read_clutter(const Section& section, TextureInput& texture) {
    ClutterSpec clutter;
    clutter.length = section.number("correlation_length_m", 0.01, 1e5);
    clutter.covariance =
        section.word_or("covariance", "exponential", {"exponential", "gaussian"}) == "gaussian"
            ? Covariance::gaussian
            : Covariance::exponential;
    clutter.seed = static_cast<std::uint64_t>(section.integer_or("seed", 1, 0, 1 << 30));
    texture.deviation = section.number("std", 1e-6, 0.5);
    if (section.has("mean")) {
        texture.mean = section.number("mean", 0.0, 1.0);
    } else if (texture.what == TextureInput::What::mixture) {
        texture.mean = 0.5;
    }
    if (texture.mean) {
        const double room = std::min(*texture.mean, 1.0 - *texture.mean);
        if (widest * texture.deviation > room + 1e-12) {
            section.mistake("std", fmt::format("found {:g} about a mean of {:g}: more than a "
                                               "fortieth would be cut off at 0 or 1, expected at "
                                               "most {:g}",
                                               texture.deviation, *texture.mean, room / widest));
        }
    }
    texture.clutter = clutter;
}

void read_image(const Section& section, const Reading& reading, TextureInput& texture) {
    const std::string name = section.text("file");
    texture.file = reading.folder / name;
    const int channel = section.integer_or("channel", 1, 1, 1000);
    const double scale = section.number_or("scale", 1.0), offset = section.number_or("offset", 0.0);
    texture.nearest = section.word_or("sampling", "linear", {"linear", "nearest"}) == "nearest";
    texture.repeat = section.flag_or("repeat", false);
    if (section.has("metres_per_texel")) {
        texture.metres_per_texel = section.number("metres_per_texel", 1e-4, 1e5);
        const auto place = section.numbers_or("place_m", {0.0, 0.0}, 2);
        texture.place = {place[0], place[1]};
        texture.heading_deg = section.number_or("heading_deg", 0.0, -360.0, 360.0);
    } else if (section.has("place_m") || section.has("heading_deg")) {
        section.mistake("metres_per_texel", "missing, but place_m and heading_deg need it");
    }
    if (name.empty()) return;
    try {
        texture.image = read_texture_image(texture.file, channel);
    } catch (const InputError& error) {
        section.mistake("file", error.mistakes().front().line());
        return;
    }
    const bool placed = section.has("place_m") || section.has("heading_deg");  // told above
    if (texture.metres_per_texel == 0.0 && !texture.image.georeferenced && !placed) {
        section.mistake("metres_per_texel",
                        "missing, and " + name + " does not say where on Earth it lies");
    }
    double least = 1e300, most = -1e300;
    for (float& v : texture.image.value) {
        if (std::isnan(v)) continue;
        v = static_cast<float>(scale * double{v} + offset);
        least = std::min(least, double{v});
        most = std::max(most, double{v});
    }
    constexpr double rounding = 1e-6;
    if (least > most) {
        section.mistake("file", name + " has no values");
    } else if (least < -rounding || most > 1.0 + rounding) {
        section.mistake(
            "scale", fmt::format("makes values from {:g} to {:g}, expected 0 to 1", least, most));
    }
}

TextureInput read_texture(const Section& section, const Reading& reading) {
    using What = TextureInput::What;
    TextureInput texture;
    texture.name = section.text("name");
    texture.where = section.where();
    const std::string what = section.word_or("what", "albedo", {"albedo", "emissivity", "mixture"});
    texture.what = what == "mixture"      ? What::mixture
                   : what == "emissivity" ? What::emissivity
                                          : What::albedo;
    if (texture.what == What::mixture) {
        const std::vector<std::string> between = section.texts_or("between", {});
        if (between.size() != 2) {
            section.mistake("between", "expected the names of two materials");
        } else {
            texture.between = {between[0], between[1]};
            for (const std::string& name : between) {
                if (std::find(reading.materials.begin(), reading.materials.end(), name) ==
                    reading.materials.end()) {
                    section.mistake("between", fmt::format("no material \"{}\"", name),
                                    did_you_mean(name, reading.materials));
                }
            }
        }
    } else {
        if (section.has("levels")) texture.levels = section.integer_or("levels", 2, 2, 33);
    }
    // Without kind: what the keys say.
    const std::string kind =
        section.word_or("kind", section.has("file") ? "raster" : "clutter", {"raster", "clutter"});
    if (kind == "raster") {
        read_image(section, reading, texture);
    } else {
        read_clutter(section, texture);
    }
    return texture;
}

}  // namespace

std::vector<TextureInput> read_textures(const Section& root, const Reading& reading) {
    std::vector<TextureInput> textures;
    for (const Section& section : root.sections("texture")) {
        TextureInput texture = read_texture(section, reading);
        if (std::any_of(textures.begin(), textures.end(),
                        [&](const TextureInput& other) { return other.name == texture.name; })) {
            section.mistake("name", fmt::format("a second texture named \"{}\"", texture.name));
        }
        textures.push_back(std::move(texture));
    }
    return textures;
}

TextureUses read_texture_uses(const Section& root, const std::vector<TextureInput>& textures) {
    TextureUses uses;
    const auto read = [&](const Section& section, std::map<std::string, std::string>& to,
                          const std::string& name) {
        if (!section.has("texture")) return;
        const std::string texture = section.text("texture");
        std::vector<std::string> names;
        for (const TextureInput& known : textures) names.push_back(known.name);
        if (std::find(names.begin(), names.end(), texture) == names.end()) {
            section.mistake("texture", fmt::format("no texture \"{}\" in [[texture]]", texture),
                            did_you_mean(texture, names));
        }
        to[name] = texture;
    };
    read(root.section("terrain"), uses.of_object, "ground");
    for (const Section& polygon : root.sections("ground")) {
        read(polygon, uses.of_object, polygon.text_or("name", ""));
    }
    for (const char* kind : {"building", "object"}) {
        for (const Section& section : root.sections(kind)) {
            read(section, uses.of_object, section.text_or("name", ""));
        }
    }
    const Section materials = root.section("material");
    for (const std::string& name : materials.free_keys()) {
        read(materials.section(name), uses.of_material, name);
    }
    return uses;
}

}  // namespace diurna
