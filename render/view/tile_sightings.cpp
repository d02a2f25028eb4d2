#include "render/view/tile_sightings.hpp"

#include <immintrin.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace diurna {

std::size_t group_samples(const std::uint32_t* facet, const float* range, const float* height,
                          std::size_t used, SampleGroup* group) {
    const auto ids = [&](int half) {
        return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(facet + 8 * half));
    };
    const __m256i id0 = ids(0), id1 = ids(1);
    const __m256 range0 = _mm256_loadu_ps(range), range1 = _mm256_loadu_ps(range + 8);
    const __m256 height0 = _mm256_loadu_ps(height), height1 = _mm256_loadu_ps(height + 8);
    const auto equal = [](__m256i a, __m256i b) {
        return _mm256_castsi256_ps(_mm256_cmpeq_epi32(a, b));
    };
    const auto bits = [](__m256 a, __m256 b) {
        return static_cast<std::uint32_t>(_mm256_movemask_ps(a)) |
               static_cast<std::uint32_t>(_mm256_movemask_ps(b)) << 8;
    };
    const __m256i nothing = _mm256_set1_epi32(static_cast<int>(index(no_facet)));
    std::uint32_t left = ~bits(equal(id0, nothing), equal(id1, nothing)) & ((1u << used) - 1u);
    const __m256i lane = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
    const __m256i lanes = _mm256_set1_epi32(static_cast<int>(used));
    const __m256 counts0 = _mm256_castsi256_ps(_mm256_cmpgt_epi32(lanes, lane));
    const __m256 counts1 = _mm256_castsi256_ps(
        _mm256_cmpgt_epi32(lanes, _mm256_add_epi32(lane, _mm256_set1_epi32(8))));
    std::size_t size = 0;
    while (left != 0) {
        const std::uint32_t id = facet[std::countr_zero(left)];
        const __m256i wanted = _mm256_set1_epi32(static_cast<int>(id));
        const __m256 in0 = _mm256_and_ps(equal(id0, wanted), counts0);
        const __m256 in1 = _mm256_and_ps(equal(id1, wanted), counts1);
        const std::uint32_t lanes_in = bits(in0, in1);
        left &= ~lanes_in;
        const __m256 ranges = _mm256_add_ps(_mm256_and_ps(range0, in0), _mm256_and_ps(range1, in1));
        const __m256 heights =
            _mm256_add_ps(_mm256_and_ps(height0, in0), _mm256_and_ps(height1, in1));
        const __m256 pairs = _mm256_hadd_ps(ranges, heights);
        const __m128 fours =
            _mm_add_ps(_mm256_castps256_ps128(pairs), _mm256_extractf128_ps(pairs, 1));
        const __m128 sums = _mm_hadd_ps(fours, fours);
        group[size++] = {id, static_cast<std::uint32_t>(std::popcount(lanes_in)) * one_sample,
                         double{_mm_cvtss_f32(sums)}, double{_mm_cvtss_f32(_mm_movehdup_ps(sums))}};
    }
    return size;
}

std::size_t merge_groups(SampleGroup* groups, std::size_t size, std::size_t more) {
    const SampleGroup* const end = groups + size + more;
    for (const SampleGroup* next = groups + size; next != end; ++next) {
        SampleGroup* const known = std::find_if(
            groups, groups + size, [&](const SampleGroup& g) { return g.facet == next->facet; });
        if (known == groups + size) {
            groups[size++] = *next;
            continue;
        }
        known->parts += next->parts;
        known->range += next->range;
        known->height += next->height;
    }
    return size;
}

namespace {

/// Part of a facet that a sighting belongs to: 1/128 of an octave of range, 16 m of height.
std::uint64_t part_of(const Sighting& s) {
    const auto bits = std::bit_cast<std::uint32_t>(s.deeper);
    const auto step = static_cast<std::uint32_t>(std::floor(s.higher / 16.0f) + 65536.0f);
    return std::uint64_t{bits >> 16} << 32 | step;
}

}  // namespace

TileGatherer::TileGatherer() : slot_(4096) {}

void TileGatherer::start_tile() {
    std::fill(slot_.begin(), slot_.end(), 0u);
    seen_.clear();
    samples_.clear();
    tile_ = {};
    seen_.reserve(2048);
    samples_.reserve(4096);
    tile_.sighting.reserve(4096);
    tile_.end.reserve(1024);
}

void TileGatherer::grow() {
    --shift_;
    slot_.assign(std::size_t{1} << (32 - shift_), 0u);
    const std::size_t last = slot_.size() - 1;
    for (std::size_t i = 0; i < seen_.size(); ++i) {
        std::size_t at = (seen_[i].facet * 0x9E3779B1u) >> shift_;
        while (slot_[at] != 0) at = (at + 1) & last;
        slot_[at] = static_cast<std::uint32_t>(i + 1);
    }
}

