#include "render/view/pixel_sun.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "materials/base/parallel.hpp"
#include "materials/base/random.hpp"
#include "render/view/pixel_samples.hpp"
#include "terrain/visibility/lifted_facet.hpp"
#include "terrain/visibility/sun_disc.hpp"

namespace diurna {

namespace {

constexpr std::size_t sun_lanes = RayBundles::lanes;
constexpr double golden = 0.6180339887498949;  // its multiples fill an interval evenly
constexpr float all_or_nothing = 0.02f;        // shares that near to 0 or 1 count as these

/// The facet on which a surface lies.
struct InPlace {
    const TextureLevels* levels;
    std::size_t operator()(SurfaceId surface) const {
        return levels == nullptr ? index(surface) : index(levels->facet_of(surface));
    }
};

/// Pixels that see facets with edges, and their sightings of these.
PixelSun entries_of(const View& view, std::span<const std::uint8_t> crossed, InPlace in_place) {
    PixelSun out;
    out.row.push_back(0);
    if (std::find(crossed.begin(), crossed.end(), 1) == crossed.end()) return out;
    std::vector<std::uint8_t> target(view.surface.size());
    for (std::size_t t = 0; t < target.size(); ++t) target[t] = crossed[in_place(view.surface[t])];
    for (std::size_t p = 0; p < view.pixels(); ++p) {
        for (std::uint32_t k = view.row[p]; k < view.row[p + 1]; ++k) {
            if (target[view.sighting[k].target] != 0) out.sighting.push_back(k);
        }
        if (out.sighting.size() == out.row.back()) continue;
        out.pixel.push_back(static_cast<std::uint32_t>(p));
        out.row.push_back(static_cast<std::uint32_t>(out.sighting.size()));
    }
    return out;
}

/// The pixels of a view whose sun is found.
struct SunCast {
    const View& view;
    const SunOverFacets& sun;
    const Observer& observer;
    std::span<const std::uint8_t> crossed;  // facets_with_edges()
};

/// Which samples cast a ray to the sun, and to which sun.
struct Asked {
    bool every = false;  // though the first ones are alike
    bool past = false;   // SunOverFacets::past
    int before = 0;      // samples of the pixel that were asked earlier
};

/// Casts the samples of a few pixels at a time and asks for the sun at what they meet. For one
/// thread.
class SampleCaster {
 public:
    SampleCaster(const SunCast& cast, const PixelSamples& samples, const ViewOptions& options,
                 Asked asked, PixelSun& out, std::span<std::uint8_t> mixed)
        : view_(cast.view),
          sun_(cast.sun),
          disc_(cast.sun.to_sun),
          samples_(samples),
          seed_(options.seed),
          in_place_{options.texture_levels},
          crossed_(cast.crossed),
          out_(out),
          mixed_(mixed),
          past_(asked.past ? cast.sun.past : nullptr),
          before_(asked.before),
          at_a_time_(std::max<std::size_t>(1, 16 / samples.bundles())),
          rays_(cast.sun.rays, at_a_time_ * samples.bundles()) {
        rays_.set_origin(samples.origin());
        // One in each row of cells and in each column: rooks a knight's move apart.
        const auto [columns, rows] = nearly_square(options.samples);
        is_first_.assign(std::size_t(options.samples), asked.every || options.samples < 8);
        for (int r = 0; r < rows; ++r) {
            const int column = std::min((2 * r + 1) % (columns + 1), columns - 1);
            is_first_[std::size_t(r * columns + column)] = true;
        }
        firsts_ = static_cast<int>(std::count(is_first_.begin(), is_first_.end(), true));
    }

    /// Pixels [begin, end) of `out`; returns how many rays went to the sun.
    std::size_t cast(std::size_t begin, std::size_t end) {
        std::size_t cast = 0;
        for (std::size_t k = begin; k < end; k += at_a_time_) {
            const std::size_t last = std::min(end, k + at_a_time_);
            first_pixel_ = k;
            seen_.assign(out_.row[last] - out_.row[k], {});
            aim(k, last);
            cast += ask(k, last, true, [](std::size_t) { return true; });
            cast += ask(k, last, false, [&](std::size_t i) { return !alike(i); });
            average(k, last);
            for (std::size_t i = k; i < last; ++i) mixed_[i] = !alike(i);
        }
        return cast;
    }

 private:
    std::size_t pixel_of(std::size_t k) const { return out_.pixel[k]; }

    void aim(std::size_t begin, std::size_t end) {
        const auto width = static_cast<std::size_t>(view_.width);
        std::size_t bundle = 0;
        for (std::size_t k = begin; k < end; ++k) {
            for (std::size_t part = 0; part < samples_.bundles(); ++part) {
                samples_.aim(pixel_of(k) % width, pixel_of(k) / width, part, bundle++, rays_);
            }
        }
        rays_.closest(bundle);
    }

