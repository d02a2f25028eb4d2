#include "render/rays/directional_light.hpp"

#include <algorithm>
#include <variant>

#include "materials/matter/directional_optics.hpp"
#include "materials/matter/measured_brdf.hpp"
#include "render/rays/lobe.hpp"
#include "render/rays/sun_glint.hpp"

namespace diurna {

namespace {

constexpr std::size_t row_of(Term term, Origin origin) {
    std::size_t k = 0;
    while (sent_rows[k].term != term || sent_rows[k].origin != origin) ++k;
    return k;
}

float* row(Term term, Origin origin, std::size_t lanes, float* out) {
    return out + row_of(term, origin) * lanes;
}

/// Its heat, and what it reflects of sky and surroundings.
void add_diffuse(const SecondaryTables& tables, const AngleTable::Place& at, std::uint32_t target,
                 float* out) {
    const std::size_t n = tables.lanes.size();
    const float* black = tables.facet_lanes.black(target);
    float* emitted = row(Term::emitted, Origin::surface, n, out);
    for (std::size_t c = 0; c < n; ++c) {
        emitted[c] = (1.0f - at.mirrored(c) - at.diffuse(c) - at.transmittance(c)) * black[c];
    }
    const auto reflect = [&](Term term, Origin origin, const float* arriving) {
        float* reflected = row(term, origin, n, out);
        for (std::size_t c = 0; c < n; ++c) reflected[c] = at.diffuse(c) * arriving[c];
    };
    for (const Origin origin : {Origin::sunlight, Origin::sky_heat}) {
        reflect(Term::sky, origin, tables.facet_lanes.from_sky(target, origin));
    }
    for (const Origin origin : all_origins) {
        reflect(Term::surroundings, origin, tables.facet_lanes.from_surroundings(target, origin));
    }
}

/// Sunlight, diffuse and mirrored.
void add_sun(const SecondaryTables& tables, const SecondaryRay& secondary, const AngleTable& table,
             const AngleTable::Place& at, std::uint32_t target, float* out) {
    const std::size_t n = tables.lanes.size(), i = tables.lit_index(target);
    float* light = row(Term::sun, Origin::sunlight, n, out);
    std::fill_n(light, n, 0.0f);
    const float sunlight = tables.light.state.sunlight[i];
    if (!(sunlight > 0.0f)) return;
    const Eigen::Vector3d& to_sun = tables.input.to_sun;
    const Eigen::Vector3d normal = tables.input.facets.normal[secondary.what].cast<double>();
    const Eigen::Vector3d eye = -secondary.direction.cast<double>();
    const AngleTable::Place towards_sun = table.at(std::max(0.0, normal.dot(to_sun)));
    const auto lobe =
        static_cast<float>(measured_lobe(tables.material(secondary).finish, normal, eye, to_sun));
    float glint = 0.0f;
    AngleTable::Place half_way = at;
    if (const auto* glossy = std::get_if<Glossy>(&tables.material(secondary).finish)) {
        Microfacets surface = microfacets_of(*glossy);
        surface.roughness = table.roughness();
        half_way = table.at(facing_between(eye, to_sun));
        // Water lies level: what its facet gets of the sun, a level one gets.
        const Eigen::Vector3d level =
            glossy->waves ? Eigen::Vector3d(Eigen::Vector3d::UnitZ()) : normal;
        const double turned = level.dot(to_sun) / std::max(1e-6, normal.dot(to_sun));
        glint =
            static_cast<float>(sun_glint(surface, level, eye, to_sun, double{secondary.cosine}) *
                               turned * double{sunlight});
    }
    const std::array<float, 3> up = height_weights(tables.lit.height[i]);
    const auto at_height = [&up](const std::array<std::vector<float>, 3>& sun, std::size_t c) {
        return up[0] * sun[0][c] + up[1] * sun[1][c] + up[2] * sun[2][c];
    };
    for (std::size_t c = 0; c < n; ++c) {
        const float mean = table.mean_diffuse(c);
        const float slant = mean > 0.0f ? towards_sun.diffuse(c) / mean : 0.0f;
        light[c] = lobe * at.diffuse(c) * slant * sunlight * at_height(tables.sun_and_aureole, c) +
                   glint * half_way.facing(c) * at_height(tables.sun, c);
    }
}

/// A room behind, at this angle; without one, what is behind is as warm as the facet.
void add_behind(const SecondaryTables& tables, const SecondaryRay& secondary,
                const AngleTable& table, const AngleTable::Place& at, std::uint32_t target,
                float* out) {
    const std::size_t n = tables.lanes.size();
    float* behind = row(Term::behind, Origin::surface, n, out);
    std::fill_n(behind, n, 0.0f);
    if (tables.material(secondary).see_through) return;
    const float* black = tables.facet_lanes.black(target);
    const std::vector<float>& of_room =
        tables.room[index(tables.input.facets.material[secondary.what])];
    const AngleTable::Place upright = table.at(laboratory_cosine);
    for (std::size_t c = 0; c < n; ++c) {
        if (of_room.empty()) {
            behind[c] = at.transmittance(c) * black[c];
        } else if (upright.transmittance(c) > 0.0f) {
            behind[c] = at.transmittance(c) / upright.transmittance(c) * of_room[c];
        }
    }
}

}  // namespace

void directional_light(const SecondaryTables& tables, const SecondaryRay& secondary,
                       std::uint32_t target, float* out) {
    const AngleTable& table = tables.angle[index(tables.input.facets.material[secondary.what])];
    const AngleTable::Place at = table.at(double{secondary.cosine});
    add_diffuse(tables, at, target, out);
    add_sun(tables, secondary, table, at, target, out);
    add_behind(tables, secondary, table, at, target, out);
}

}  // namespace diurna
