#include "render/eye/surface_planes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <numeric>

#include "materials/base/parallel.hpp"
#include "render/eye/facet_rows.hpp"

namespace diurna {

namespace {

constexpr auto nothing_seen = ~std::uint32_t{0};

/// Terms that are light × a factor of the surface × the air, and how their planes are called.
struct Product {
    Term term;
    const char *light, *factor, *air;
};
constexpr std::array<Product, 4> products = {
    {{Term::emitted, "black", "emissivity", "transmittance"},
     {Term::sun, "sunlight", "reflectance_sun", "transmittance_sun"},
     {Term::sky, "skylight", "reflectance_sky", "transmittance_sky"},
     {Term::surroundings, "surroundings", "reflectance_surroundings",
      "transmittance_surroundings"}}};

TermSet only(Term term) {
    TermSet terms{};
    terms[static_cast<std::size_t>(term)] = true;
    return terms;
}

/// As light falls on it: it emits and reflects all.
NodeOptics white(std::size_t nodes) {
    return {.emissivity = std::vector<double>(nodes, 1.0),
            .reflectance = std::vector<double>(nodes, 1.0),
            .transmittance = std::vector<double>(nodes, 0.0),
            .room = {}};
}

/// What the numbers of a facet's row contribute in a band, (product)(number).
using Worth = std::array<std::vector<double>, products.size()>;
Worth worth_of(const BandLight& band, const NodeOptics& optics) {
    Worth worth;
    for (std::size_t i = 0; i < products.size(); ++i) {
        worth[i] = worth_on_leaving(band, optics, only(products[i].term));
    }
    return worth;
}
struct BandWorth {
    Worth arriving;              // on any surface
    std::vector<Worth> leaving;  // (material); empty where none is lit
};
BandWorth worth_in(const BandLight& band) {
    BandWorth worth{.arriving = worth_of(band, white(band.band.node_um.size())),
                    .leaving = std::vector<Worth>(band.optics.size())};
    for (std::size_t m = 0; m < band.optics.size(); ++m) {
        if (!band.optics[m].reflectance.empty()) worth.leaving[m] = worth_of(band, band.optics[m]);
    }
    return worth;
}

/// The sightings that a pixel has most of, the k-th of all pixels one after the other.
std::vector<std::uint32_t> seen_most(const View& view, std::size_t surfaces) {
    std::vector<std::uint32_t> seen(surfaces * view.pixels(), nothing_seen);
    std::vector<std::uint32_t> order;
    for (std::size_t p = 0; p < view.pixels(); ++p) {
        order.resize(view.row[p + 1] - view.row[p]);
        std::iota(order.begin(), order.end(), view.row[p]);
        std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
            return view.sighting[a].weight > view.sighting[b].weight;
        });
        for (std::size_t k = 0; k < std::min(surfaces, order.size()); ++k) {
            seen[k * view.pixels() + p] = order[k];
        }
    }
    return seen;
}

/// What sightings have of their own, (sighting).
struct OwnState {
    std::vector<float> sun, warmer;          // share of the sun; [K] than the facet
    std::vector<std::uint32_t> warm, place;  // sightings that are warmer; index of each in `warm`

    OwnState(const View& view, const RadianceInput& input, const PixelSun* pixels,
             const LinearFacets* ground)
        : sun(view.sighting.size(), 0.0f), warmer(sun), place(sun.size(), nothing_seen) {
        for (std::size_t s = 0; s < sun.size() && !input.sun_fraction.empty(); ++s) {
            sun[s] = input.sun_fraction[index(view.surface[view.sighting[s].target])];
        }
        if (ground != nullptr && !ground->empty()) warmer = ground->warmer;
        for (std::size_t e = 0; pixels != nullptr && e < pixels->share.size(); ++e) {
            const std::uint32_t s = pixels->sighting[e];
            sun[s] = pixels->share[e];
            if (!pixels->warmer.empty()) warmer[s] += pixels->warmer[e];
        }
        for (std::size_t s = 0; s < warmer.size(); ++s) {
            if (warmer[s] == 0.0f) continue;
            place[s] = static_cast<std::uint32_t>(warm.size());
            warm.push_back(static_cast<std::uint32_t>(s));
        }
    }
};

float at_sighting(const AtEye& at, const Sighting& s) {
    return at.value + s.deeper * at.by_range + s.higher * at.by_height;
}
float ratio(double of, double to) { return to > 0.0 ? static_cast<float>(of / to) : 0.0f; }