std::uint32_t TileGatherer::place_of(std::uint32_t facet) {
    const std::size_t last = slot_.size() - 1;
    std::size_t at = (facet * 0x9E3779B1u) >> shift_;
    for (; slot_[at] != 0; at = (at + 1) & last) {
        if (seen_[slot_[at] - 1].facet == facet) return slot_[at] - 1;
    }
    seen_.push_back({.facet = facet});
    const auto place = static_cast<std::uint32_t>(seen_.size() - 1);
    slot_[at] = place + 1;
    if (2 * seen_.size() > slot_.size()) grow();
    return place;
}

void TileGatherer::add_pixel(std::size_t place, std::span<const SampleGroup> groups, float share) {
    tile_.end.resize(place, static_cast<std::uint32_t>(tile_.sighting.size()));
    for (const SampleGroup& group : groups) {
        const std::uint32_t target = place_of(group.facet);
        const double samples = double(group.parts) * (1.0 / one_sample), each = 1.0 / samples;
        const auto range = static_cast<float>(group.range * each);
        const auto height = static_cast<float>(group.height * each);
        Seen& seen = seen_[target];
        seen.samples += samples;
        seen.near = std::min(seen.near, range);
        seen.far = std::max(seen.far, range);
        seen.low = std::min(seen.low, height);
        seen.high = std::max(seen.high, height);
        seen.range += group.range;
        seen.height += group.height;
        const auto n = static_cast<float>(samples);
        tile_.sighting.push_back(
            {.target = target, .weight = n * share, .deeper = range, .higher = height});
        samples_.push_back(n);
    }
    tile_.end.push_back(static_cast<std::uint32_t>(tile_.sighting.size()));
}

/// Gives the parts of facets that reach deep places of their own, after all others; what was the
/// whole facet's stays its first part's.
void TileGatherer::split_deep() {
    if (std::all_of(seen_.begin(), seen_.end(), [](const Seen& s) { return s.narrow(); })) return;
    std::vector<std::pair<std::uint32_t, std::uint64_t>> parts;
    for (const Sighting& s : tile_.sighting) {
        if (!seen_[s.target].narrow()) parts.emplace_back(s.target, part_of(s));
    }
    std::sort(parts.begin(), parts.end());
    parts.erase(std::unique(parts.begin(), parts.end()), parts.end());
    const std::size_t whole = seen_.size();
    std::vector<std::uint32_t> place(parts.size());
    for (std::size_t k = 0; k < parts.size(); ++k) {
        const std::uint32_t of = parts[k].first;
        const bool first = k == 0 || parts[k - 1].first != of;
        place[k] = first ? of : static_cast<std::uint32_t>(seen_.size());
        if (!first) seen_.push_back({.facet = seen_[of].facet});
    }
    std::vector<bool> deep(whole);
    for (const auto& part : parts) deep[part.first] = true;
    for (std::size_t k = 0; k < parts.size(); ++k) {
        Seen& seen = seen_[place[k]];
        seen = {.facet = seen.facet};
    }
    for (std::size_t k = 0; k < tile_.sighting.size(); ++k) {
        Sighting& s = tile_.sighting[k];
        if (!deep[s.target]) continue;
        const auto at =
            std::lower_bound(parts.begin(), parts.end(), std::pair{s.target, part_of(s)});
        s.target = place[static_cast<std::size_t>(at - parts.begin())];
        Seen& seen = seen_[s.target];
        const double samples = double{samples_[k]};
        seen.samples += samples;
        seen.range += double{s.deeper} * samples;
        seen.height += double{s.higher} * samples;
    }
}

TileSightings TileGatherer::finish_tile(std::size_t pixels) {
    tile_.end.resize(pixels, static_cast<std::uint32_t>(tile_.sighting.size()));
    split_deep();
    const std::size_t targets = seen_.size();
    tile_.met.resize(targets);
    tile_.range.resize(targets);
    tile_.height.resize(targets);
    for (std::size_t t = 0; t < targets; ++t) {
        tile_.met[t] = seen_[t].facet;
        tile_.range[t] = static_cast<float>(seen_[t].range / seen_[t].samples);
        tile_.height[t] = static_cast<float>(seen_[t].height / seen_[t].samples);
    }
    for (Sighting& s : tile_.sighting) {
        s.deeper -= tile_.range[s.target];
        s.higher -= tile_.height[s.target];
    }
    return std::move(tile_);
}

}  // namespace diurna
