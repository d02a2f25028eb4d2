#include "render/rays/secondary_planes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <numeric>
#include <string>
#include <vector>

#include "materials/base/parallel.hpp"
#include "render/rays/secondary_sum.hpp"

namespace diurna {

namespace {

constexpr std::array of_surface = {"weight",       "facet",      "material", "temperature",
                                   "sun_fraction", "cosine_sun", "sky_view"};
constexpr std::array of_secondary = {"way", "before", "cosine"};
constexpr std::array secondary_planes_of_band = {"black",
                                                 "emissivity",
                                                 "transmittance",
                                                 "sunlight",
                                                 "reflectance_sun",
                                                 "transmittance_sun",
                                                 "skylight",
                                                 "reflectance_sky",
                                                 "transmittance_sky",
                                                 "surroundings",
                                                 "reflectance_surroundings",
                                                 "transmittance_surroundings",
                                                 "behind"};
struct NewPlane {
    const char *name, *unit;
};
constexpr std::array<NewPlane, 4> of_secondary_and_band = {
    {{"mirror", "1"}, {"passed", "1"}, {"mirrored", "W m-2 sr-1"}, {"air", "W m-2 sr-1"}}};
constexpr std::size_t in_band = secondary_planes_of_band.size() + of_secondary_and_band.size();
/// Terms that are light × a factor × what lets it pass, in the order of the planes above.
constexpr std::array parts_of_light = {Term::emitted, Term::sun, Term::sky, Term::surroundings};

/// Where the values of the k-th surface go, (pixel) each.
struct SurfacePlanes {
    std::array<float*, of_surface.size()> surface;
    std::array<float*, of_secondary.size()> secondary;
    std::vector<std::array<float*, in_band>> band;  // (band)
};

float* pixels_of(const std::string& name, Frame& frame) {
    const auto found = std::find_if(frame.planes.begin(), frame.planes.end(),
                                    [&](const Plane& plane) { return plane.name == name; });
    assert(found != frame.planes.end());
    return found->pixel.data();
}

/// Planes that only pictures with secondary rays have.
void add_empty_planes(const SecondaryTables& tables, std::size_t surfaces, Frame& frame) {
    const std::vector<float> none(frame.pixels(), 0.0f);
    for (std::size_t k = 1; k <= surfaces; ++k) {
        for (const char* name : of_secondary) {
            frame.planes.push_back({fmt::format("{}_{}", name, k), "1", none});
        }
        float* way = frame.planes[frame.planes.size() - of_secondary.size()].pixel.data();
        const float* weight = pixels_of(fmt::format("weight_{}", k), frame);
        for (std::size_t p = 0; p < none.size(); ++p) way[p] = weight[p] > 0.0f ? 0.0f : -1.0f;
        for (const BandLight& band : tables.band) {
            for (const NewPlane& plane : of_secondary_and_band) {
                frame.planes.push_back(
                    {fmt::format("{}_{}.{}", plane.name, k, band.band.name), plane.unit, none});
            }
        }
    }
    for (const BandLight& band : tables.band) {
        frame.planes.push_back({fmt::format("rest.{}", band.band.name), "W m-2 sr-1", none});
    }
}

std::vector<SurfacePlanes> planes_of(const SecondaryTables& tables, std::size_t surfaces,
                                     Frame& frame) {
    std::vector<SurfacePlanes> planes(surfaces);
    for (std::size_t k = 0; k < surfaces; ++k) {
        const auto named = [&](const char* name) { return fmt::format("{}_{}", name, k + 1); };
        for (std::size_t i = 0; i < of_surface.size(); ++i) {
            planes[k].surface[i] = pixels_of(named(of_surface[i]), frame);
        }
        for (std::size_t i = 0; i < of_secondary.size(); ++i) {
            planes[k].secondary[i] = pixels_of(named(of_secondary[i]), frame);
        }
        for (const BandLight& band : tables.band) {
            auto& to = planes[k].band.emplace_back();
            const std::string suffix = "." + band.band.name;
            for (std::size_t i = 0; i < in_band; ++i) {
                const char* name =
                    i < secondary_planes_of_band.size()
                        ? secondary_planes_of_band[i]
                        : of_secondary_and_band[i - secondary_planes_of_band.size()].name;
                to[i] = pixels_of(named(name) + suffix, frame);
            }
        }
    }
    return planes;
}

float ratio_or_zero(double of, double to) { return to != 0.0 ? static_cast<float>(of / to) : 0.0f; }

/// What the secondary rays of one pixel after another contribute.
class SecondaryValues {
 public:
    SecondaryValues(const SecondaryTables& tables, const RoughMirrors& rough)
        : tables_(tables),
          sum_(tables, rough, SumOfSecondaryRays::by_secondary),
          light_(tables.lanes.size()) {}

