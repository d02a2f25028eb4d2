#include <algorithm>

#include "materials/base/parallel.hpp"
#include "thermal/solve/pass.hpp"

namespace diurna {

void shine(Job& job) {
    job.sunlight.resize(job.instant.size() * job.facets);
    for_each_index(
        job.instant.size(),
        [&](std::size_t i) {
            std::span<const float> fraction;
            if (!job.input.sun.fraction.empty()) {
                fraction = {job.input.sun.fraction.data() + i * job.facets, job.facets};
            }
            incident_sunlight(job.input.facets, job.input.views, job.optics, job.sky[i], fraction,
                              job.options.exchange, job.row(job.sunlight, i));
        },
        1);
}

void find_jumps(Job& job) {
    const SunExposure& sun = job.input.sun;
    if (sun.edge.empty()) return;
    std::vector<std::size_t> block_of(job.facets), lane_of(job.facets);
    for (std::size_t b = 0; b < job.block.size(); ++b) {
        job.block[b].jumps.assign(job.instant.size(), 0);
        for (std::size_t l = 0; l < job.block[b].facet.size(); ++l) {
            block_of[job.block[b].facet[l]] = b;
            lane_of[job.block[b].facet[l]] = l;
        }
    }
    const auto beam = [&](std::size_t i, std::size_t f) {
        const SkyState& sky = job.sky[i];
        const double cosine = job.input.facets.normal[f].cast<double>().dot(sky.to_sun);
        return facet_sunlight(sky, cosine, 1.0, job.input.views.sky[f]) -
               facet_sunlight(sky, cosine, 0.0, job.input.views.sky[f]);
    };
    for (const ShadowEdge& edge : sun.edge) {
        const std::size_t i = edge.step, f = edge.facet;
        const double before = sun.fraction[i * job.facets + f];
        const double after = sun.fraction[(i + 1) * job.facets + f];
        const double whole = beam(i, f) + edge.share * (beam(i + 1, f) - beam(i, f));
        Block& block = job.block[block_of[f]];
        block.jump.push_back({lane_of[f], edge.share, (after - before) * whole});
        ++block.jumps[i + 1];
    }
    for (Block& block : job.block) {
        for (std::size_t i = 1; i < block.jumps.size(); ++i) block.jumps[i] += block.jumps[i - 1];
    }
}

std::vector<float> tilts(const Job& job) {
    const bool even = std::all_of(job.sky.begin(), job.sky.end(),
                                  [](const SkyState& sky) { return sky.tilted_longwave == 0.0; });
    if (even) return {};
    const TiltedSky table;
    std::vector<float> tilt(job.facets);
    for_each_index(
        job.facets,
        [&](std::size_t f) {
            tilt[f] = float(table.excess(job.input.facets.normal[f].z(), job.input.views.sky[f]));
        },
        4096);
    return tilt;
}

}  // namespace diurna