    /// Asks for the sun at the first samples of those pixels [begin, end) that want it, or at the
    /// others; returns how many rays went there.
    template <class Wanted>
    std::size_t ask(std::size_t begin, std::size_t end, bool first, const Wanted& wanted) {
        to_sun_.clear();
        entry_.clear();
        for (std::size_t k = begin; k < end; ++k) {
            if (wanted(k)) start_from(k, (k - begin) * samples_.bundles(), first);
        }
        share_.resize(to_sun_.size());
        sun_.rays.beam(to_sun_, share_);
        for (std::size_t i = 0; i < share_.size(); ++i) {
            seen_of(entry_[i]).add(share_[i]);
        }
        return to_sun_.size();
    }

    /// Whether the first samples of the k-th pixel have much the same of the sun.
    bool alike(std::size_t k) const {
        Seen all;
        for (std::uint32_t e = out_.row[k]; e < out_.row[k + 1]; ++e) {
            all.add(seen_[e - out_.row[first_pixel_]]);
        }
        return 2 * all.count >= firsts_ && all.most - all.least < all_or_nothing;
    }

    /// Rays to the sun from what the first samples of the k-th pixel meet, or the others.
    void start_from(std::size_t k, std::size_t first_bundle, bool first) {
        met_.reset();
        RandomStream random{hashed(seed_ ^ hashed(pixel_of(k)))};
        const double start_x = random(), start_y = random();
        int sample = 0;
        for (std::size_t part = 0; part < samples_.bundles(); ++part) {
            for (std::size_t s = 0; s < samples_.used(part); ++s, ++sample) {
                const std::size_t ray = (first_bundle + part) * sun_lanes + s;
                if (is_first_[std::size_t(sample)] != first) continue;
                const Copies::Place met = view_.copies.at(rays_.facet[ray]);
                if (met.facet == index(no_facet) || crossed_[met.facet] == 0) continue;
                const Eigen::Vector2d at = evenly(sample, {start_x, start_y});
                add_rays(k, ray, met, sample, at);
            }
        }
    }

    /// Past suns of a sample: the same instants in every pixel, so that neighbours do not differ by
    /// chance; more of them where a facet fills little of the pixel and few samples meet it.
    void add_past(std::uint8_t course, int sample, float weight) {
        constexpr float least_suns = 6.0f;
        const float samples = std::max(1.0f, weight * float(is_first_.size()));
        const int suns = static_cast<int>(std::ceil(least_suns / samples));
        for (int i = 0; i < suns; ++i) {
            double whole;
            const double place = golden * (sample + before_ + 0.5) + double(i) / suns;
            towards_.push_back(past_->towards(course, std::modf(place, &whole)));
        }
    }

    /// Finds what belongs to a facet that samples of the k-th pixel meet, one after the other.
    void meet(std::size_t k, const Copies::Place& met) {
        std::uint32_t entry = out_.row[k];
        while (entry < out_.row[k + 1] &&
               !(place_of(entry) == met.facet && copy_of(entry) == met.copy)) {
            ++entry;
        }
        met_ = Met{met, entry,
                   met.copy == no_copy
                       ? LiftedFacet(sun_.facets, met.facet)
                       : LiftedFacet(sun_.facets, met.facet, view_.copies[met.copy].pose)};
    }

    void add_rays(std::size_t k, std::size_t ray, const Copies::Place& met, int sample,
                  const Eigen::Vector2d& at) {
        if (!met_ || met_->place.facet != met.facet || met_->place.copy != met.copy) meet(k, met);
        const std::uint32_t entry = met_->entry;
        if (entry == out_.row[k + 1]) return;
        towards_.clear();
        const std::uint8_t course = past_ ? past_->of_facet[met.facet] : PastSun::at_once;
        if (course == PastSun::at_once) {
            towards_.push_back(disc_.towards(at.x(), at.y()));
        } else {
            add_past(course, sample, view_.sighting[out_.sighting[entry]].weight);
        }
        LiftedFacet lifted = met_->lifted;
        if (met.copy == no_copy) lifted.corner += sun_.rays.gone(met.facet, rays_.time[ray]);
        const Eigen::Vector3f from = place(ray, lifted);
        for (const Eigen::Vector3d& towards : towards_) {
            // Where the sun is below the facet's own plane it does not shine.
            if (lifted.normal.dot(towards) <= 0.0) {
                seen_of(entry).add(0.0f);
                continue;
            }
            to_sun_.push_back(
                {.origin = from, .direction = towards.cast<float>(), .time = rays_.time[ray]});
            entry_.push_back(entry);
        }
    }

