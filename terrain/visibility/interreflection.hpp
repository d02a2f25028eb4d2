#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "materials/base/parallel.hpp"

namespace diurna {

/// View factors as rows: facet f sees source[k] with factor[k] for k in [row[f], row[f + 1]).
struct SeenRows {
    std::span<const std::uint32_t> row;
    std::span<const std::uint32_t> source;
    std::span<const float> factor;
    std::span<const float> itself = {};  // (facet) view factor to its own group; empty: 0

    std::size_t facets() const { return row.size() - 1; }
};

/// Unsent light of facets: a number of values for each (instants, or modes of bands).
struct UnsentLight {
    float* value;        // (facet, lane)
    std::size_t stride;  // from one facet to the next
    std::size_t lanes;
    std::span<float> counts;  // (facet) its importance: facets above 1 send
};

/// Limit that real scenes do not reach: a closed room of snow needs 180.
inline constexpr int enough_sweeps = 1000;

namespace interreflection {

struct Sender {
    const float* value;
    float factor;
};

/// Σ factor × value over the senders, of `groups` groups of eight lanes from `first` on.
template <std::size_t groups>
void gather_lanes(std::span<const Sender> senders, std::size_t first, float* out) {
    using Lane = Eigen::Array<float, 8, 1>;  // stays in a register, as a plain array does not
    Lane sum[groups];
    for (Lane& of : sum) of = Lane::Zero();
    for (const Sender& from : senders) {
        const float* const value = from.value + first;
        for (std::size_t g = 0; g < groups; ++g) {
            sum[g] += from.factor * Eigen::Map<const Lane>(value + 8 * g);
        }
    }
    for (std::size_t g = 0; g < groups; ++g) Eigen::Map<Lane>(out + first + 8 * g) = sum[g];
}

/// The same of all lanes, as many at a time as registers hold.
inline void gather(std::span<const Sender> senders, std::size_t lanes, float* out) {
    std::size_t first = 0;
    for (; first + 64 <= lanes; first += 64) gather_lanes<8>(senders, first, out);
    for (; first + 32 <= lanes; first += 32) gather_lanes<4>(senders, first, out);
    if (first + 24 <= lanes) {
        gather_lanes<3>(senders, first, out);
        first += 24;
    } else if (first + 16 <= lanes) {
        gather_lanes<2>(senders, first, out);
        first += 16;
    } else if (first + 8 <= lanes) {
        gather_lanes<1>(senders, first, out);
        first += 8;
    }
    const std::size_t rest = lanes - first;  // fewer than eight
    float sum[8] = {};
    for (const Sender& from : rest > 0 ? senders : std::span<const Sender>()) {
        for (std::size_t k = 0; k < rest; ++k) sum[k] += from.factor * from.value[first + k];
    }
    std::copy_n(sum, rest, out + first);
}

}  // namespace interreflection

/// All interreflections between diffuse facets: Neumann's series of E = F (sent + R E), summed
/// until no facet has unsent light above the limit. Light received accumulates until it exceeds
/// the limit (progressive refinement: Cohen and others, SIGGRAPH 1988), so sweeps only process
/// what is not negligible; the rest at the end is in `unsent`, at most 1 per facet. If
/// importance is x / bound, E is below the infinite series by at most bound × s / (1 − r), with
/// s the largest Σ factor of a row and r the largest reflected share of the light received,
/// times s.
///
/// unsent   in: each facet's initial emission; out: light not sent
/// reflect  float(facet, const float* arrived, float* unsent): receives the light (lane), adds the
///          reflected part to `unsent`, and returns its importance. Called from many threads, once
///          per facet and sweep
/// sweeps   maximum number
/// returns  sweeps; the same bytes for any number of threads
template <class Reflect>
int interreflect(const SeenRows& rows, const UnsentLight& unsent, const Reflect& reflect,
                 int sweeps = enough_sweeps) {
    using interreflection::Sender;
    constexpr std::size_t grain = 512;
    const std::size_t facets = rows.facets(), count = unsent.lanes;
    std::vector<std::uint8_t> sends(facets), reached(facets);
    std::unique_ptr<float[]> arrived;  // memory of facets that receive nothing is never touched
    for (int sweep = 0;; ++sweep) {
        bool any = false;
        for (std::size_t f = 0; f < facets; ++f) any |= (sends[f] = unsent.counts[f] > 1.0f);
        if (!any || sweep == sweeps) return sweep;
        if (!arrived) arrived = std::make_unique_for_overwrite<float[]>(facets * count);
        for_each_block(facets, grain, [&](std::size_t begin, std::size_t end) {
            std::vector<Sender> list;
            const std::uint32_t* const source = rows.source.data();
            const float* const factor = rows.factor.data();
            const std::uint8_t* const sending = sends.data();
            for (std::size_t f = begin; f < end; ++f) {
                const std::uint32_t first = rows.row[f], last = rows.row[f + 1];
                if (list.size() <= last - first) list.resize(last - first + 1);
                Sender* next = list.data();
                // Without branches: whether a facet sends is anybody's guess.
                const auto add = [&](std::size_t from, float share) {
                    *next = {unsent.value + from * unsent.stride, share};
                    next += sending[from];
                };
                if (!rows.itself.empty() && rows.itself[f] > 0.0f) add(f, rows.itself[f]);
                for (std::uint32_t k = first; k < last; ++k) add(source[k], factor[k]);
                const std::span senders(std::as_const(list).data(), next);
                reached[f] = !senders.empty();
                if (reached[f]) interreflection::gather(senders, count, &arrived[f * count]);
            }
        });
        for_each_block(facets, grain, [&](std::size_t begin, std::size_t end) {
            for (std::size_t f = begin; f < end; ++f) {
                float* const own = unsent.value + f * unsent.stride;
                if (sends[f]) {
                    std::fill_n(own, count, 0.0f);
                    unsent.counts[f] = 0.0f;
                }
                if (reached[f]) unsent.counts[f] = reflect(f, &arrived[f * count], own);
            }
        });
    }
}

}  // namespace diurna
