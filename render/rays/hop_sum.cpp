#include "render/rays/hop_sum.hpp"

#include <algorithm>
#include <cmath>

#include "materials/base/fast_exp.hpp"
#include "render/path/direction_angles.hpp"
#include "render/rays/directional_light.hpp"

namespace diurna {

HopSum::HopSum(const HopTables& tables, const RoughMirrors& rough, SumOfHops apart)
    : tables_(tables),
      lobes_(tables, rough),
      rows_(tables, apart),
      lanes_(tables.lanes.size()),
      bands_(tables.band.size()),
      filter_(origin_count * lanes_),
      own_(sent_rows.size() * lanes_) {}

void HopSum::look(std::size_t k) {
    rows_.begin(tables_, k);
    lobes_.begin(rows_);
    scattered_.assign(rows_.list.size() * bands_, 0.0f);
    for (std::size_t i = 0; i < rows_.list.size(); ++i) add_hop(i);
}

void HopSum::add(std::size_t k, std::span<std::vector<float>> planes) {
    look(k);
    const std::size_t rows = planes.size() / bands_;
    for (std::size_t p = 0; p < planes.size(); ++p) {
        const double* lane = &rows_.sum[p % rows * lanes_];
        const auto& first = tables_.lanes.first;
        double sum = 0.0;
        for (std::size_t c = first[p / rows]; c < first[p / rows + 1]; ++c) sum += lane[c];
        planes[p][tables_.hops.pixel[k]] += static_cast<float>(sum);
    }
}

void HopSum::add_hop(std::size_t i) {
    const Hop& hop = rows_.list[i];
    pass(i);
    // A mirror's own way is left dark.
    for (std::size_t b = 0; hop.straight && b < bands_; ++b) {
        if (tables_.scattered_path[b]) add_scattered_path(i, b);
    }
    add_air(i);
    if (is_in_lobe(hop)) lobes_.take_expected(i, rows_);
    if (hop.kind == Hop::Kind::sky) return;
    const float* passed = rows_.passed_to(i);
    for (std::size_t o = 0; o < origin_count; ++o) {
        const float* transmittance = rows_.transmittance_to(i, static_cast<Origin>(o));
        float* filter = &filter_[o * lanes_];
        for (std::size_t c = 0; c < lanes_; ++c) {
            filter[c] = hop.weight * passed[c] * transmittance[c];
        }
    }
    if (hop.kind == Hop::Kind::plume) {
        add_plume(i);
    } else {
        add_facet(i);
        if (lobes_.has(hop)) lobes_.add(i, rows_);
    }
}

/// Whether a hop is what a ray off a rough mirror meets.
bool HopSum::is_in_lobe(const Hop& hop) const {
    return hop.way == Hop::Way::mirrored && lobes_.has(rows_.list[HopRows::before(hop)]);
}

/// What light is left of, past the hops before, and what it counts as.
void HopSum::pass(std::size_t i) {
    const Hop& hop = rows_.list[i];
    float* passed = rows_.passed_to(i);
    if (HopRows::starts(hop)) {
        std::fill_n(passed, lanes_, 1.0f);
        return;
    }
    const std::size_t before = HopRows::before(hop);
    const Hop& last = rows_.list[before];
    const float* earlier = rows_.passed_to(before);
    if (last.kind == Hop::Kind::plume) {
        const float* k = tables_.absorption[last.what].data();
        for (std::size_t c = 0; c < lanes_; ++c) {
            passed[c] = earlier[c] * fast_exp(-k[c] * last.chord);
        }
    } else if (is_in_lobe(hop)) {
        lobes_.pass(i, rows_);
    } else {
        const MaterialId material = tables_.input.facets.material[last.what];
        const AngleTable::Place at = tables_.angle[index(material)].at(double{last.cosine});
        const bool mirrored = hop.way == Hop::Way::mirrored;
        for (std::size_t c = 0; c < lanes_; ++c) {
            passed[c] = earlier[c] * (mirrored ? at.mirrored(c) : at.transmittance(c));
        }
    }
    Term& as = rows_.as[i];
    as = rows_.as[before] != Term::path  ? rows_.as[before]
         : hop.way == Hop::Way::mirrored ? Term::surroundings
                                         : Term::behind;
    if (as == Term::surroundings && hop.kind == Hop::Kind::sky) as = Term::sky;
}

/// Sunlight that the air scatters into the line of sight since the hop before.
void HopSum::add_scattered_path(std::size_t i, std::size_t b) {
    const Hop& hop = rows_.list[i];
    const ScatteredPath& table = *tables_.scattered_path[b];
    const float *passed = rows_.passed_to(i), *sun = tables_.sun[1].data();
    const auto& first = tables_.lanes.first;
    float passed_sun = 0.0f, all_sun = 0.0f;
    for (std::size_t c = first[b]; c < first[b + 1]; ++c) {
        passed_sun += passed[c] * sun[c];
        all_sun += sun[c];
    }
    float& here = scattered_[i * bands_ + b];
    if (hop.kind != Hop::Kind::sky) {
        const double from_sun =
            angle_between_deg(hop.direction.cast<double>(), tables_.input.to_sun);
        here = table(table.towards(from_sun, double{hop.direction.z()}), hop.range, height_km(hop));
    }
    const float nearer =
        HopRows::starts(hop) ? 0.0f : scattered_[HopRows::before(hop) * bands_ + b];
    rows_.row(i, Term::path)[first[b]] +=
        double{hop.weight} * double{passed_sun / std::max(all_sun, 1e-30f)} * double{here - nearer};
}

/// What the air up to here sends, or the sky, but for what is sent up to the hop before.
void HopSum::add_air(std::size_t i) {
    const Hop& hop = rows_.list[i];
    const std::size_t n = lanes_;
    float* radiance = &rows_.radiance[i * n];
    const float* nearer =
        HopRows::starts(hop) ? nullptr : &rows_.radiance[HopRows::before(hop) * n];
    if (hop.kind != Hop::Kind::sky) {
        tables_.air.to(hop.range, height_km(hop), &rows_.transmittance[i * origin_count * n],
                       radiance);
    } else if (hop.straight) {
        tables_.background_towards(hop.direction.cast<double>(), {radiance, n});
    } else {
        tables_.mirrored_background(hop.direction.cast<double>(),
                                    rows_.list[HopRows::before(hop)].range, {radiance, n});
        const float* dimmed = rows_.transmittance_to(HopRows::before(hop), Origin::surface);
        for (std::size_t c = 0; c < n; ++c) radiance[c] *= dimmed[c];
        nearer = nullptr;
    }
    const float* passed = rows_.passed_to(i);
    double* path = rows_.row(i, Term::path);
    for (std::size_t c = 0; c < n; ++c) {
        const float since = nearer ? radiance[c] - nearer[c] : radiance[c];
        path[c] += double{hop.weight * passed[c] * since};
    }
}

/// Light of a hop itself, (lane), through what is before it.
void HopSum::add_own(std::size_t i, const SentRow& own, const float* light) {
    const float* filter = &filter_[static_cast<std::size_t>(own.origin) * lanes_];
    double* sum = rows_.row(i, own.term);
    for (std::size_t c = 0; c < lanes_; ++c) sum[c] += double{filter[c] * light[c]};
    if (double* left = rows_.leaving(i, own.term)) {
        for (std::size_t c = 0; c < lanes_; ++c) left[c] += double{light[c]};
    }
}

void HopSum::add_plume(std::size_t i) {
    const Hop& hop = rows_.list[i];
    const float* absorbing = tables_.absorption[hop.what].data();
    const float* glows = tables_.glow[hop.what].data();
    for (std::size_t c = 0; c < lanes_; ++c) {
        own_[c] = -std::expm1(-absorbing[c] * hop.chord) * glows[c];
    }
    add_own(i, {Term::emitted, Origin::surface}, own_.data());
}

void HopSum::add_facet(std::size_t i) {
    const Hop& hop = rows_.list[i];
    const std::uint32_t target = tables_.target[rows_.first + i];
    const FacetLanes& lanes = tables_.facet_lanes;
    if (!hop.closed && tables_.material(hop).needs_rays()) {
        directional_light(tables_, hop, target, own_.data());
        for (std::size_t k = 0; k < sent_rows.size(); ++k) {
            add_own(i, sent_rows[k], &own_[k * lanes_]);
        }
    } else if (rows_.apart != SumOfHops::by_hop &&
               (rows_.apart == SumOfHops::whole || rows_.as[i] != Term::path)) {
        for (const Origin origin : all_origins) {
            add_own(i, {Term::emitted, origin}, lanes.radiosity(target, origin));
        }
    } else {
        for (std::size_t k = 0; k < sent_rows.size(); ++k) {
            add_own(i, sent_rows[k], lanes.sent(target, k));
        }
    }
}

}  // namespace diurna