    /// Where a ray of the picture meets the facet's plane, lifted off it.
    Eigen::Vector3f place(std::size_t ray, const LiftedFacet& lifted) const {
        const Eigen::Vector3d from(rays_.origin_x[ray], rays_.origin_y[ray], rays_.origin_z[ray]);
        const Eigen::Vector3d to(rays_.direction_x[ray], rays_.direction_y[ray],
                                 rays_.direction_z[ray]);
        const double descent = lifted.normal.dot(to);
        const double beside = lifted.normal.dot(lifted.corner - from);
        double range = rays_.range[ray];  // at grazing incidence that of a double
        if (std::abs(descent) > 0.05) range = beside / descent;
        const Eigen::Vector3d at = from + range * to;
        return (at + lifted.normal * (lifted.normal.dot(lifted.corner - at))).cast<float>();
    }

    /// Shares of the entries of pixels [begin, end): of levels in one place the first has the
    /// samples of all. Where no sample met the facet, it has what the pixel's others have if these
    /// are alike, else the facet's mean.
    void average(std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            Seen all;
            for (std::uint32_t e = out_.row[k]; e < out_.row[k + 1]; ++e) all.add(seen_of(e));
            const bool as_others = all.count > 0 && all.most - all.least < all_or_nothing;
            for (std::uint32_t e = out_.row[k]; e < out_.row[k + 1]; ++e) {
                std::uint32_t first = out_.row[k];
                while (place_of(first) != place_of(e) || copy_of(first) != copy_of(e)) ++first;
                const Seen& here = seen_of(first);
                out_.share[e] = here.count > 0 ? here.mean()
                                : as_others    ? all.mean()
                                : past_        ? past_->share[place_of(e)]
                                               : sun_.fraction[place_of(e)];
            }
        }
    }

    /// What samples found.
    struct Seen {
        int count = 0;
        float sum = 0.0f, least = 1.0f, most = 0.0f;
        void add(const Seen& more) {
            count += more.count;
            sum += more.sum;
            least = std::min(least, more.least);
            most = std::max(most, more.most);
        }
        void add(float share) { add({1, share, share, share}); }
        float mean() const { return sum / static_cast<float>(count); }
    };
    Seen& seen_of(std::uint32_t entry) { return seen_[entry - out_.row[first_pixel_]]; }

    /// Of an entry.
    std::size_t place_of(std::uint32_t entry) const {
        return in_place_(view_.surface[view_.sighting[out_.sighting[entry]].target]);
    }
    std::uint32_t copy_of(std::uint32_t entry) const {
        return view_.copy_of(view_.sighting[out_.sighting[entry]].target);
    }