    std::span<const SecondaryRay> list() const { return sum_.rows().list; }

    void look(std::size_t k) {
        sum_.look(k);
        const std::span<const SecondaryRay> list = sum_.rows().list;
        const std::size_t bands = tables_.band.size();
        passed_.resize(list.size() * bands);
        worth_.resize(list.size());
        for (std::size_t i = 0; i < list.size(); ++i) {
            weigh(i);
            worth_[i] = 0.0f;
            for (std::size_t b = 0; b < bands; ++b) {
                const float passed = mean(b, sum_.rows().passed_to(i));
                passed_[i * bands + b] = passed;
                worth_[i] = std::max(worth_[i], list[i].weight * passed);
            }
        }
    }

    /// The secondary rays that count most, none before the one it is seen past; sky that is seen
    /// straight is path.
    std::vector<std::uint32_t> most(std::size_t surfaces) {
        const std::span<const SecondaryRay> list = sum_.rows().list;
        std::vector<std::uint32_t> order;
        for (std::size_t i = list.size(); i-- > 0;) {
            if (SecondaryRows::starts(list[i])) continue;
            float& before = worth_[SecondaryRows::before(list[i])];
            before = std::max(before, worth_[i]);
        }
        for (std::uint32_t i = 0; i < list.size(); ++i) {
            if (!is_path(list[i])) order.push_back(i);
        }
        std::stable_sort(order.begin(), order.end(),
                         [&](auto a, auto b) { return worth_[a] > worth_[b]; });
        order.resize(std::min(order.size(), surfaces));
        return order;
    }
    static bool is_path(const SecondaryRay& secondary) {
        return SecondaryRows::starts(secondary) && secondary.kind == SecondaryRay::Kind::sky;
    }

    /// At the eye, of all the secondary ray sends in a band and is not `path`, its weight included.
    double whole(std::size_t i, std::size_t b) const {
        double all = of_row(i, SecondaryRows::mirrored, b);
        for (std::size_t t = 0; t < term_count; ++t) {
            if (t != static_cast<std::size_t>(Term::path)) all += of_row(i, t, b);
        }
        return all + air(i, b);
    }

    std::array<float, of_surface.size()> surface(std::size_t i) const {
        const SecondaryRay& secondary = sum_.rows().list[i];
        if (secondary.kind != SecondaryRay::Kind::facet) return {secondary.weight, -1.0f, -1.0f};
        const RadianceInput& input = tables_.input;
        const std::size_t f = secondary.what;
        const float cosine = input.facets.normal[f].dot(input.to_sun.cast<float>());
        return {secondary.weight,
                static_cast<float>(f),
                static_cast<float>(index(input.facets.material[f])),
                input.temperature[f],
                input.sun_fraction.empty() ? 0.0f : input.sun_fraction[f],
                std::max(0.0f, cosine),
                input.views.sky[f]};
    }