/// What a pixel's surfaces send, for all pixels.
class SurfaceLight {
 public:
    SurfaceLight(const View& view, const SceneLight& light, const EyeTables& eye,
                 const OwnState& own)
        : view_(view),
          light_(light),
          columns_(eye.columns()),
          own_(own),
          at_eye_(view.surface.size() * columns_),
          whole_sun_(view.surface.size() * columns_),
          warmth_(own.warm.size() * columns_),
          to_sun_(light.input.to_sun.cast<float>()) {
        std::vector<std::uint32_t> all(view.surface.size());
        std::iota(all.begin(), all.end(), 0u);
        eye.look(view, light, at_eye_);
        eye.look_at_sun(view, light, all, whole_sun_);
        std::vector<std::uint32_t> targets;
        std::vector<float> warmer;
        for (const std::uint32_t s : own.warm) {
            targets.push_back(view.sighting[s].target);
            warmer.push_back(own.warmer[s]);
        }
        eye.look_at_warmth(view, light, targets, warmer, warmth_);
        for (const BandLight& band : light.band) worth_.push_back(worth_in(band));
    }

    float cosine_to_sun(SurfaceId facet) const {
        return std::max(0.0f, light_.input.facets.normal[index(facet)].dot(to_sun_));
    }

    /// Adds the planes of a band of the surfaces `seen`, (pixel).
    void add(std::size_t b, std::span<const std::uint32_t> seen, std::size_t k,
             Frame& frame) const {
        const std::string& band = light_.band[b].band.name;
        std::array<std::vector<float>, 3 * products.size() + 1> out;
        for (auto& plane : out) plane.assign(seen.size(), 0.0f);
        for_each_block(seen.size(), 1024, [&](std::size_t begin, std::size_t end) {
            FacetRows rows(light_);
            std::vector<std::vector<float>> row;
            std::vector<float*> to;
            std::vector<float> black(light_.tables.lanes);
            for (const EyeRow& r : rows.layout()) row.emplace_back(r.width(), 0.0f);
            for (auto& r : row) to.push_back(r.data());
            for (std::size_t p = begin; p < end; ++p) {
                if (seen[p] == nothing_seen) continue;
                const std::uint32_t lit = light_.lit.target[view_.sighting[seen[p]].target];
                rows.fill(lit, to);
                black_modes(light_.tables, light_.state.temperature[lit] + own_.warmer[seen[p]],
                            black.data());
                std::copy_n(&black[light_.tables.first[b]], rows.layout()[b].thermal, to[b]);
                const std::array<float, out.size()> value = of_sighting(b, seen[p], row[b]);
                for (std::size_t i = 0; i < out.size(); ++i) out[i][p] = value[i];
            }
        });
        const auto push = [&](const char* name, const char* unit, std::size_t i) {
            frame.planes.push_back({fmt::format("{}_{}.{}", name, k, band), unit, out[i]});
        };
        for (std::size_t i = 0; i < products.size(); ++i) {
            push(products[i].light, "W m-2 sr-1", 3 * i);
            push(products[i].factor, "1", 3 * i + 1);
            push(products[i].air, "1", 3 * i + 2);
        }
        push("behind", "W m-2 sr-1", 3 * products.size());
    }