    const View& view_;
    const SunOverFacets& sun_;
    SunDisc disc_;
    const PixelSamples& samples_;
    std::uint64_t seed_;
    InPlace in_place_;
    std::span<const std::uint8_t> crossed_;
    PixelSun& out_;
    std::span<std::uint8_t> mixed_;  // (pixel of out) written: its samples differ
    const PastSun* past_;
    int before_;             // samples
    std::size_t at_a_time_;  // pixels
    RayBundles rays_;
    struct Met {
        Copies::Place place;
        std::uint32_t entry;  // of `out`; the next pixel's first: none
        LiftedFacet lifted;
    };
    std::optional<Met> met_{};  // by the sample before
    std::size_t first_pixel_ = 0;
    std::vector<Eigen::Vector3d> towards_;  // of one sample
    std::vector<Ray> to_sun_;
    std::vector<std::uint32_t> entry_;  // (ray to the sun)
    std::vector<float> share_;          // (ray to the sun)
    std::vector<Seen> seen_;            // (entry of these pixels)
    std::vector<bool> is_first_;        // (sample)
    int firsts_ = 0;                    // samples
};

/// Finds all shares of `out`; returns (pixel of out) 1 where samples differ.
///
std::vector<std::uint8_t> cast_all(const SunCast& of, const ViewOptions& options, Asked asked,
                                   PixelSun& out) {
    std::vector<std::uint8_t> mixed(out.pixel.size(), 0);
    out.share.resize(out.sighting.size());
    const PixelSamples samples(of.observer, options.samples, options.seed);
    constexpr std::size_t grain = 256;
    std::vector<std::size_t> rays((out.pixel.size() + grain - 1) / grain);
    for_each_block(out.pixel.size(), grain, [&](std::size_t begin, std::size_t end) {
        SampleCaster caster(of, samples, options, asked, out, mixed);
        rays[begin / grain] = caster.cast(begin, end);
    });
    out.rays += std::accumulate(rays.begin(), rays.end(), std::uint64_t{0});
    return mixed;
}

/// Those entries of `from` that are wanted, and their numbers there.
template <class Wanted>
PixelSun some_entries(const PixelSun& from, const Wanted& wanted,
                      std::vector<std::uint32_t>& entry) {
    PixelSun some;
    some.row.push_back(0);
    for (std::size_t k = 0; k < from.pixel.size(); ++k) {
        for (std::uint32_t e = from.row[k]; e < from.row[k + 1]; ++e) {
            if (!wanted(k, e)) continue;
            some.sighting.push_back(from.sighting[e]);
            entry.push_back(e);
        }
        if (some.sighting.size() == some.row.back()) continue;
        some.pixel.push_back(from.pixel[k]);
        some.row.push_back(static_cast<std::uint32_t>(some.sighting.size()));
    }
    return some;
}

constexpr int least_refined = 4;

/// Takes `times` as many samples more in pixels that an edge goes through: sixteen leave 0.04 of
/// what sun and shade differ by.
void refine(const SunCast& of, const ViewOptions& options, std::span<const std::uint8_t> mixed,
            int times, Asked asked, PixelSun& out) {
    std::vector<std::uint32_t> entry;  // (entry of finer) that of out
    PixelSun finer = some_entries(
        out, [&](std::size_t k, std::uint32_t) { return mixed[k] != 0; }, entry);
    ViewOptions more = options;
    more.samples = times * options.samples;
    more.seed = options.seed + golden_step;
    cast_all(of, more, {.every = true, .past = asked.past, .before = options.samples}, finer);
    const float share = float(times) / float(1 + times);
    for (std::size_t i = 0; i < entry.size(); ++i) {
        float& whole = out.share[entry[i]];
        whole += share * (finer.share[i] - whole);
    }
    out.rays += finer.rays;
}

/// Shares over the hours before, of facets that remember them; of the others the present ones.
void cast_past(const SunCast& of, ViewOptions options, PixelSun& out) {
    constexpr int least_samples = 16;  // each has one past sun
    options.samples = std::max(options.samples, least_samples);
    const InPlace in_place{options.texture_levels};
    std::vector<std::uint32_t> entry;
    PixelSun past = some_entries(
        out,
        [&](std::size_t, std::uint32_t e) {
            const SurfaceId surface = of.view.surface[of.view.sighting[out.sighting[e]].target];
            return of.sun.past->of_facet[in_place(surface)] != PastSun::at_once;
        },
        entry);
    constexpr Asked asked{.every = true, .past = true};
    const std::vector<std::uint8_t> mixed = cast_all(of, options, asked, past);
    refine(of, options, mixed, 1, asked, past);
    out.past_share = out.share;
    for (std::size_t i = 0; i < entry.size(); ++i) out.past_share[entry[i]] = past.share[i];
    out.rays += past.rays;
}

}  // namespace

std::vector<std::uint8_t> facets_with_edges(const SunOverFacets& sun, const TextureLevels* levels) {
    const FacetSet& facets = sun.facets;
    const std::size_t known = levels == nullptr || levels->empty() ? facets.size() : levels->solid;
    std::vector<std::uint8_t> crossed(known, 0);
    if (sun.fraction.empty()) return crossed;
    const Eigen::Vector3f to_sun = sun.to_sun.cast<float>();
    std::vector<float> least(facets.vertex.size(), 1.0f), most(facets.vertex.size(), 0.0f);
    std::vector<std::span<const float>> moments = sun.also;
    std::erase_if(moments, [](const auto& fraction) { return fraction.empty(); });
    for (std::size_t f = 0; f < known; ++f) {
        if (facets.normal[f].dot(to_sun) <= 0.0f) continue;
        float low = sun.fraction[f], high = low;
        for (const std::span<const float> fraction : moments) {
            low = std::min(low, fraction[f]);
            high = std::max(high, fraction[f]);
        }
        for (const std::uint32_t v : facets.corner[f]) {
            least[v] = std::min(least[v], low);
            most[v] = std::max(most[v], high);
        }
    }
    for (std::size_t f = 0; f < known; ++f) {
        if (facets.normal[f].dot(to_sun) <= 0.0f) continue;
        const auto& [a, b, c] = facets.corner[f];
        crossed[f] = std::max({most[a], most[b], most[c]}) > all_or_nothing &&
                     std::min({least[a], least[b], least[c]}) < 1.0f - all_or_nothing;
    }
    return crossed;
}

PixelSun cast_pixel_sun(const View& view, const SunOverFacets& sun, const Observer& observer,
                        const ViewOptions& options) {
    std::vector<std::uint8_t> crossed = facets_with_edges(sun, options.texture_levels);
    PixelSun out = entries_of(view, crossed, {options.texture_levels});
    const SunCast of{view, sun, observer, crossed};
    const std::vector<std::uint8_t> mixed = cast_all(of, options, {}, out);
    if (options.samples >= least_refined) refine(of, options, mixed, 3, {}, out);
    if (sun.past) cast_past(of, options, out);
    out.crossed = std::move(crossed);
    return out;
}

}  // namespace diurna
