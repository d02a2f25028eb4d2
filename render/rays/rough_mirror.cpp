#include "render/rays/rough_mirror.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <variant>

#include "materials/base/parallel.hpp"
#include "materials/base/units.hpp"
#include "materials/matter/directional_optics.hpp"
#include "render/path/interpolation.hpp"
#include "render/rays/lobe.hpp"

namespace diurna {

namespace {

/// Normals that differ less than this [rad] are one.
constexpr double same_normal = 2e-3;

Eigen::Vector3d to_eye(const SecondaryRay& secondary) {
    return -secondary.direction.cast<double>();
}

const Glossy& glossy_of(const Material& material) { return std::get<Glossy>(material.finish); }

/// Nodes of a table: a few to each width of the lobe.
double node_step(double roughness) { return std::clamp(0.25 * roughness, 0.005, 0.04); }

/// Of directions to the eye, in the plane of (θ cosφ, θ sinφ).
std::array<double, 2> flattened(const Eigen::Vector3d& normal, const Eigen::Vector3d& x,
                                const Eigen::Vector3d& y, const Eigen::Vector3d& direction) {
    const double east = direction.dot(x), north = direction.dot(y), level = std::hypot(east, north);
    if (level < 1e-12) return {0.0, 0.0};
    const double angle = std::atan2(level, direction.dot(normal));
    return {angle * east / level, angle * north / level};
}

}  // namespace

RoughMirrors::RoughMirrors(const SecondaryTables& tables)
    : tables_(tables), group_of_(2 * tables.facet.size(), -1) {
    find_groups();
    std::vector<std::vector<std::uint32_t>> secondary_rays(group_.size());
    for (std::size_t h = 0; h < tables.secondary_rays.secondary.size(); ++h) {
        const SecondaryRay& secondary = tables.secondary_rays.secondary[h];
        if (!has(secondary)) continue;
        secondary_rays[static_cast<std::size_t>(group_of_[place(secondary)])].push_back(
            static_cast<std::uint32_t>(h));
    }
    for (std::size_t g = 0; g < group_.size(); ++g) {
        lay_out(group_[g], secondary_rays[g]);
        fill(group_[g]);
    }
}

bool RoughMirrors::has(const SecondaryRay& secondary) const {
    return secondary.kind == SecondaryRay::Kind::facet && tables_.is_rough_mirror(secondary);
}

Eigen::Vector3d RoughMirrors::normal(const SecondaryRay& secondary) const {
    const Eigen::Vector3d up =
        glossy_of(tables_.material(secondary)).waves
            ? Eigen::Vector3d(Eigen::Vector3d::UnitZ())
            : Eigen::Vector3d(tables_.input.facets.normal[secondary.what].cast<double>());
    return up.dot(to_eye(secondary)) < 0.0 ? Eigen::Vector3d(-up) : up;
}

std::size_t RoughMirrors::place(const SecondaryRay& secondary) const {
    const auto at =
        std::lower_bound(tables_.facet.begin(), tables_.facet.end(), secondary.surface());
    const bool behind =
        tables_.input.facets.normal[secondary.what].cast<double>().dot(to_eye(secondary)) < 0.0;
    return 2 * static_cast<std::size_t>(at - tables_.facet.begin()) + std::size_t{behind};
}

bool RoughMirrors::around_towards(const SecondaryRay& mirror,
                                  const Eigen::Vector3d& direction) const {
    return direction.z() < 0.0 &&
           group_[static_cast<std::size_t>(group_of_[place(mirror)])].sees_facets;
}

void RoughMirrors::find_groups() {
    for (const SecondaryRay& secondary : tables_.secondary_rays.secondary) {
        if (!has(secondary)) continue;
        std::int32_t& of = group_of_[place(secondary)];
        if (of >= 0) continue;
        const MaterialId material = tables_.input.facets.material[secondary.what];
        const Eigen::Vector3d towards = normal(secondary);
        const float view =
            tables_.lit
                .sky_view[tables_.lit_index(static_cast<std::uint32_t>(place(secondary) / 2))];
        const bool sees_facets = counts_around(view, towards);
        const auto same = std::find_if(group_.begin(), group_.end(), [&](const Group& group) {
            return group.material == material && group.sees_facets == sees_facets &&
                   (group.normal - towards).norm() < same_normal;
        });
        of = static_cast<std::int32_t>(same - group_.begin());
        if (same != group_.end()) continue;
        Group& group = group_.emplace_back();
        group.material = material;
        group.sees_facets = sees_facets;
        group.normal = towards;
    }
}

void RoughMirrors::lay_out(Group& group, std::span<const std::uint32_t> secondary_rays) const {
    const std::vector<SecondaryRay>& all = tables_.secondary_rays.secondary;
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const std::uint32_t h : secondary_rays) {
        middle += to_eye(all[h]);
        group.distance +=
            double{all[h].range} * double{all[h].cosine} / double(secondary_rays.size());
    }
    middle -= middle.dot(group.normal) * group.normal;
    group.x = middle.norm() > 1e-9 ? middle.normalized() : group.normal.unitOrthogonal();
    group.y = group.normal.cross(group.x);
    Point low = {1e9, 1e9}, high = {-1e9, -1e9};
    for (const std::uint32_t h : secondary_rays) {
        const Point at = flattened(group.normal, group.x, group.y, to_eye(all[h]));
        for (std::size_t k = 0; k < 2; ++k) {
            low[k] = std::min(low[k], at[k]);
            high[k] = std::max(high[k], at[k]);
        }
    }
    const double step = node_step(tables_.angle[index(group.material)].roughness());
    for (std::size_t k = 0; k < 2; ++k) {
        group.nodes[k] = static_cast<std::size_t>(std::ceil((high[k] - low[k]) / step)) + 4;
        group.step[k] = std::max(1e-6, (high[k] - low[k]) / double(group.nodes[k] - 1));
        group.low[k] = low[k];
    }
    if (group.nodes[0] * group.nodes[1] > secondary_rays.size()) group.nodes = {0, 0};
}