 private:
    /// Light, factor and air of each product, and what is behind.
    std::array<float, 3 * products.size() + 1> of_sighting(std::size_t b, std::uint32_t sighting,
                                                           std::vector<float>& row) const {
        const Sighting& s = view_.sighting[sighting];
        const SurfaceId facet = view_.surface[s.target];
        const std::size_t lit = light_.lit.target[s.target];
        const Worth& leaving = worth_[b].leaving[index(light_.lit.material[lit])];
        // The row of the whole sun: what reaches this pixel is a share of it.
        const EyeRow layout(light_.band[b]);
        const std::array<float, 3> up = height_weights(light_.lit.height[lit]);
        for (std::size_t h = 0; h < 3; ++h) {
            row[layout.sun() + h] = sunlight_on(1.0f, cosine_to_sun(facet)) * up[h];
        }
        const auto sum = [&row](const std::vector<double>& worth) {
            return std::inner_product(row.begin(), row.end(), worth.begin(), 0.0);
        };
        const auto at_eye = [&](Term term) {
            const auto& from = term == Term::sun ? whole_sun_ : at_eye_;
            const std::size_t column = b * term_count + static_cast<std::size_t>(term);
            const float mean = at_sighting(from[s.target * columns_ + column], s);
            const std::size_t warm = own_.place[sighting];
            if (warm == nothing_seen || term == Term::sun) return double{mean};
            return double{mean + at_sighting(warmth_[warm * columns_ + column], s)};
        };
        std::array<float, 3 * products.size() + 1> out{};
        for (std::size_t i = 0; i < products.size(); ++i) {
            const double arrives = sum(worth_[b].arriving[i]), leaves = sum(leaving[i]);
            const Term term = products[i].term;
            const double part = term == Term::sun ? double{own_.sun[sighting]} : 1.0;
            out[3 * i] = static_cast<float>(part * arrives);
            out[3 * i + 1] = ratio(leaves, arrives);
            out[3 * i + 2] = ratio(at_eye(term), leaves);
        }
        out.back() = static_cast<float>(at_eye(Term::behind));
        return out;
    }

    const View& view_;
    const SceneLight& light_;
    std::size_t columns_;
    const OwnState& own_;
    std::vector<AtEye> at_eye_, whole_sun_;  // (target, column)
    std::vector<AtEye> warmth_;              // (sighting that is warmer, column)
    Eigen::Vector3f to_sun_;
    std::vector<BandWorth> worth_;  // (band)
};

}  // namespace

void add_surface_planes(const View& view, const SceneLight& light, const EyeTables& eye,
                        const PixelSun* sun, const LinearFacets* ground, std::size_t surfaces,
                        Frame& frame) {
    assert(eye.columns_of_band() == term_count);
    const RadianceInput& input = light.input;
    const OwnState own(view, input, sun, ground);
    const SurfaceLight of_surface(view, light, eye, own);
    const std::vector<std::uint32_t> seen = seen_most(view, surfaces);
    std::vector<float> unlisted(view.pixels());
    for (std::size_t p = 0; p < unlisted.size(); ++p) {
        unlisted[p] = 1.0f - view.sky[p];
        for (std::size_t k = 0; k < surfaces; ++k) {
            const std::uint32_t s = seen[k * view.pixels() + p];
            if (s != nothing_seen) unlisted[p] -= view.sighting[s].weight;
        }
        unlisted[p] = unlisted[p] > 1e-5f ? unlisted[p] : 0.0f;
    }
    frame.planes.push_back({"unlisted", "1", std::move(unlisted)});
    for (std::size_t k = 0; k < surfaces; ++k) {
        const auto of_pixel = std::span(seen).subspan(k * view.pixels(), view.pixels());
        const auto add = [&](const char* name, const char* unit, float none, const auto& value) {
            std::vector<float> plane(view.pixels(), none);
            for (std::size_t p = 0; p < plane.size(); ++p) {
                if (of_pixel[p] == nothing_seen) continue;
                const SurfaceId facet = view.surface[view.sighting[of_pixel[p]].target];
                plane[p] = static_cast<float>(value(of_pixel[p], facet));
            }
            frame.planes.push_back({fmt::format("{}_{}", name, k + 1), unit, std::move(plane)});
        };
        add("weight", "1", 0.0f,
            [&](std::uint32_t s, SurfaceId) { return view.sighting[s].weight; });
        add("facet", "1", -1.0f, [&](std::uint32_t, SurfaceId f) { return index(f); });
        add("material", "1", -1.0f,
            [&](std::uint32_t, SurfaceId f) { return index(input.facets.material[index(f)]); });
        add("temperature", "K", 0.0f, [&](std::uint32_t s, SurfaceId f) {
            return input.temperature[index(f)] + own.warmer[s];
        });
        add("sun_fraction", "1", 0.0f, [&](std::uint32_t s, SurfaceId) { return own.sun[s]; });
        add("cosine_sun", "1", 0.0f,
            [&](std::uint32_t, SurfaceId f) { return of_surface.cosine_to_sun(f); });
        add("sky_view", "1", 0.0f,
            [&](std::uint32_t, SurfaceId f) { return input.views.sky[index(f)]; });
        for (std::size_t b = 0; b < light.band.size(); ++b) {
            of_surface.add(b, of_pixel, k + 1, frame);
        }
    }
}

}  // namespace diurna
