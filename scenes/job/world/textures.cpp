#include "scenes/job/world/textures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "materials/base/units.hpp"
#include "materials/matter/broadband.hpp"
#include "materials/matter/varied.hpp"
#include "scenes/job/input/scene.hpp"
#include "scenes/job/world/stance.hpp"
#include "scenes/job/world/world.hpp"
#include "terrain/ground/ring_index.hpp"
#include "terrain/ground/rings.hpp"

namespace diurna {

namespace {

using What = TextureInput::What;

/// The parameter that a texture varies, and what a material can have of it.
struct Parameter {
    double own, most;
};
Parameter parameter_of(const Material& material, What what) {
    if (what == What::emissivity) {
        return {material.thermal.emissivity, 1.0 - planck_mean(material.transmittance)};
    }
    return {material.thermal.albedo, 1.0 - material.thermal.solar_transmittance};
}

/// Least and greatest value on a material, and the one where the texture has none.
struct Values {
    double least, most, outside;
};

Values clutter_values(const TextureInput& texture, const Material& material) {
    constexpr double furthest = 3.0, widest = 2.0;  // deviations
    if (texture.what == What::mixture) return {0.0, 1.0, *texture.mean};
    const Parameter parameter = parameter_of(material, texture.what);
    const double mean = texture.mean.value_or(parameter.own);
    const double room = std::min(mean, parameter.most - mean);
    if (widest * texture.deviation > room + 1e-12) {
        throw InputError(
            texture.where,
            fmt::format("std = {:g} about {:.3g} on material \"{}\": more than 2.5 % of values "
                        "would be cut off at 0 or {:.3g}, expected at most {:.3g}",
                        texture.deviation, mean, material.name, parameter.most,
                        std::max(0.0, room / widest)));
    }
    return {std::max(0.0, mean - furthest * texture.deviation),
            std::min(parameter.most, mean + furthest * texture.deviation), mean};
}

Values image_values(const TextureInput& texture, const Material& material) {
    if (texture.what == What::mixture) return {0.0, 1.0, 0.0};
    double least = 1.0, most = 0.0;
    for (const float v : texture.image.value) {
        if (std::isnan(v)) continue;
        least = std::min(least, std::max(0.0, double{v}));
        most = std::max(most, std::min(1.0, double{v}));
    }
    const Parameter parameter = parameter_of(material, texture.what);
    if (most > parameter.most + 1e-6) {
        throw InputError(texture.where,
                         fmt::format("has values up to {:.3g} on material \"{}\", expected at most "
                                     "{:.3g}: the material transmits the rest",
                                     most, material.name, parameter.most));
    }
    return {std::min(least, parameter.own), std::max(most, parameter.own), parameter.own};
}

/// Materials of a texture's levels.
Skin skin_of(const TextureInput& texture, const Material& base, MaterialLibrary& materials) {
    const Values values =
        texture.clutter ? clutter_values(texture, base) : image_values(texture, base);
    Skin skin{.texture = {}, .material = {}, .low = values.least, .outside = values.outside};
    if (texture.what == What::mixture) {
        for (const std::string& name : texture.between) {
            skin.material.push_back(materials.find(name, texture.where));
        }
        return skin;
    }
    const double one_level = texture.what == What::albedo ? 0.3 : 0.2;  // textured_scene_test.cpp
    const double range = std::max(values.most - values.least, 1e-9);
    const int levels = texture.levels > 0
                           ? texture.levels
                           : 1 + static_cast<int>(std::ceil(range / one_level - 1e-9));
    skin.step = range / (levels - 1);
    for (int k = 0; k < levels; ++k) {
        const double value = values.least + k * skin.step;
        Material level =
            texture.what == What::albedo ? with_albedo(base, value) : with_emissivity(base, value);
        level.name = fmt::format("{} ({} {:.6g})", base.name,
                                 texture.what == What::albedo ? "albedo" : "emissivity", value);
        level.varies = base.kind();
        skin.material.push_back(materials.add(std::move(level)));
    }
    return skin;
}

/// A picture on the plane of its frame.
RasterTexture raster_of(const TextureInput& texture, const World& world, bool on_object) {
    const TextureImage& image = texture.image;
    RasterTexture::Layout layout{.columns = image.columns,
                                 .rows = image.rows,
                                 .value = image.value,
                                 .nearest = texture.nearest,
                                 .repeat = texture.repeat};
    for (Eigen::Vector2d& term : layout.to_texel) term.setZero();
    if (texture.metres_per_texel > 0.0) {
        const double c = std::cos(radians(texture.heading_deg)) / texture.metres_per_texel,
                     s = std::sin(radians(texture.heading_deg)) / texture.metres_per_texel;
        // East and north of the middle, to columns rightward and rows downward.
        layout.to_texel[1] = {c, -s};
        layout.to_texel[2] = {-s, -c};
        layout.to_texel[0] = Eigen::Vector2d(0.5 * image.columns, 0.5 * image.rows) -
                             texture.place.x() * layout.to_texel[1] -
                             texture.place.y() * layout.to_texel[2];
        return RasterTexture(std::move(layout));
    }
    if (on_object) {
        throw InputError(texture.where,
                         "the texture is on an object, but its georeference applies to ground only",
                         "set metres_per_texel");
    }
    double reach = 0.0, worst = 0.0;
    for (std::size_t f = 0; f < world.ground_facets; ++f) {
        reach = std::max(reach, double{world.facets.centroid[f].head<2>().cwiseAbs().maxCoeff()});
    }
    layout.to_texel = texels_from_site(image, world.site, reach, &worst);
    if (worst > 0.5) {
        throw InputError(texture.where,
                         fmt::format("its CRS deviates from a parabola by {:.1f} texels over the "
                                     "scene, expected at most half a texel",
                                     worst));
    }
    return RasterTexture(std::move(layout));
}

/// Where an object stands and how it is turned.
TextureFrame frame_of(const World& world, std::size_t object, const ObjectInput& input) {
    double lowest = 1e30;
    for (std::size_t f = 0; f < world.facets.size(); ++f) {
        if (static_cast<std::size_t>(world.facets.object[f]) != object) continue;
        for (const std::uint32_t corner : world.facets.corner[f]) {
            lowest = std::min(lowest, double{world.facets.vertex[corner].z()});
        }
    }
    const Stance stance = stance_in(input.placing);
    if (!stance.level()) {
        return {.origin = stance.base,
                .heading = radians(stance.heading_deg),
                .to_level = stance.to_level()};
    }
    return {.origin = {input.place.x(), input.place.y(), lowest},
            .heading = radians(input.placing.heading_deg)};
}

/// Polygons that leave the material to the rules, and so are no objects of their own, but name a
/// texture.
std::vector<const GroundPolygon*> textured_polygons(const Scene& scene) {
    std::vector<const GroundPolygon*> polygons;
    for (const GroundPolygon& polygon : scene.terrain.polygons) {
        if (polygon.material.empty() && scene.texture_uses.of_object.contains(polygon.name)) {
            polygons.push_back(&polygon);
        }
    }
    return polygons;
}

std::vector<Ring> rings_of(const std::vector<const GroundPolygon*>& polygons) {
    std::vector<Ring> rings;
    for (const GroundPolygon* polygon : polygons) rings.push_back(polygon->ring);
    return rings;
}

/// The texture of a place on the ground: that of the last such polygon there, else the terrain's.
class TexturedGround {
 public:
    explicit TexturedGround(const Scene& scene)
        : uses_(scene.texture_uses.of_object),
          polygons_(textured_polygons(scene)),
          index_(rings_of(polygons_)) {}
    std::map<std::string, std::string>::const_iterator at(const Eigen::Vector3f& place) const {
        const std::int32_t last = index_.last_around(place.head<2>().cast<double>());
        return uses_.find(last < 0 ? "ground" : polygons_[std::size_t(last)]->name);
    }

