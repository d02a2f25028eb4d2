#include "render/rays/hop_light.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <memory>
#include <utility>

#include "materials/base/fast_exp.hpp"
#include "materials/base/parallel.hpp"
#include "render/path/direction_angles.hpp"
#include "render/rays/directional_light.hpp"
#include "render/rays/hop_tables.hpp"
#include "render/rays/lobe.hpp"
#include "render/rays/rough_mirror.hpp"

namespace diurna {

namespace {

/// Sums the light of one pixel after another; its memory, rows of lanes, is kept between them.
class PixelSum {
 public:
    PixelSum(const HopTables& tables, const RoughMirrors& rough, bool by_term)
        : tables_(tables),
          rough_(rough),
          lanes_(tables.lanes.size()),
          bands_(tables.band.size()),
          by_term_(by_term),
          filter_(origin_count * lanes_),
          own_(sent_rows.size() * lanes_),
          background_(lanes_),
          share_(lanes_) {}

    /// Adds the k-th pixel of the hops to its place in the planes.
    void add(std::size_t k, std::span<std::vector<float>> planes) {
        list_ = tables_.hops.of(k);
        first_ = tables_.hops.row[k];
        passed_.resize(list_.size() * lanes_);
        transmittance_.resize(list_.size() * origin_count * lanes_);
        radiance_.resize(list_.size() * lanes_);
        scattered_.assign(list_.size() * bands_, 0.0f);
        as_.assign(list_.size(), Term::path);
        lobe_.resize(list_.size() * RoughMirrors::row_count * lanes_);
        sum_.assign((by_term_ ? term_count : 1) * lanes_, 0.0);
        for (std::size_t i = 0; i < list_.size(); ++i) add_hop(i);
        const std::size_t rows = planes.size() / bands_;
        for (std::size_t p = 0; p < planes.size(); ++p) {
            const double* lane = &sum_[p % rows * lanes_];
            const auto& first = tables_.lanes.first;
            double sum = 0.0;
            for (std::size_t c = first[p / rows]; c < first[p / rows + 1]; ++c) sum += lane[c];
            planes[p][tables_.hops.pixel[k]] += static_cast<float>(sum);
        }
    }

 private:
    bool starts(const Hop& hop) const { return hop.before < 0; }
    std::size_t before(const Hop& hop) const { return static_cast<std::size_t>(hop.before); }
    float height_km(const Hop& hop) const {
        return static_cast<float>(tables_.input.above_sea_km(double{hop.height}));
    }
    const float* transmittance_to(std::size_t i, Origin origin) const {
        return &transmittance_[(i * origin_count + static_cast<std::size_t>(origin)) * lanes_];
    }
    /// Where light of a hop that is a term of its own is summed.
    double* row(std::size_t i, Term own) {
        const Term t = as_[i] == Term::path ? own : as_[i];
        return &sum_[by_term_ ? static_cast<std::size_t>(t) * lanes_ : 0];
    }

    void add_hop(std::size_t i) {
        const Hop& hop = list_[i];
        pass(i);
        // A mirror's own way is left dark.
        for (std::size_t b = 0; hop.straight && b < bands_; ++b) {
            if (tables_.scattered_path[b]) add_scattered_path(i, b);
        }
        add_air(i);
        if (hop.way == Hop::Way::mirrored && rough_.has(list_[before(hop)])) take_expected(i);
        if (hop.kind == Hop::Kind::sky) return;
        const float* passed = &passed_[i * lanes_];
        for (std::size_t o = 0; o < origin_count; ++o) {
            const float* transmittance = transmittance_to(i, static_cast<Origin>(o));
            float* filter = &filter_[o * lanes_];
            for (std::size_t c = 0; c < lanes_; ++c) {
                filter[c] = hop.weight * passed[c] * transmittance[c];
            }
        }
        if (hop.kind == Hop::Kind::plume) {
            add_plume(i);
        } else {
            add_facet(i);
            if (rough_.has(hop)) add_lobe(i);
        }
    }

