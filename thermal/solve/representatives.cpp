#include "thermal/solve/representatives.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <numeric>
#include <utility>

namespace diurna {

namespace {

/// Of values for each facet those of the solved ones; none of none.
template <class T>
std::vector<T> chosen(const std::vector<T>& whole, const Representatives& r) {
    std::vector<T> part;
    if (whole.empty()) return part;
    part.reserve(r.solved.size());
    for (const std::uint32_t facet : r.solved) part.push_back(whole[facet]);
    return part;
}

FacetSet chosen(const FacetSet& whole, const Representatives& r) {
    FacetSet part;
    part.vertex = whole.vertex;
    part.corner = chosen(whole.corner, r);
    part.centroid = chosen(whole.centroid, r);
    part.normal = chosen(whole.normal, r);
    part.area = chosen(whole.area, r);
    part.material = chosen(whole.material, r);
    part.object = chosen(whole.object, r);
    return part;
}

/// Rows of solved facets; entries that one facet represents become one.
ViewFactors chosen(const ViewFactors& whole, const Representatives& r) {
    ViewFactors part;
    part.row.reserve(r.solved.size() + 1);
    part.row.push_back(0);
    std::vector<std::pair<std::uint32_t, float>> row;
    for (const std::uint32_t facet : r.solved) {
        row.clear();
        for (std::uint32_t k = whole.row[facet]; k < whole.row[facet + 1]; ++k) {
            row.emplace_back(r.place[whole.facet[k]], whole.factor[k]);
        }
        std::stable_sort(row.begin(), row.end(),
                         [](const auto& a, const auto& b) { return a.first < b.first; });
        for (std::size_t i = 0; i < row.size();) {
            const std::uint32_t seen = row[i].first;
            double sum = 0.0;
            for (; i < row.size() && row[i].first == seen; ++i) sum += double{row[i].second};
            part.facet.push_back(seen);
            part.factor.push_back(static_cast<float>(sum));
        }
        part.row.push_back(static_cast<std::uint32_t>(part.facet.size()));
    }
    part.facet.shrink_to_fit();
    part.factor.shrink_to_fit();
    return part;
}

FacetViews chosen(const FacetViews& whole, const Representatives& r) {
    return {.sky = chosen(whole.sky, r),
            .below = chosen(whole.below, r),
            .others = chosen(whole.others, r),
            .hidden = chosen(whole.hidden, r),
            .rays = chosen(whole.rays, r),
            .shares = chosen(whole.shares, r)};
}

/// A target's facets by their place among the solved ones.
NetworkObject chosen(NetworkObject object, const Representatives& r) {
    const auto place = [&](std::uint32_t& facet) {
        if (facet == no_number) return;
        assert(r.of(facet) == facet);
        facet = r.place[facet];
    };
    for (std::uint32_t& facet : object.facet) place(facet);
    for (std::uint32_t& facet : object.back) place(facet);
    return object;
}

/// Rows of so many values for each that was solved as rows for every facet.
std::vector<float> spread(const Representatives& r, const std::vector<float>& part,
                          std::size_t solved) {
    const std::size_t all = r.place.size();
    std::vector<float> whole(part.size() / solved * all);
    for (std::size_t row = 0; row * solved < part.size(); ++row) {
        const float* const from = part.data() + row * solved;
        float* const to = whole.data() + row * all;
        for (std::size_t f = 0; f < all; ++f) to[f] = from[r.place[f]];
    }
    return whole;
}

/// What lies on solved facets lies on those that they represent.
CoveredFacets spread(const Representatives& r, const CoveredFacets& part, std::size_t solved) {
    std::vector<std::uint32_t> place_in_part(solved, no_number);
    for (std::size_t i = 0; i < part.facet.size(); ++i) {
        place_in_part[part.facet[i]] = static_cast<std::uint32_t>(i);
    }
    CoveredFacets whole;
    std::vector<std::uint32_t> from;
    for (std::uint32_t f = 0; f < r.place.size(); ++f) {
        if (place_in_part[r.place[f]] == no_number) continue;
        whole.facet.push_back(f);
        from.push_back(place_in_part[r.place[f]]);
    }
    const std::size_t rows = part.empty() ? 0 : part.cover.size() / part.facet.size();
    whole.cover.reserve(rows * from.size());
    for (std::size_t row = 0; row < rows; ++row) {
        for (const std::uint32_t i : from) whole.cover.push_back(part.at(row)[i]);
    }
    return whole;
}

template <class T>
void append(std::vector<T>& to, const std::vector<T>& more) {
    to.insert(to.end(), more.begin(), more.end());
}

void append(FacetSet& facets, const FacetSet& more) {
    const auto first = static_cast<std::uint32_t>(facets.vertex.size());
    append(facets.vertex, more.vertex);
    for (std::array<std::uint32_t, 3> corner : more.corner) {
        for (std::uint32_t& v : corner) v += first;
        facets.corner.push_back(corner);
    }
    append(facets.centroid, more.centroid);
    append(facets.normal, more.normal);
    append(facets.area, more.area);
    append(facets.material, more.material);
    append(facets.object, more.object);
}

/// Values of which none may mean that all are `usual`.
template <class T>
void append(std::vector<T>& to, std::size_t before, const std::vector<T>& more, std::size_t count,
            T usual) {
    if (to.empty() && more.empty()) return;
    to.resize(before, usual);
    append(to, more);
    to.resize(before + count, usual);
}

/// What patches see, of each facet the one that represents it.
void append(FacetViews& views, const FacetViews& more, const Representatives& r) {
    const std::size_t before = views.sky.size(), count = more.sky.size();
    append(views.hidden, before, more.hidden, count, 0.0f);
    append(views.sky, more.sky);
    append(views.below, more.below);
    if (!views.rays.empty()) append(views.rays, more.rays);
    if (!views.shares.empty()) append(views.shares, more.shares);
    Representatives rows{.solved = std::vector<std::uint32_t>(count), .place = r.place};
    std::iota(rows.solved.begin(), rows.solved.end(), 0u);
    const ViewFactors others = chosen(more.others, rows);
    const std::uint32_t first = views.others.row.back();
    for (std::size_t k = 1; k < others.row.size(); ++k) {
        views.others.row.push_back(first + others.row[k]);
    }
    append(views.others.facet, others.facet);
    append(views.others.factor, others.factor);
}

/// Of facets, and then of patches as the facets that these are like have it.
template <class T>
std::vector<T> chosen(const std::vector<T>& whole, const Representatives& r,
                      const BesideFacets& beside) {
    std::vector<T> part = chosen(whole, r);
    if (whole.empty()) return part;
    for (const std::uint32_t facet : beside.like) part.push_back(whole[facet]);
    return part;
}

}  // namespace

Representatives all_represent_themselves(std::size_t facets) {
    Representatives r;
    r.solved.resize(facets);
    std::iota(r.solved.begin(), r.solved.end(), 0u);
    r.place = r.solved;
    return r;
}

SolvedPart::SolvedPart(const SolveInput& whole, const Representatives& r,
                       const BesideFacets& beside)
    : facets_(chosen(whole.facets, r)), views_(chosen(whole.views, r)) {
    if (whole.sunlight_views != nullptr) sunlight_views_ = chosen(*whole.sunlight_views, r);
    if (beside.size() > 0) {
        append(facets_, beside.facets);
        append(views_, beside.views, r);
        if (whole.sunlight_views != nullptr) append(sunlight_views_, beside.sunlight_views, r);
    }
    std::vector<NetworkObject> network;
    for (const NetworkObject& object : whole.network) network.push_back(chosen(object, r));
    input_ = std::make_unique<const SolveInput>(
        SolveInput{.facets = facets_,
                   .views = views_,
                   .sun = none_,
                   .materials = whole.materials,
                   .weather = whole.weather,
                   .site = whole.site,
                   .utc_offset = whole.utc_offset,
                   .elevation = whole.elevation,
                   .by_height = whole.by_height,
                   .height = chosen(whole.height, r, beside),
                   .part = chosen(whole.part, r, beside),
                   .beside = beside.size(),
                   .network = std::move(network),
                   .open_above = chosen(whole.open_above, r, beside),
                   .clear_sky = whole.clear_sky,
                   .measured_share = whole.measured_share,
                   .sunlight_views = whole.sunlight_views != nullptr ? &sunlight_views_ : nullptr});
}

SunExposure with_beside(SunExposure solved, std::size_t facets, const SunExposure& beside) {
    const std::size_t instants = solved.instant.size();
    const std::size_t patches = beside.fraction.size() / std::max<std::size_t>(1, instants);
    if (!solved.fraction.empty() && patches > 0) {
        // Rows grow from the last on, in place.
        const std::size_t all = facets + patches;
        solved.fraction.reserve(instants * all);
        solved.fraction.resize(instants * all);
        const auto row = [](std::vector<float>& of, std::size_t n) {
            return of.begin() + std::ptrdiff_t(n);
        };
        for (std::size_t i = instants; i-- > 0;) {
            std::vector<float>& of = solved.fraction;
            std::copy_backward(row(of, i * facets), row(of, (i + 1) * facets),
                               row(of, i * all + facets));
            const auto patch = beside.fraction.begin() + std::ptrdiff_t(i * patches);
            std::copy_n(patch, patches, row(of, i * all + facets));
        }
    }
    if (beside.edge.empty()) return solved;
    for (const ShadowEdge& edge : beside.edge) {
        solved.edge.push_back(
            {edge.step, static_cast<std::uint32_t>(facets + edge.facet), edge.share});
    }
    std::stable_sort(solved.edge.begin(), solved.edge.end(), [](const auto& a, const auto& b) {
        return std::pair(a.step, a.facet) < std::pair(b.step, b.facet);
    });
    return solved;
}

void spread(const Representatives& r, SpanResult& result, std::size_t beside) {
    if (r.everything() && beside == 0) return;
    const std::size_t solved = r.solved.size() + beside;
    TemperatureField& field = result.temperature;
    field.kelvin = spread(r, field.kelvin, solved);
    field.facets = r.place.size();
    field.solved_as.clear();
    for (std::size_t f = 0; !r.everything() && f < r.place.size(); ++f) {
        field.solved_as.push_back(static_cast<std::uint32_t>(r.of(f)));
    }
    field.water = spread(r, field.water, solved);
    HeatFluxField& heat = result.heat;
    if (heat.empty()) return;
    for (std::vector<float>& term : heat.watts) term = spread(r, term, solved);
    heat.facets = r.place.size();
}

}  // namespace diurna