 private:
    const std::map<std::string, std::string>& uses_;
    std::vector<const GroundPolygon*> polygons_;
    RingIndex index_;
};

/// The skins of a scene's textures: made as facets ask for them, one for each texture, material and
/// frame, with the materials of their levels added to the scene's.
class Skins {
 public:
    Skins(Scene& scene, const World& world)
        : scene_(scene),
          world_(world),
          first_object_(1 + scene.terrain.polygons.size() + scene.terrain.buildings.size()) {}

    /// The skin of a texture on a material of an object.
    std::uint16_t of(std::size_t texture, MaterialId material, std::size_t object) {
        const bool own_frame =
            object >= first_object_ && object < first_object_ + scene_.terrain.objects.size();
        const auto [entry, fresh] =
            known_.try_emplace({texture, index(material), own_frame ? object : 0},
                               static_cast<std::uint16_t>(skins_.size()));
        if (!fresh) return entry->second;
        const TextureInput& input = scene_.textures[texture];
        const Material base = scene_.materials[material];
        Skin skin = skin_of(input, base, scene_.materials);
        if (own_frame) {
            skin.frame = frame_of(world_, object, scene_.terrain.objects[object - first_object_]);
        }
        if (input.clutter) {
            const double mean = input.mean.value_or(skin.outside);
            skin.texture = std::make_shared<const Texture>(
                ClutterTexture{mean, input.deviation, Clutter(*input.clutter)});
        } else {
            auto& picture = pictures_[{texture, own_frame}];
            if (!picture) {
                picture = std::make_shared<const Texture>(raster_of(input, world_, own_frame));
            }
            skin.texture = picture;
        }
        skins_.push_back(std::move(skin));
        return entry->second;
    }