    float* lobe(std::size_t i, RoughMirrors::Row row) {
        return &lobe_[(i * RoughMirrors::row_count + row) * lanes_];
    }

    /// What a rough mirror shows of the background and, by their mean, of the facets around.
    void add_lobe(std::size_t i) {
        const Hop& hop = list_[i];
        rough_.look(hop, lobe(i, RoughMirrors::reflected));
        const float* all = lobe(i, RoughMirrors::reflected);
        const MaterialId material = tables_.input.facets.material[hop.what];
        const AngleTable::Place at = tables_.angle[index(material)].at(double{hop.cosine});
        const float* passed = &passed_[i * lanes_];
        for (std::size_t c = 0; c < lanes_; ++c) {
            share_[c] = hop.weight * passed[c] * at.mirrored(c) / std::max(all[c], 1e-30f);
        }
        const float open = open_above(i);
        const float* near = lobe(i, RoughMirrors::around);
        whole_ = share_;
        for (std::size_t c = 0; c < lanes_; ++c) share_[c] *= open;
        add_background(i, lobe(i, RoughMirrors::sky));
        for (std::size_t c = 0; c < lanes_; ++c) {
            share_[c] = whole_[c] * (near[c] + (1.0f - open) * (all[c] - near[c]));
        }
        add_around(i);
    }

    float open_above(std::size_t mirror) const {
        const std::uint32_t target = tables_.target[first_ + mirror];
        return open_sky(tables_.lit.sky_view[tables_.lit_index(target)],
                        rough_.normal(list_[mirror]));
    }

    /// Takes away what the sum over the lobe has for what a ray off a rough mirror meets.
    void take_expected(std::size_t i) {
        const Hop& hop = list_[i];
        const std::size_t mirror = before(hop);
        const float* passed = &passed_[i * lanes_];
        for (std::size_t c = 0; c < lanes_; ++c) share_[c] = -hop.weight * passed[c];
        const Eigen::Vector3d direction = hop.direction.cast<double>();
        if (rough_.around_towards(list_[mirror], direction)) {
            add_around(mirror);
            return;
        }
        const float open = open_above(mirror);
        whole_ = share_;
        for (std::size_t c = 0; c < lanes_; ++c) share_[c] *= open;
        tables_.mirrored_background(direction, list_[mirror].range, background_);
        add_background(mirror, background_.data());
        for (std::size_t c = 0; c < lanes_; ++c) share_[c] = (1.0f - open) * whole_[c];
        if (open < 1.0f) add_around(mirror);
    }

    /// Radiance of the background (lane) at a mirror, by the shares of it.
    void add_background(std::size_t mirror, const float* light) {
        const float* dimmed = transmittance_to(mirror, Origin::surface);
        double* sum = row(mirror, Term::sky);
        for (std::size_t c = 0; c < lanes_; ++c) {
            sum[c] += double{share_[c] * dimmed[c] * light[c]};
        }
    }

    /// The mean of what arrives at a mirror from the facets around, by the shares of it.
    void add_around(std::size_t mirror) {
        const std::uint32_t target = tables_.target[first_ + mirror];
        const float seen = 1.0f - tables_.lit.sky_view[tables_.lit_index(target)];
        if (!(seen > 0.0f)) return;
        double* sum = row(mirror, Term::surroundings);
        for (const Origin origin : all_origins) {
            const float* dimmed = transmittance_to(mirror, origin);
            const float* light = tables_.facet_lanes.from_surroundings(target, origin);
            for (std::size_t c = 0; c < lanes_; ++c) {
                sum[c] += double{share_[c] * dimmed[c] * light[c] / seen};
            }
        }
    }

