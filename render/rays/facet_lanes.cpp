#include "render/rays/facet_lanes.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "materials/base/parallel.hpp"
#include "render/eye/facet_rows.hpp"
#include "render/light/lanes.hpp"

namespace diurna {

namespace {

constexpr std::size_t arriving_rows = 3 * origin_count;
constexpr std::size_t all_rows = arriving_rows + sent_rows.size();

/// Numbers of an EyeRow that a row is made of.
struct Numbers {
    std::size_t first, last;
};
Numbers numbers_of(const EyeRow& layout, std::size_t row) {
    if (row == 0) return {0, layout.thermal};
    if (row < 1 + origin_count) return {layout.thermal, layout.sky()};
    if (row < 2 * origin_count) return {layout.sky(), layout.sun()};
    return {0, layout.one() + 1};
}

/// What the numbers of an EyeRow come to in the channels of a band, for facets of one material: the
/// sum over a channel's nodes is the same for all of them.
class BandWorth {
 public:
    BandWorth(const SceneLight& light, const BandLight& band, const EyeRow& layout, MaterialId of)
        : band_(band),
          optics_(band.optics[index(of)]),
          layout_(layout),
          room_behind_(!optics_.room.empty() && !light.input.materials[of].see_through),
          channels_(rounded_up(band.channels.size())),
          worth_(all_rows * (layout.one() + 1) * channels_, 0.0f) {
        Rows rows(all_rows, Eigen::Index(layout.one() + 1));
        for (std::size_t c = 0; c < band.channels.size(); ++c) {
            rows.setZero();
            for (std::size_t n = band.channels.first[c]; n < band.channels.first[c + 1]; ++n) {
                add_node(n, rows);
            }
            for (std::size_t r = 0; r < sent_rows.size(); ++r) {
                const auto o = static_cast<Eigen::Index>(sent_rows[r].origin);
                rows.row(Eigen::Index(2 * origin_count) + o) +=
                    rows.row(Eigen::Index(arriving_rows + r));
            }
            for (Eigen::Index r = 0; r < rows.rows(); ++r) {
                for (Eigen::Index k = 0; k < rows.cols(); ++k) {
                    worth_[std::size_t(r * rows.cols() + k) * channels_ + c] =
                        static_cast<float>(rows(r, k));
                }
            }
        }
    }

    /// Sums of the first rows, (row, channel), `apart` from one to the next.
    void sum(std::span<const float> numbers, std::size_t rows, std::size_t apart,
             float* out) const {
        for (std::size_t r = 0; r < rows; ++r) {
            const auto [first, last] = numbers_of(layout_, r);
            const float* const row = &worth_[r * (layout_.one() + 1) * channels_];
            for (std::size_t c = 0; c < channels_; c += lane_count) {
                Lane sum = Lane::Zero();
                for (std::size_t k = first; k < last; ++k) {
                    sum += numbers[k] * load(row + k * channels_ + c);
                }
                Eigen::Map<Lane>(out + r * apart + c) = sum;
            }
        }
    }

 private:
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

    static Eigen::Index sent(Term term, Origin origin) {
        const auto found = std::find_if(sent_rows.begin(), sent_rows.end(), [&](const SentRow& of) {
            return of.term == term && of.origin == origin;
        });
        return Eigen::Index(arriving_rows) + (found - sent_rows.begin());
    }

