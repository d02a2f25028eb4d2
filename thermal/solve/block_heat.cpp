#include "thermal/solve/block_heat.hpp"

#include <algorithm>

namespace diurna {

BlockHeat::BlockHeat(const SolveState& solve, const Level& level, const Block& block,
                     std::size_t filled, bool backs)
    : solve_(solve),
      level_(level),
      block_(block),
      kind_(level.kind[block.material]),
      filled_(filled),
      backs_(backs),
      face_heat_(solve, block, backs ? block.behind : block.facet) {
    face_heat_.at(face(0), 0, before_);
    std::copy_n(before_, filled, at_end);
    add_sky(0);
}

void BlockHeat::add_sky(std::size_t time) {
    const double emissivity =
        backs_ ? back_of(solve_, block_).emissivity : kind_.column.surface.emissivity;
    const double low = emissivity * kind_.low(block_, time).sky_longwave;
    const double more = emissivity * kind_.high(block_, time).sky_longwave - low;
    const double* const up = block_.up.data();
    if (block_.up.empty()) {
        for (std::size_t l = 0; l < filled_; ++l) at_end[l] += low;
    } else {
        for (std::size_t l = 0; l < filled_; ++l) at_end[l] += low + up[l] * more;
    }
}

void BlockHeat::begin_step(std::size_t i) {
    face_heat_.at(face(i), i, after_);
    edges_ = edges_of(level_, backs_ ? block_.back : block_.front, i);
    const double absorptance = edges_.empty() ? 0.0 : face(i).absorptance;
    for (const Block::Jump& edge : edges_) jump_[edge.lane] = absorptance * double(edge.heat);
}

void BlockHeat::begin_substep(int s, std::size_t time) {
    const int substeps = kind_.column.substeps;
    const double share = double(s + 1) / substeps;
    for (std::size_t l = 0; l < filled_; ++l) {
        at_start[l] = at_end[l];
        at_end[l] = smooth(l, share);
    }
    add_sky(time);
    jumps.clear();
    for (const Block::Jump& edge : edges_) {
        const double within = double(edge.share) * substeps - s;
        if (within < 1.0) at_end[edge.lane] += jump_[edge.lane];
        if (within >= 0.0 && within < 1.0) {
            jumps.push_back({edge.lane, std::clamp(within, 1e-3, 1.0 - 1e-3), jump_[edge.lane]});
        }
    }
}

void BlockHeat::end_step() {
    for (const Block::Jump& edge : edges_) jump_[edge.lane] = 0.0;
    std::copy_n(after_, filled_, before_);
}

}  // namespace diurna