    /// What light is left of, past the hops before, and what it counts as.
    void pass(std::size_t i) {
        const Hop& hop = list_[i];
        const std::size_t n = lanes_;
        float* passed = &passed_[i * n];
        if (starts(hop)) {
            std::fill_n(passed, n, 1.0f);
            return;
        }
        const Hop& last = list_[before(hop)];
        const float* earlier = &passed_[before(hop) * n];
        if (last.kind == Hop::Kind::plume) {
            const float* k = tables_.absorption[last.what].data();
            for (std::size_t c = 0; c < n; ++c) {
                passed[c] = earlier[c] * fast_exp(-k[c] * last.chord);
            }
        } else {
            const MaterialId material = tables_.input.facets.material[last.what];
            const AngleTable::Place at = tables_.angle[index(material)].at(double{last.cosine});
            if (hop.way == Hop::Way::mirrored && rough_.has(last)) {
                // Of the lobe's rays, the share that the sum over the lobe gives this one.
                const AngleTable::Place here = tables_.angle[index(material)].at(
                    facing_between(-last.direction.cast<double>(), hop.direction.cast<double>()));
                const float* all = lobe(before(hop), RoughMirrors::reflected);
                for (std::size_t c = 0; c < n; ++c) {
                    passed[c] =
                        earlier[c] * at.mirrored(c) * here.facing(c) / std::max(all[c], 1e-30f);
                }
            } else if (hop.way == Hop::Way::mirrored) {
                for (std::size_t c = 0; c < n; ++c) passed[c] = earlier[c] * at.mirrored(c);
            } else {
                for (std::size_t c = 0; c < n; ++c) passed[c] = earlier[c] * at.transmittance(c);
            }
        }
        Term& as = as_[i];
        as = as_[before(hop)] != Term::path  ? as_[before(hop)]
             : hop.way == Hop::Way::mirrored ? Term::surroundings
                                             : Term::behind;
        if (as == Term::surroundings && hop.kind == Hop::Kind::sky) as = Term::sky;
    }

    /// Sunlight that the air scatters into the line of sight since the hop before.
    void add_scattered_path(std::size_t i, std::size_t b) {
        const Hop& hop = list_[i];
        const ScatteredPath& table = *tables_.scattered_path[b];
        const float *passed = &passed_[i * lanes_], *sun = tables_.sun[1].data();
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
            here = table(table.towards(from_sun, double{hop.direction.z()}), hop.range,
                         height_km(hop));
        }
        const float nearer = starts(hop) ? 0.0f : scattered_[before(hop) * bands_ + b];
        row(i, Term::path)[first[b]] += double{hop.weight} *
                                        double{passed_sun / std::max(all_sun, 1e-30f)} *
                                        double{here - nearer};
    }

    /// What the air up to here sends, or the sky, but for what is sent up to the hop before.
    void add_air(std::size_t i) {
        const Hop& hop = list_[i];
        const std::size_t n = lanes_;
        float* radiance = &radiance_[i * n];
        const float* nearer = starts(hop) ? nullptr : &radiance_[before(hop) * n];
        if (hop.kind != Hop::Kind::sky) {
            tables_.air.to(hop.range, height_km(hop), &transmittance_[i * origin_count * n],
                           radiance);
        } else if (hop.straight) {
            tables_.background_towards(hop.direction.cast<double>(), {radiance, n});
        } else {
            tables_.mirrored_background(hop.direction.cast<double>(), list_[before(hop)].range,
                                        {radiance, n});
            const float* dimmed = transmittance_to(before(hop), Origin::surface);
            for (std::size_t c = 0; c < n; ++c) radiance[c] *= dimmed[c];
            nearer = nullptr;
        }
        const float* passed = &passed_[i * n];
        double* path = row(i, Term::path);
        for (std::size_t c = 0; c < n; ++c) {
            const float since = nearer ? radiance[c] - nearer[c] : radiance[c];
            path[c] += double{hop.weight * passed[c] * since};
        }
    }

    /// Light of a hop itself, (lane), through what is before it.
    void add_own(std::size_t i, const SentRow& own, const float* light) {
        const float* filter = &filter_[static_cast<std::size_t>(own.origin) * lanes_];
        double* sum = row(i, own.term);
        for (std::size_t c = 0; c < lanes_; ++c) sum[c] += double{filter[c] * light[c]};
    }