    /// - b: band; weigh() was asked of the secondary ray
    std::array<float, in_band> in(std::size_t b, std::size_t i) {
        const SecondaryRay& secondary = sum_.rows().list[i];
        std::array<float, in_band> out{};
        for (std::size_t k = 0; k < parts_of_light.size(); ++k) {
            const auto term = static_cast<std::size_t>(parts_of_light[k]);
            const double arrives = lanes_sum(b, arriving(i, parts_of_light[k]));
            const double leaves = lanes_sum(b, &sum_.rows().sent[row(i, term, term_count)]);
            out[3 * k] = static_cast<float>(arrives);
            out[3 * k + 1] = ratio_or_zero(leaves, arrives);
            out[3 * k + 2] = ratio_or_zero(of_row(i, term, b) / double{secondary.weight}, leaves);
        }
        const auto at_eye = [&](double sum) {
            return ratio_or_zero(sum, double{secondary.weight});
        };
        float* further = &out[secondary_planes_of_band.size()];
        out[secondary_planes_of_band.size() - 1] =
            at_eye(of_row(i, static_cast<std::size_t>(Term::behind), b));
        further[0] = mirror(b, secondary);
        further[1] = passed_[i * tables_.band.size() + b];
        further[2] = at_eye(of_row(i, SecondaryRows::mirrored, b));
        further[3] = at_eye(air(i, b));
        return out;
    }

    /// Sets what means over a band are weighted by: light on the secondary ray, or on the one
    /// before it.
    void weigh(std::size_t i) {
        const SecondaryRows& rows = sum_.rows();
        while (rows.list[i].kind != SecondaryRay::Kind::facet &&
               !SecondaryRows::starts(rows.list[i])) {
            i = SecondaryRows::before(rows.list[i]);
        }
        const SecondaryRay& secondary = rows.list[i];
        std::fill(light_.begin(), light_.end(), 1.0f);
        if (secondary.kind == SecondaryRay::Kind::plume) light_ = tables_.glow[secondary.what];
        if (secondary.kind != SecondaryRay::Kind::facet) return;
        const float* black = tables_.facet_lanes.black(tables_.target[rows.first + i]);
        for (std::size_t c = 0; c < light_.size(); ++c) {
            const auto& sun = tables_.sun_and_aureole[1];
            light_[c] = black[c] + (sun.empty() ? 0.0f : sun[c]);
        }
    }

 private:
    std::size_t row(std::size_t i, std::size_t of, std::size_t rows) const {
        return (i * rows + of) * tables_.lanes.size();
    }
    template <class Number>
    double lanes_sum(std::size_t b, const Number* lane) const {
        const auto& first = tables_.lanes.first;
        return std::accumulate(lane + first[b], lane + first[b + 1], 0.0);
    }
    double of_row(std::size_t i, std::size_t of, std::size_t b) const {
        return lanes_sum(b, &sum_.rows().sum[row(i, of, SecondaryRows::rows_of_secondary)]);
    }
    double air(std::size_t i, std::size_t b) const {
        if (SecondaryRows::starts(sum_.rows().list[i])) return 0.0;
        return of_row(i, static_cast<std::size_t>(Term::path), b);
    }
    float mean(std::size_t b, const float* share) const {
        double sum = 0.0, whole = 0.0;
        for (std::size_t c = tables_.lanes.first[b]; c < tables_.lanes.first[b + 1]; ++c) {
            sum += double{share[c] * light_[c]};
            whole += double{light_[c]};
        }
        return ratio_or_zero(sum, whole);
    }

    float mirror(std::size_t b, const SecondaryRay& secondary) const {
        if (secondary.kind != SecondaryRay::Kind::facet || secondary.closed ||
            !tables_.material(secondary).needs_rays()) {
            return 0.0f;
        }
        const AngleTable::Place at =
            tables_.angle[index(tables_.input.facets.material[secondary.what])].at(
                double{secondary.cosine});
        std::vector<float> share(light_.size());
        for (std::size_t c = 0; c < share.size(); ++c) share[c] = at.mirrored(c);
        return mean(b, share.data());
    }