    void add_node(std::size_t n, Rows& rows) const {
        const SpectralBasis& basis = band_.basis;
        const double w = band_.band.weight[n], reflectance = optics_.reflectance[n];
        const double root = basis.root_weight[Eigen::Index(n)];
        const Eigen::Index emitted = sent(Term::emitted, Origin::surface),
                           behind = sent(Term::behind, Origin::surface);
        for (std::size_t k = 0; k < layout_.thermal; ++k) {
            const auto at = static_cast<Eigen::Index>(k);
            const double black = root * basis.mode(Eigen::Index(n), at);
            rows(0, at) += black;
            rows(emitted, at) += optics_.emissivity[n] * black;
            if (!room_behind_) rows(behind, at) += optics_.transmittance[n] * black;
        }
        if (room_behind_) rows(behind, Eigen::Index(layout_.one())) += w * optics_.room[n];
        for (std::size_t k = 0; k < layout_.light; ++k) {
            const auto at = static_cast<Eigen::Index>(layout_.thermal + k);
            const auto light = basis.by_origin(basis.mode.col(Eigen::Index(k)), n);
            for (const Origin origin : all_origins) {
                const auto o = static_cast<std::size_t>(origin);
                rows(Eigen::Index(1 + o), at) += root * light[o];
                rows(sent(Term::surroundings, origin), at) += reflectance * root * light[o];
            }
        }
        for (const Origin origin : {Origin::sunlight, Origin::sky_heat}) {
            for (std::size_t k = 0; k < layout_.skies; ++k) {
                const std::vector<double>& sky = from(band_.sky.spectrum[k], origin);
                if (sky.empty()) continue;
                const auto at = static_cast<Eigen::Index>(layout_.sky() + k);
                rows(Eigen::Index(origin_count) + static_cast<Eigen::Index>(origin), at) +=
                    w * sky[n];
                rows(sent(Term::sky, origin), at) += reflectance * w * sky[n];
            }
        }
        for (std::size_t h = 0; h < band_.incident.size(); ++h) {
            if (band_.incident[h].sun.empty()) continue;
            rows(sent(Term::sun, Origin::sunlight), Eigen::Index(layout_.sun() + h)) +=
                reflectance * w * band_.incident[h].from_sun(n);
        }
    }

    const BandLight& band_;
    const NodeOptics& optics_;
    EyeRow layout_;
    bool room_behind_;
    std::size_t channels_;      // padded
    std::vector<float> worth_;  // (row, number, channel)
};

/// (material, band) of the materials of some facets; the rest stays empty.
std::vector<std::vector<BandWorth>> worths_of(const SceneLight& light,
                                              std::span<const EyeRow> layout,
                                              std::span<const std::uint32_t> lit) {
    std::vector<std::uint8_t> met(light.input.materials.size(), 0);
    for (const std::uint32_t i : lit) met[index(light.lit.material[i])] = 1;
    std::vector<std::vector<BandWorth>> worth(met.size());
    for_each_index(
        met.size(),
        [&](std::size_t m) {
            for (std::size_t b = 0; met[m] != 0 && b < layout.size(); ++b) {
                worth[m].emplace_back(light, light.band[b], layout[b],
                                      MaterialId{static_cast<std::uint16_t>(m)});
            }
        },
        1);
    return worth;
}

}  // namespace

FacetLanes::FacetLanes(const SceneLight& light, std::size_t first, std::size_t targets,
                       const ChannelLanes& lanes, bool by_term)
    : lanes_(lanes.size()), rows_of_facet_(by_term ? all_rows : arriving_rows) {
    rows_.assign(targets * rows_of_facet_ * lanes_, 0.0f);
    const std::span<const std::uint32_t> lit = std::span(light.lit.target).subspan(first, targets);
    const std::vector<EyeRow> layout(light.band.begin(), light.band.end());
    const std::vector<std::vector<BandWorth>> worth = worths_of(light, layout, lit);
    for_each_block(targets, 64, [&](std::size_t begin, std::size_t end) {
        constexpr std::size_t ahead = 4;
        FacetRows of_facet(light);
        std::vector<std::vector<float>> numbers;  // (band)
        std::vector<float*> into;
        for (const EyeRow& row : layout) numbers.emplace_back(row.width(), 0.0f);
        for (std::vector<float>& row : numbers) into.push_back(row.data());
        for (std::size_t t = begin; t < end; ++t) {
            if (t + ahead < end) light.radiosity.fetch(lit[t + ahead]);
            of_facet.fill(lit[t], into);
            const std::vector<BandWorth>& of = worth[index(light.lit.material[lit[t]])];
            for (std::size_t b = 0; b < of.size(); ++b) {
                of[b].sum(numbers[b], rows_of_facet_, lanes_,
                          &rows_[t * rows_of_facet_ * lanes_ + lanes.first[b]]);
            }
        }
    });
}

}  // namespace diurna