    void add_plume(std::size_t i) {
        const Hop& hop = list_[i];
        const float* absorbing = tables_.absorption[hop.what].data();
        const float* glows = tables_.glow[hop.what].data();
        for (std::size_t c = 0; c < lanes_; ++c) {
            own_[c] = -std::expm1(-absorbing[c] * hop.chord) * glows[c];
        }
        add_own(i, {Term::emitted, Origin::surface}, own_.data());
    }

    void add_facet(std::size_t i) {
        const Hop& hop = list_[i];
        const std::uint32_t target = tables_.target[first_ + i];
        const FacetLanes& lanes = tables_.facet_lanes;
        if (!hop.closed && tables_.material(hop).needs_rays()) {
            directional_light(tables_, hop, target, own_.data());
            for (std::size_t k = 0; k < sent_rows.size(); ++k) {
                add_own(i, sent_rows[k], &own_[k * lanes_]);
            }
        } else if (!by_term_ || as_[i] != Term::path) {
            for (const Origin origin : all_origins) {
                add_own(i, {Term::emitted, origin}, lanes.radiosity(target, origin));
            }
        } else {
            for (std::size_t k = 0; k < sent_rows.size(); ++k) {
                add_own(i, sent_rows[k], lanes.sent(target, k));
            }
        }
    }

    const HopTables& tables_;
    const RoughMirrors& rough_;
    std::size_t lanes_, bands_;
    bool by_term_;
    std::span<const Hop> list_;                      // of the pixel
    std::size_t first_ = 0;                          // hop of the list among all
    std::vector<float> passed_, radiance_;           // (hop, lane)
    std::vector<float> scattered_;                   // (hop, band)
    std::vector<Term> as_;                           // (hop) what its light counts as
    std::vector<float> transmittance_;               // (hop, origin, lane)
    std::vector<float> filter_;                      // (origin, lane)
    std::vector<float> own_;                         // (sent row, lane)
    std::vector<float> lobe_;                        // (hop, RoughMirrors::Row, lane)
    std::vector<float> background_, share_, whole_;  // (lane)
    std::vector<double> sum_;                        // (row, lane): terms, or one for all
};

}  // namespace

/// Light of the hops' facets alone.
struct OwnLight {
    LitFacets lit;
    SceneLight light;
    OwnLight(const Hops& hops, std::span<const Band> bands, const RadianceInput& input,
             const HopOptions& options)
        : lit(lit_facets(input, facets_of(hops), bands)),
          light(input, lit, bands, options.bounces, options.tolerance) {}
};

struct HopLight::State {
    std::unique_ptr<OwnLight> own;  // null: that of a whole picture
    HopTables tables;
    RoughMirrors rough{tables};
};

HopLight::HopLight(const Hops& hops, std::span<const Plume> plumes, std::span<const Band> bands,
                   const RadianceInput& input, const HopOptions& options) {
    auto own = std::make_unique<OwnLight>(hops, bands, input, options);
    const SceneLight& light = own->light;
    state_.reset(new State{std::move(own), {hops, plumes, light, 0, options}});
}

HopLight::HopLight(const Hops& hops, std::span<const Plume> plumes, const SceneLight& light,
                   std::size_t first, const HopOptions& options)
    : state_(new State{nullptr, {hops, plumes, light, first, options}}) {}

HopLight::~HopLight() = default;

void HopLight::add(std::span<std::vector<float>> planes) const {
    const HopTables& tables = state_->tables;
    const bool by_term = planes.size() > tables.band.size();
    assert(!by_term || tables.options.by_term);
    for_each_block(tables.hops.pixel.size(), 64, [&](std::size_t begin, std::size_t end) {
        PixelSum sum(tables, state_->rough, by_term);
        for (std::size_t k = begin; k < end; ++k) sum.add(k, planes);
    });
}

}  // namespace diurna