    /// Light on a secondary ray as the radiance of a white diffuse surface, (lane).
    const float* arriving(std::size_t i, Term term) {
        const SecondaryRay& secondary = sum_.rows().list[i];
        arriving_.assign(light_.size(), 0.0f);
        if (secondary.kind == SecondaryRay::Kind::plume && term == Term::emitted)
            arriving_ = tables_.glow[secondary.what];
        if (secondary.kind != SecondaryRay::Kind::facet) return arriving_.data();
        const std::uint32_t target = tables_.target[sum_.rows().first + i];
        const FacetLanes& facet = tables_.facet_lanes;
        const auto add = [&](const float* lane) {
            for (std::size_t c = 0; c < arriving_.size(); ++c) arriving_[c] += lane[c];
        };
        if (term == Term::emitted) add(facet.black(target));
        if (term == Term::sky) {
            add(facet.from_sky(target, Origin::sunlight));
            add(facet.from_sky(target, Origin::sky_heat));
        }
        for (const Origin origin : all_origins) {
            if (term == Term::surroundings) add(facet.from_surroundings(target, origin));
        }
        if (term == Term::sun) {
            const std::size_t lit = tables_.lit_index(target);
            const std::array<float, 3> up = height_weights(tables_.lit.height[lit]);
            for (std::size_t c = 0; c < arriving_.size(); ++c) {
                for (std::size_t h = 0; h < 3; ++h) {
                    arriving_[c] +=
                        tables_.light.state.sunlight[lit] * up[h] * tables_.sun_and_aureole[h][c];
                }
            }
        }
        return arriving_.data();
    }

    const SecondaryTables& tables_;
    SecondarySum sum_;
    std::vector<float> light_, arriving_;  // (lane)
    std::vector<float> passed_, worth_;    // (secondary ray, band); (secondary ray)
};

/// Writes what has been found of the k-th pixel of the secondary rays.
void write_pixel(const SecondaryTables& tables, std::size_t pixel, SecondaryValues& values,
                 std::span<const SurfacePlanes> planes, std::span<float* const> left_over) {
    const std::vector<std::uint32_t> chosen = values.most(planes.size());
    std::vector<float> number(values.list().size(),
                              0.0f);  // (secondary ray) its number among the surfaces
    for (std::size_t k = 0; k < chosen.size(); ++k) {
        const std::size_t i = chosen[k];
        const SecondaryRay& secondary = values.list()[i];
        number[i] = static_cast<float>(k + 1);
        const auto surface = values.surface(i);
        for (std::size_t n = 0; n < surface.size(); ++n) planes[k].surface[n][pixel] = surface[n];
        planes[k].secondary[0][pixel] = static_cast<float>(secondary.way);
        planes[k].secondary[1][pixel] =
            secondary.before < 0 ? 0.0f : number[SecondaryRows::before(secondary)];
        planes[k].secondary[2][pixel] =
            secondary.kind == SecondaryRay::Kind::facet ? secondary.cosine : 0.0f;
        values.weigh(i);
        for (std::size_t b = 0; b < tables.band.size(); ++b) {
            const auto in_it = values.in(b, i);
            for (std::size_t n = 0; n < in_band; ++n) planes[k].band[b][n][pixel] = in_it[n];
        }
    }
    double unlisted = 0.0;
    for (std::size_t i = 0; i < number.size(); ++i) {
        const SecondaryRay& secondary = values.list()[i];
        if (number[i] > 0.0f || SecondaryValues::is_path(secondary)) continue;
        if (SecondaryRows::starts(secondary)) unlisted += double{secondary.weight};
        for (std::size_t b = 0; b < tables.band.size() && !SecondaryRows::starts(secondary); ++b) {
            left_over[b][pixel] += static_cast<float>(values.whole(i, b));
        }
    }
    left_over.back()[pixel] = unlisted > 1e-5 ? static_cast<float>(unlisted) : 0.0f;
}

}  // namespace

void add_secondary_planes(const SecondaryTables& tables, const RoughMirrors& rough,
                          std::size_t surfaces, Frame& frame) {
    assert(tables.options.by_term);
    add_empty_planes(tables, surfaces, frame);
    const std::vector<SurfacePlanes> planes = planes_of(tables, surfaces, frame);
    std::vector<float*> left_over;  // (band), then what is unlisted
    for (const BandLight& band : tables.band) {
        left_over.push_back(pixels_of("rest." + band.band.name, frame));
    }
    left_over.push_back(pixels_of("unlisted", frame));
    for_each_block(tables.secondary_rays.pixel.size(), 64, [&](std::size_t begin, std::size_t end) {
        SecondaryValues values(tables, rough);
        for (std::size_t k = begin; k < end; ++k) {
            values.look(k);
            write_pixel(tables, tables.secondary_rays.pixel[k], values, planes, left_over);
        }
    });
}

}  // namespace diurna