void RoughMirrors::fill(Group& group) const {
    const std::size_t across = group.nodes[1], size = row_count * tables_.lanes.size();
    group.value.assign(group.nodes[0] * across * size, 0.0f);
    for_each_index(
        group.nodes[0] * across,
        [&](std::size_t k) {
            const Eigen::Vector2d at(group.low[0] + group.step[0] * double(k / across),
                                     group.low[1] + group.step[1] * double(k % across));
            const double angle = std::min(at.norm(), radians(89.9));
            const Eigen::Vector2d way =
                at.norm() > 1e-12 ? Eigen::Vector2d(at.normalized()) : Eigen::Vector2d::UnitX();
            const Eigen::Vector3d towards =
                std::cos(angle) * group.normal +
                std::sin(angle) * (way.x() * group.x + way.y() * group.y);
            sum(group, towards, static_cast<float>(group.distance / std::cos(angle)),
                &group.value[k * size]);
        },
        1);
}

void RoughMirrors::sum(const Group& group, const Eigen::Vector3d& towards, float range,
                       float* out) const {
    const std::size_t n = tables_.lanes.size();
    const AngleTable& table = tables_.angle[index(group.material)];
    Microfacets surface = microfacets_of(glossy_of(tables_.input.materials[group.material]));
    surface.roughness = table.roughness();
    const Lobe lobe(surface, group.normal, towards);
    std::fill_n(out, row_count * n, 0.0f);
    float *all = out + reflected * n, *far = out + sky * n, *near = out + around * n;
    std::vector<float> light(n);
    lobe.each(group.sees_facets, [&](const Lobe::Ray& ray, double share) {
        const AngleTable::Place at = table.at(ray.facing);
        const auto weight = static_cast<float>(share * ray.weight);
        const bool below = ray.direction.z() < 0.0 && group.sees_facets;
        if (!below) tables_.mirrored_background(ray.direction, range, light);
        for (std::size_t c = 0; c < n; ++c) {
            const float part = weight * at.facing(c);
            all[c] += part;
            (below ? near : far)[c] += below ? part : part * light[c];
        }
    });
}

void RoughMirrors::look(const SecondaryRay& secondary, float* out) const {
    const Group& group = group_[static_cast<std::size_t>(group_of_[place(secondary)])];
    const Eigen::Vector3d towards = to_eye(secondary);
    if (group.value.empty()) {
        sum(group, towards, secondary.range, out);
        return;
    }
    const Point at = flattened(group.normal, group.x, group.y, towards);
    const Stencil first = stencil((at[0] - group.low[0]) / group.step[0], group.nodes[0]);
    const Stencil second = stencil((at[1] - group.low[1]) / group.step[1], group.nodes[1]);
    const std::size_t size = row_count * tables_.lanes.size();
    std::fill_n(out, size, 0.0f);
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t k = 0; k < 4; ++k) {
            const float weight = first.weight[i] * second.weight[k];
            const std::size_t node = (first.start + i) * group.nodes[1] + second.start + k;
            const float* value = &group.value[node * size];
            for (std::size_t c = 0; c < size; ++c) out[c] += weight * value[c];
        }
    }
}

}  // namespace diurna
