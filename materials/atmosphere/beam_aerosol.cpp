#include "materials/atmosphere/beam_aerosol.hpp"

#include <algorithm>
#include <cmath>

#include "materials/atmosphere/scaled_aerosol.hpp"

namespace diurna {

BeamAerosol::BeamAerosol(const Medium& medium) : medium_(medium) {
    part_[0].aerosol = medium.haze().boundary();
    part_[1].aerosol = medium.haze().tropospheric();
    for (Part& part : part_) {
        if (part.aerosol == nullptr) continue;
        part.node.assign(part.aerosol->node.size(), 0.0);
        part.level.assign(part.aerosol->levels.size(), 0.0);
    }
}

void BeamAerosol::add_part(Part& part, double dryness, double depth) const {
    medium_.add_aerosol(*part.aerosol, dryness, depth, part.node);
    const auto [low, high, t] = place_of(*part.aerosol, dryness);
    part.level[low] += depth * (1.0 - t);
    part.level[high] += depth * t;
}

void BeamAerosol::add(double height_km, double length_km) {
    const Haze& haze = medium_.haze();
    const bool rains = haze.rain(height_km) > 0.0;
    if (haze.boundary() == nullptr && !rains) return;
    const auto [boundary, troposphere, above] = haze.extinction(height_km);
    if (rains || (boundary > 0.0 && troposphere + above > 0.0)) {
        const ScaledAerosol here = scaled_aerosol(medium_, height_km);
        const std::size_t count = here.extinction.size();
        scaled_.resize(count, 0.0);
        peak_.resize(count, 0.0);
        for (std::size_t b = 0; b < count; ++b) {
            scaled_[b] += length_km * here.extinction[b];
            peak_[b] += length_km * here.peak(b);
        }
        return;
    }
    const double dryness = ln_dryness(air_at(medium_.model().profile, height_km));
    if (boundary > 0.0) add_part(part_[0], dryness, boundary * length_km);
    if (troposphere > 0.0) add_part(part_[1], dryness, troposphere * length_km);
    if (above > 0.0) add_part(part_[1], std::log(100.0), above * length_km);
}

void BeamAerosol::put(std::span<double> scaled, std::span<double> peak) const {
    const std::size_t count = peak.size(), first = medium_.bins().first;
    std::vector<double> extinction(count), absorption(count);
    const auto add_rows = [&](const std::vector<double>& weight, const auto& row,
                              std::vector<double>& sum) {
        for (std::size_t k = 0; k < weight.size(); ++k) {
            if (weight[k] == 0.0) continue;
            const double* const of = row(k) + first;
            for (std::size_t b = 0; b < count; ++b) sum[b] += weight[k] * of[b];
        }
    };
    for (const Part& part : part_) {
        if (part.aerosol == nullptr) continue;
        std::fill(extinction.begin(), extinction.end(), 0.0);
        std::fill(absorption.begin(), absorption.end(), 0.0);
        add_rows(
            part.node, [&](std::size_t k) { return part.aerosol->node[k].data(); }, extinction);
        add_rows(
            part.level, [&](std::size_t k) { return part.aerosol->levels[k].absorption.data(); },
            absorption);
        for (std::size_t b = 0; b < count; ++b) {
            const double g = part.aerosol->asymmetry[first + b];
            const double forward = g * g * std::max(0.0, extinction[b] - absorption[b]);
            peak[b] += forward;
            if (!scaled.empty()) scaled[b] += extinction[b] - forward;
        }
    }
    for (std::size_t b = 0; b < scaled_.size(); ++b) {
        peak[b] += peak_[b];
        if (!scaled.empty()) scaled[b] += scaled_[b];
    }
}

}  // namespace diurna
