#include "render/rays/lobe_light.hpp"

#include <Eigen/Core>
#include <algorithm>

#include "render/rays/lobe.hpp"

namespace diurna {

LobeLight::LobeLight(const SecondaryTables& tables, const RoughMirrors& rough)
    : tables_(tables),
      rough_(rough),
      background_(tables.lanes.size()),
      share_(tables.lanes.size()) {}

void LobeLight::begin(const SecondaryRows& rows) {
    lobe_.resize(rows.list.size() * RoughMirrors::row_count * tables_.lanes.size());
}

void LobeLight::add(std::size_t mirror, SecondaryRows& rows) {
    const SecondaryRay& secondary = rows.list[mirror];
    const std::size_t lanes = tables_.lanes.size();
    rough_.look(secondary, &lobe_[mirror * RoughMirrors::row_count * lanes]);
    const float* all = row(mirror, RoughMirrors::reflected);
    const MaterialId material = tables_.input.facets.material[secondary.what];
    const AngleTable::Place at = tables_.angle[index(material)].at(double{secondary.cosine});
    const float* passed = rows.passed_to(mirror);
    for (std::size_t c = 0; c < lanes; ++c) {
        share_[c] = secondary.weight * passed[c] * at.mirrored(c) / std::max(all[c], 1e-30f);
    }
    const float open = open_above(mirror, rows);
    const float* near = row(mirror, RoughMirrors::around);
    whole_ = share_;
    for (std::size_t c = 0; c < lanes; ++c) share_[c] *= open;
    add_background(mirror, row(mirror, RoughMirrors::sky), rows);
    for (std::size_t c = 0; c < lanes; ++c) {
        share_[c] = whole_[c] * (near[c] + (1.0f - open) * (all[c] - near[c]));
    }
    add_around(mirror, rows);
}

void LobeLight::take_expected(std::size_t i, SecondaryRows& rows) {
    const SecondaryRay& secondary = rows.list[i];
    const std::size_t mirror = SecondaryRows::before(secondary), lanes = tables_.lanes.size();
    const float* passed = rows.passed_to(i);
    for (std::size_t c = 0; c < lanes; ++c) share_[c] = -secondary.weight * passed[c];
    const Eigen::Vector3d direction = secondary.direction.cast<double>();
    if (rough_.around_towards(rows.list[mirror], direction)) {
        add_around(mirror, rows);
        return;
    }
    const float open = open_above(mirror, rows);
    whole_ = share_;
    for (std::size_t c = 0; c < lanes; ++c) share_[c] *= open;
    tables_.mirrored_background(direction, rows.list[mirror].range, background_);
    add_background(mirror, background_.data(), rows);
    for (std::size_t c = 0; c < lanes; ++c) share_[c] = (1.0f - open) * whole_[c];
    if (open < 1.0f) add_around(mirror, rows);
}

void LobeLight::pass(std::size_t i, SecondaryRows& rows) const {
    const SecondaryRay& secondary = rows.list[i];
    const std::size_t mirror = SecondaryRows::before(secondary);
    const SecondaryRay& last = rows.list[mirror];
    const AngleTable& table = tables_.angle[index(tables_.input.facets.material[last.what])];
    const AngleTable::Place at = table.at(double{last.cosine});
    const AngleTable::Place here = table.at(
        facing_between(-last.direction.cast<double>(), secondary.direction.cast<double>()));
    const float* all = row(mirror, RoughMirrors::reflected);
    const float* earlier = rows.passed_to(mirror);
    float* passed = rows.passed_to(i);
    for (std::size_t c = 0; c < tables_.lanes.size(); ++c) {
        passed[c] = earlier[c] * at.mirrored(c) * here.facing(c) / std::max(all[c], 1e-30f);
    }
}

float LobeLight::open_above(std::size_t mirror, const SecondaryRows& rows) const {
    const std::uint32_t target = tables_.target[rows.first + mirror];
    return open_sky(tables_.lit.sky_view[tables_.lit_index(target)],
                    rough_.normal(rows.list[mirror]));
}

/// Radiance of the background (lane) at a mirror, by the shares of it.
void LobeLight::add_background(std::size_t mirror, const float* light, SecondaryRows& rows) const {
    const float* dimmed = rows.transmittance_to(mirror, Origin::surface);
    double* sum = rows.mirrored_row(mirror, Term::sky);
    for (std::size_t c = 0; c < tables_.lanes.size(); ++c) {
        sum[c] += double{share_[c] * dimmed[c] * light[c]};
    }
}

/// The mean of what arrives at a mirror from the facets around, by the shares of it.
void LobeLight::add_around(std::size_t mirror, SecondaryRows& rows) const {
    const std::uint32_t target = tables_.target[rows.first + mirror];
    const float seen = 1.0f - tables_.lit.sky_view[tables_.lit_index(target)];
    if (!(seen > 0.0f)) return;
    double* sum = rows.mirrored_row(mirror, Term::surroundings);
    for (const Origin origin : all_origins) {
        const float* dimmed = rows.transmittance_to(mirror, origin);
        const float* light = tables_.facet_lanes.from_surroundings(target, origin);
        for (std::size_t c = 0; c < tables_.lanes.size(); ++c) {
            sum[c] += double{share_[c] * dimmed[c] * light[c] / seen};
        }
    }
}

}  // namespace diurna
