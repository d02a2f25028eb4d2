#include "render/rays/secondary_sum.hpp"

#include <algorithm>
#include <cmath>

#include "materials/base/fast_exp.hpp"
#include "render/path/direction_angles.hpp"
#include "render/rays/directional_light.hpp"

namespace diurna {

SecondarySum::SecondarySum(const SecondaryTables& tables, const RoughMirrors& rough,
                           SumOfSecondaryRays apart)
    : tables_(tables),
      lobes_(tables, rough),
      rows_(tables, apart),
      lanes_(tables.lanes.size()),
      bands_(tables.band.size()),
      filter_(origin_count * lanes_),
      own_(sent_rows.size() * lanes_) {}

void SecondarySum::look(std::size_t k) {
    rows_.begin(tables_, k);
    lobes_.begin(rows_);
    scattered_.assign(rows_.list.size() * bands_, 0.0f);
    for (std::size_t i = 0; i < rows_.list.size(); ++i) add_secondary(i);
}

void SecondarySum::add(std::size_t k, std::span<std::vector<float>> planes) {
    look(k);
    const std::size_t rows = planes.size() / bands_;
    for (std::size_t p = 0; p < planes.size(); ++p) {
        const double* lane = &rows_.sum[p % rows * lanes_];
        const auto& first = tables_.lanes.first;
        double sum = 0.0;
        for (std::size_t c = first[p / rows]; c < first[p / rows + 1]; ++c) sum += lane[c];
        planes[p][tables_.secondary_rays.pixel[k]] += static_cast<float>(sum);
    }
}

void SecondarySum::add_secondary(std::size_t i) {
    const SecondaryRay& secondary = rows_.list[i];
    pass(i);
    // A mirror's own way is left dark.
    for (std::size_t b = 0; secondary.straight && b < bands_; ++b) {
        if (tables_.scattered_path[b]) add_scattered_path(i, b);
    }
    add_air(i);
    if (is_in_lobe(secondary)) lobes_.take_expected(i, rows_);
    if (secondary.kind == SecondaryRay::Kind::sky) return;
    const float* passed = rows_.passed_to(i);
    for (std::size_t o = 0; o < origin_count; ++o) {
        const float* transmittance = rows_.transmittance_to(i, static_cast<Origin>(o));
        float* filter = &filter_[o * lanes_];
        for (std::size_t c = 0; c < lanes_; ++c) {
            filter[c] = secondary.weight * passed[c] * transmittance[c];
        }
    }
    if (secondary.kind == SecondaryRay::Kind::plume) {
        add_plume(i);
    } else {
        add_facet(i);
        if (lobes_.has(secondary)) lobes_.add(i, rows_);
    }
}

/// Whether a secondary ray is what a ray off a rough mirror meets.
bool SecondarySum::is_in_lobe(const SecondaryRay& secondary) const {
    return secondary.way == SecondaryRay::Way::mirrored &&
           lobes_.has(rows_.list[SecondaryRows::before(secondary)]);
}

/// What light is left of, past the secondary rays before, and what it counts as.
void SecondarySum::pass(std::size_t i) {
    const SecondaryRay& secondary = rows_.list[i];
    float* passed = rows_.passed_to(i);
    if (SecondaryRows::starts(secondary)) {
        std::fill_n(passed, lanes_, 1.0f);
        return;
    }
    const std::size_t before = SecondaryRows::before(secondary);
    const SecondaryRay& last = rows_.list[before];
    const float* earlier = rows_.passed_to(before);
    if (last.kind == SecondaryRay::Kind::plume) {
        const float* k = tables_.absorption[last.what].data();
        for (std::size_t c = 0; c < lanes_; ++c) {
            passed[c] = earlier[c] * fast_exp(-k[c] * last.chord);
        }
    } else if (is_in_lobe(secondary)) {
        lobes_.pass(i, rows_);
    } else {
        const MaterialId material = tables_.input.facets.material[last.what];
        const AngleTable::Place at = tables_.angle[index(material)].at(double{last.cosine});
        const bool mirrored = secondary.way == SecondaryRay::Way::mirrored;
        for (std::size_t c = 0; c < lanes_; ++c) {
            passed[c] = earlier[c] * (mirrored ? at.mirrored(c) : at.transmittance(c));
        }
    }
    Term& as = rows_.as[i];
    as = rows_.as[before] != Term::path                 ? rows_.as[before]
         : secondary.way == SecondaryRay::Way::mirrored ? Term::surroundings
                                                        : Term::behind;
    if (as == Term::surroundings && secondary.kind == SecondaryRay::Kind::sky) as = Term::sky;
}

/// Sunlight that the air scatters into the line of sight since the secondary ray before.
void SecondarySum::add_scattered_path(std::size_t i, std::size_t b) {
    const SecondaryRay& secondary = rows_.list[i];
    const ScatteredPath& table = *tables_.scattered_path[b];
    const float *passed = rows_.passed_to(i), *sun = tables_.sun[1].data();
    const auto& first = tables_.lanes.first;
    float passed_sun = 0.0f, all_sun = 0.0f;
    for (std::size_t c = first[b]; c < first[b + 1]; ++c) {
        passed_sun += passed[c] * sun[c];
        all_sun += sun[c];
    }
    float& here = scattered_[i * bands_ + b];
    if (secondary.kind != SecondaryRay::Kind::sky) {
        const double from_sun =
            angle_between_deg(secondary.direction.cast<double>(), tables_.input.to_sun);
        here = table(table.towards(from_sun, double{secondary.direction.z()}), secondary.range,
                     height_km(secondary));
    }
    const float nearer = SecondaryRows::starts(secondary)
                             ? 0.0f
                             : scattered_[SecondaryRows::before(secondary) * bands_ + b];
    rows_.row(i, Term::path)[first[b]] += double{secondary.weight} *
                                          double{passed_sun / std::max(all_sun, 1e-30f)} *
                                          double{here - nearer};
}

/// What the air up to here sends, or the sky, except for what is sent up to the secondary ray
/// before.
void SecondarySum::add_air(std::size_t i) {
    const SecondaryRay& secondary = rows_.list[i];
    const std::size_t n = lanes_;
    float* radiance = &rows_.radiance[i * n];
    const float* nearer = SecondaryRows::starts(secondary)
                              ? nullptr
                              : &rows_.radiance[SecondaryRows::before(secondary) * n];
    if (secondary.kind != SecondaryRay::Kind::sky) {
        tables_.air.to(secondary.range, height_km(secondary),
                       &rows_.transmittance[i * origin_count * n], radiance);
    } else if (secondary.straight) {
        tables_.background_towards(secondary.direction.cast<double>(), {radiance, n});
    } else {
        tables_.mirrored_background(secondary.direction.cast<double>(),
                                    rows_.list[SecondaryRows::before(secondary)].range,
                                    {radiance, n});
        const float* dimmed =
            rows_.transmittance_to(SecondaryRows::before(secondary), Origin::surface);
        for (std::size_t c = 0; c < n; ++c) radiance[c] *= dimmed[c];
        nearer = nullptr;
    }
    const float* passed = rows_.passed_to(i);
    double* path = rows_.row(i, Term::path);
    for (std::size_t c = 0; c < n; ++c) {
        const float since = nearer ? radiance[c] - nearer[c] : radiance[c];
        path[c] += double{secondary.weight * passed[c] * since};
    }
}

/// Light of a secondary ray itself, (lane), through what is before it.
void SecondarySum::add_own(std::size_t i, const SentRow& own, const float* light) {
    const float* filter = &filter_[static_cast<std::size_t>(own.origin) * lanes_];
    double* sum = rows_.row(i, own.term);
    for (std::size_t c = 0; c < lanes_; ++c) sum[c] += double{filter[c] * light[c]};
    if (double* left = rows_.leaving(i, own.term)) {
        for (std::size_t c = 0; c < lanes_; ++c) left[c] += double{light[c]};
    }
}

void SecondarySum::add_plume(std::size_t i) {
    const SecondaryRay& secondary = rows_.list[i];
    const float* absorbing = tables_.absorption[secondary.what].data();
    const float* glows = tables_.glow[secondary.what].data();
    for (std::size_t c = 0; c < lanes_; ++c) {
        own_[c] = -std::expm1(-absorbing[c] * secondary.chord) * glows[c];
    }
    add_own(i, {Term::emitted, Origin::surface}, own_.data());
}

void SecondarySum::add_facet(std::size_t i) {
    const SecondaryRay& secondary = rows_.list[i];
    const std::uint32_t target = tables_.target[rows_.first + i];
    const FacetLanes& lanes = tables_.facet_lanes;
    if (!secondary.closed && tables_.material(secondary).needs_rays()) {
        directional_light(tables_, secondary, target, own_.data());
        for (std::size_t k = 0; k < sent_rows.size(); ++k) {
            add_own(i, sent_rows[k], &own_[k * lanes_]);
        }
    } else if (rows_.apart != SumOfSecondaryRays::by_secondary &&
               (rows_.apart == SumOfSecondaryRays::whole || rows_.as[i] != Term::path)) {
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
