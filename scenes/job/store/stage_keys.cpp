#include "scenes/job/store/stage_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "materials/matter/passed_light.hpp"
#include "scenes/job/store/key_facts.hpp"

namespace diurna {

namespace {

/// (facet) what goes through it, as a number in the order of first use, so that paints that let
/// nothing pass are one; and these, as they are.
void add_passing(const Prepared& prepared, KeyFacts& facts) {
    const std::vector<PassedLight> passed = passed_light(prepared.scene.materials);
    std::vector<std::uint16_t> kind(passed.size(), 0);
    std::vector<const PassedLight*> kinds;
    for (std::size_t m = 0; m < passed.size(); ++m) {
        const auto alike = [&](const PassedLight* other) {
            return other->beam == passed[m].beam && other->heat == passed[m].heat &&
                   other->sunlight == passed[m].sunlight && other->sheet == passed[m].sheet;
        };
        const auto found = std::find_if(kinds.begin(), kinds.end(), alike);
        kind[m] = std::uint16_t(found - kinds.begin());
        if (found == kinds.end()) kinds.push_back(&passed[m]);
    }
    std::map<std::uint16_t, std::uint16_t> order;
    std::vector<std::uint16_t> of_facet;
    for (const MaterialId id : prepared.world.facets.material) {
        const auto next = std::uint16_t(order.size());
        of_facet.push_back(order.try_emplace(kind[index(id)], next).first->second);
    }
    facts.array<std::uint16_t>(of_facet);
    std::vector<const PassedLight*> used(order.size());
    for (const auto& [k, place] : order) used[place] = kinds[k];
    for (const PassedLight* light : used) {
        facts.array<float>(light->beam);
        facts.number(light->heat);
        facts.number(light->sunlight);
        facts.number(light->sheet);
    }
}

void add_relief(const HeightField& relief, KeyFacts& facts) {
    const int columns = relief.columns(), rows = relief.rows();
    facts.number(columns);
    facts.number(rows);
    std::vector<float> up;
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) up.push_back(relief.up(row, column));
    }
    facts.array<float>(up);
    // The plan is quadratic between nine posts.
    for (const double y : {0.0, 0.5, 1.0}) {
        for (const double x : {0.0, 0.5, 1.0}) {
            const Eigen::Vector2d at = relief.place({x * (columns - 1), y * (rows - 1)});
            facts.number(at.x());
            facts.number(at.y());
        }
    }
}

void add_visibility(const Prepared& prepared, KeyFacts& facts) {
    const World& world = prepared.world;
    const FacetSet& facets = world.facets;
    facts.array<Eigen::Vector3f>(facets.vertex);
    facts.array<std::array<std::uint32_t, 3>>(facets.corner);
    facts.array<ObjectId>(facets.object);
    facts.number(world.ground_facets);
    facts.array<std::uint8_t>(world.on_detail);
    add_passing(prepared, facts);
    facts.number(world.copies.size());
    for (std::size_t c = 0; c < world.copies.size(); ++c) {
        const Copy& copy = world.copies[c];
        facts.number(copy.first);
        facts.number(copy.facets);
        facts.number(std::uint16_t(copy.object));
        facts.array<double>({copy.pose.data(), 16});
    }
    facts.number(world.relief.has_value());
    if (world.relief) add_relief(*world.relief, facts);
    facts.number(prepared.scene.sky_rays);
    facts.number(prepared.scene.object_sky_rays);
    facts.number(prepared.scene.sun_samples);
    facts.number(prepared.scene.seed);
}

}  // namespace

std::string visibility_key(const Prepared& prepared) {
    KeyFacts facts = stage_facts("visibility");
    add_visibility(prepared, facts);
    return facts.digest();
}

std::string sky_key(const Prepared& prepared, bool sunlight) {
    KeyFacts facts = stage_facts("sky");
    facts.line(visibility_key(prepared));
    facts.number(sunlight);
    return facts.digest();
}

std::string sun_key(const Prepared& prepared, const std::vector<Instant>& instants,
                    std::span<const std::uint8_t> asked) {
    KeyFacts facts = stage_facts("sun");
    facts.line(visibility_key(prepared));
    const Site& site = prepared.world.site;
    for (const double of : {site.latitude_deg, site.longitude_deg, site.height}) facts.number(of);
    facts.number(prepared.world.sea_level_height);
    for (const Instant when : instants) facts.number(seconds_between(Instant{}, when));
    // By its pressure and temperature the air bends the way of the light.
    const Weather& weather = prepared.weather;
    for (std::size_t i = 0; i < weather.sample.size(); ++i) {
        facts.number(seconds_between(Instant{}, weather.instant[i]));
        facts.number(weather.sample[i].air.pressure);
        facts.number(weather.sample[i].air.temperature);
    }
    facts.array<std::uint8_t>(asked);
    return facts.digest();
}

}  // namespace diurna
