#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace diurna {

/// A value of every facet at every instant of a span, (instant, facet), in 18.5 bits each: runs of
/// sixteen instants of a facet share a base and a power of two, and each has 16 bits. A value
/// differs from the given one by at most 1/65535 of the range of its run: by 0.15 mK where a
/// temperature changes by 10 K in sixteen steps. Equal values of a run are exact. A value that is
/// not finite makes its run NaN.
///
/// Different facets can be written at the same time.
class PackedField {
 public:
    static constexpr std::size_t run = 16;  // instants of a run
    /// So many instants rounded up to whole runs.
    static constexpr std::size_t whole_runs(std::size_t instants) {
        return (instants + run - 1) / run * run;
    }

    PackedField() = default;
    /// All zero.
    ///
    /// - slots: (instant) number of the stored value, from 0 ascending without gaps, equal where
    ///   instants share one; < 0: always zero
    PackedField(std::vector<int> slots, std::size_t facets);
    /// A value for every one of so many instants, or for every `stride`-th, of which the others
    /// have that before them.
    static PackedField of_steps(std::size_t instants, std::size_t stride, std::size_t facets);
    /// The same, the others linear between the values around them. The stride divides the steps
    /// between the instants.
    static PackedField linear_between(std::size_t instants, std::size_t stride, std::size_t facets);

    bool empty() const { return code_.empty(); }
    std::size_t instants() const { return slot_.size(); }
    std::size_t facets() const { return facets_; }
    std::size_t slots() const { return slots_; }
    std::size_t runs() const { return whole_runs(slots_) / run; }
    /// Stored values of a run.
    std::size_t width(std::size_t r) const { return std::min(run, slots_ - r * run); }

    /// The values of all facets at one instant.
    class Row {
     public:
        float operator()(std::size_t f) const {
            const float here = value_.at(f);
            return share_ == 0.0f ? here : here + share_ * (next_.at(f) - here);
        }

     private:
        friend class PackedField;
        struct Values {
            const std::uint16_t* code = nullptr;  // null: all are zero
            const float* base = nullptr;
            const std::uint8_t* step = nullptr;
            std::size_t width = 0;
            float at(std::size_t f) const {
                return code == nullptr ? 0.0f : base[f] + float(code[f * width]) * two_to(step[f]);
            }
        };
        Values value_{}, next_{};
        float share_ = 0.0f;  // of the way from one to the next
    };
    Row row(std::size_t instant) const;
    float at(std::size_t instant, std::size_t f) const { return row(instant)(f); }

    /// The distance of neighbouring codes of a run of one facet.
    float step(std::size_t r, std::size_t f) const { return two_to(step_[r * facets_ + f]); }
    /// The values of a run of one facet: width(r) of them.
    void get(std::size_t r, std::size_t f, float* values) const;
    void put(std::size_t r, std::size_t f, const float* values);
    /// The same of some facets, (slot of the run, facet of these), `stride` from one slot to the
    /// next: at least their number, rounded up to `together`. What lies beyond the facets is a copy
    /// of the last.
    void get(std::size_t r, std::span<const std::size_t> facets, std::size_t stride,
             float* values) const;
    void put(std::size_t r, std::span<const std::size_t> facets, std::size_t stride,
             const float* values);
    static constexpr std::size_t together = 8;  // facets
    /// The slot of an instant; < 0: its values are zero.
    int slot(std::size_t instant) const { return slot_[instant]; }
    /// How far an instant is on the way from its slot to the next: 0 but in linear_between().
    float share(std::size_t instant) const {
        return linear_ == 0 ? 0.0f : float(instant % linear_) / float(linear_);
    }
    bool linear() const { return linear_ > 0; }
    /// Instants from one slot to the next of linear_between(); else 1.
    std::size_t stride() const { return std::max<std::size_t>(1, linear_); }
    /// All stored values of one facet: slots() of them.
    void get(std::size_t f, float* values) const;
    void put(std::size_t f, const float* values);
    /// The same value at all instants.
    void fill(std::size_t f, float value);
    /// Values of all facets at one instant.
    void decode(std::size_t instant, std::span<float> values) const;
    /// The same at some instants, ascending: (instant of these, facet).
    void decode(std::span<const std::size_t> instants, std::span<float> values) const;
    /// Of the first `count` facets; both not a number where any value is none.
    struct Extremes {
        float least, greatest;
    };
    Extremes extremes(std::size_t count) const;

 private:
    std::vector<int> slot_;  // (instant)
    std::size_t facets_ = 0, slots_ = 0;
    std::size_t linear_ = 0;  // instants from slot to slot of linear_between(); else 0
    Row::Values values_at(std::size_t slot) const;
    std::vector<std::uint16_t> code_;  // (run, facet, slot of the run)
    std::vector<float> base_;          // (run, facet): value = base + code × step
    std::vector<std::uint8_t> step_;   // exponent of two, plus 127

    static float two_to(std::uint8_t biased) {
        return std::bit_cast<float>(std::uint32_t{biased} << 23);
    }
};

/// Runs of instants that are computed together where the facets exchange: at most so many, fewer
/// where a buffer of their values would be larger than 64 MB (350 000 facets: 3 runs).
inline std::size_t runs_at_once(std::size_t facets, std::size_t most) {
    constexpr std::size_t most_values = 16'777'216;
    return std::clamp<std::size_t>(most_values / (PackedField::run * (facets + 1)), 1, most);
}

inline PackedField::Row PackedField::row(std::size_t instant) const {
    Row row;
    if (slot_[instant] < 0) return row;
    const auto slot = std::size_t(slot_[instant]);
    row.value_ = values_at(slot);
    row.share_ = share(instant);
    if (row.share_ > 0.0f) row.next_ = values_at(slot + 1);
    return row;
}

inline PackedField::Row::Values PackedField::values_at(std::size_t slot) const {
    const std::size_t r = slot / run;
    return {.code = code_.data() + r * run * facets_ + slot % run,
            .base = base_.data() + r * facets_,
            .step = step_.data() + r * facets_,
            .width = width(r)};
}

/// Reads the values of some facets instant by instant, a run of them at a time.
class PackedReader {
 public:
    /// - stride: of what is read: the facets' number, rounded up to PackedField::together
    PackedReader(const PackedField& field, std::span<const std::size_t> facets, std::size_t stride)
        : field_(field), facets_(facets), stride_(stride) {}
    /// The facets' values at an instant, `stride` of them; null: all are zero.
    const float* at(std::size_t instant);

 private:
    const float* between(std::size_t instant);
    const PackedField& field_;
    std::span<const std::size_t> facets_;
    std::size_t stride_, run_ = static_cast<std::size_t>(-1);
    std::vector<float> values_{};   // (slot of the run, facet of these); of all runs if linear
    std::vector<float> between_{};  // (facet of these)
};

/// Writes the values of some facets slot by slot: a run is packed when it is complete, the last one
/// at the end of its life.
class PackedWriter {
 public:
    PackedWriter(PackedField& field, std::span<const std::size_t> facets);
    ~PackedWriter() {
        if (slot_ % PackedField::run != 0) flush();
    }
    PackedWriter(const PackedWriter&) = delete;
    PackedWriter& operator=(const PackedWriter&) = delete;

    /// The values of the facets in the next slot.
    void add(const double* values);

 private:
    void flush();
    PackedField& field_;
    std::span<const std::size_t> facets_;
    std::size_t stride_;
    std::vector<float> values_;  // (slot of the run, facet of these)
    std::size_t slot_ = 0;
};

}  // namespace diurna