    std::vector<Skin> take() { return std::move(skins_); }

    /// Whether a skin is of a texture.
    bool is_of(std::uint16_t skin, std::size_t texture) const {
        return std::any_of(known_.begin(), known_.end(), [&](const auto& entry) {
            return entry.second == skin && std::get<0>(entry.first) == texture;
        });
    }

 private:
    Scene& scene_;
    const World& world_;
    std::size_t first_object_;
    std::vector<Skin> skins_;
    // (texture, material, its frame: 0 the scene's, else the object's) and its skin
    std::map<std::tuple<std::size_t, std::size_t, std::size_t>, std::uint16_t> known_;
    std::map<std::pair<std::size_t, bool>, std::shared_ptr<const Texture>> pictures_;
};

/// The name of the texture that lies on a facet; "" for none. An object's own goes before that of
/// its material.
std::string texture_on(const Scene& scene, const World& world, const TexturedGround& ground,
                       std::size_t facet) {
    const TextureUses& uses = scene.texture_uses;
    const auto object = static_cast<std::size_t>(world.facets.object[facet]);
    const auto use = object == 0 ? ground.at(world.facets.centroid[facet])
                                 : uses.of_object.find(world.objects[object]);
    if (use != uses.of_object.end()) return use->second;
    const auto by_material =
        uses.of_material.find(scene.materials[world.facets.material[facet]].kind());
    return by_material == uses.of_material.end() ? "" : by_material->second;
}

/// For the report: how many facets each texture lies on, and as how many they are solved.
std::vector<std::string> texture_notes(const Scene& scene, const World& world, const Skins& skins) {
    std::vector<std::string> notes;
    for (std::size_t t = 0; t < scene.textures.size(); ++t) {
        const TextureInput& texture = scene.textures[t];
        std::size_t facets = 0, surfaces = 0;
        for (const TextureLevels::OfFacet& of_facet : world.texture_levels.of_facet) {
            if (of_facet.skin == no_skin || !skins.is_of(of_facet.skin, t)) continue;
            ++facets;
            surfaces += of_facet.levels;
        }
        std::string note = fmt::format("texture \"{}\": {} facets, solved as {} surfaces",
                                       texture.name, facets, surfaces);
        if (texture.clutter) {
            note += fmt::format("; standard deviation {:g}, correlation length {:g} m",
                                texture.deviation, texture.clutter->length);
        }
        notes.push_back(std::move(note));
    }
    return notes;
}

}  // namespace

std::vector<std::string> lay_textures(Scene& scene, World& world) {
    if (scene.texture_uses.of_object.empty() && scene.texture_uses.of_material.empty()) return {};
    std::map<std::string, std::size_t> by_name;
    for (std::size_t t = 0; t < scene.textures.size(); ++t) by_name[scene.textures[t].name] = t;
    Skins skins(scene, world);
    const TexturedGround ground(scene);
    std::vector<std::uint16_t> skin_of_facet(world.facets.size(), no_skin);
    for (std::size_t f = 0; f < world.facets.size(); ++f) {
        // The back of a sheet has no heat of its own to be split.
        if (scene.materials[world.facets.material[f]].thermal.layers.empty()) continue;
        const std::string name = texture_on(scene, world, ground, f);
        if (name.empty()) continue;
        skin_of_facet[f] = skins.of(by_name.at(name), world.facets.material[f],
                                    static_cast<std::size_t>(world.facets.object[f]));
    }
    world.texture_levels = split_by_texture(world.facets, skins.take(), skin_of_facet);
    return texture_notes(scene, world, skins);
}

}  // namespace diurna
