#include "thermal/solve/packed_field.hpp"

#include <immintrin.h>

#include <cassert>
#include <limits>
#include <utility>

namespace diurna {

namespace {

constexpr float most_code = 65535.0f;

/// The least power of two, as a float's exponent, of which `most_code` cover a range; 0 if a range
/// is nothing, or so little that it matters nowhere.
std::uint8_t exponent_of(float range) {
    constexpr std::uint32_t least = 20, mantissa_bits = 23;
    const auto bits = std::bit_cast<std::uint32_t>(range / most_code);
    const std::uint32_t exponent =
        (bits >> mantissa_bits) + ((bits & ((1u << mantissa_bits) - 1)) != 0 ? 1 : 0);
    return exponent < least ? 0 : std::uint8_t(exponent);
}

}  // namespace

PackedField::PackedField(std::vector<int> slots, std::size_t facets)
    : slot_(std::move(slots)), facets_(facets) {
    for (const int slot : slot_) slots_ = std::max(slots_, std::size_t(slot + 1));
    code_.resize(slots_ * facets_);
    base_.resize(runs() * facets_);
    step_.resize(runs() * facets_);
}

PackedField PackedField::of_steps(std::size_t instants, std::size_t stride, std::size_t facets) {
    std::vector<int> slots(instants);
    for (std::size_t i = 0; i < instants; ++i) slots[i] = int(i / stride);
    return {std::move(slots), facets};
}

PackedField PackedField::linear_between(std::size_t instants, std::size_t stride,
                                        std::size_t facets) {
    PackedField field = of_steps(instants, stride, facets);
    if (stride > 1) field.linear_ = stride;
    return field;
}

namespace {

constexpr std::size_t run = PackedField::run;

/// Range of a run's values; finite if all are.
struct Range {
    float low, high;
    bool finite;
};

float least_of(__m256 x) {
    __m128 y = _mm_min_ps(_mm256_castps256_ps128(x), _mm256_extractf128_ps(x, 1));
    y = _mm_min_ps(y, _mm_movehl_ps(y, y));
    return _mm_cvtss_f32(_mm_min_ss(y, _mm_shuffle_ps(y, y, 1)));
}

Range range_of(const float* values) {
    const __m256 a = _mm256_loadu_ps(values), b = _mm256_loadu_ps(values + 8);
    const __m256 nothing = _mm256_add_ps(_mm256_sub_ps(a, a), _mm256_sub_ps(b, b));
    const __m256 sign = _mm256_set1_ps(-0.0f);
    const float high = -least_of(_mm256_xor_ps(_mm256_max_ps(a, b), sign));
    const int zeros = _mm256_movemask_ps(_mm256_cmp_ps(nothing, _mm256_setzero_ps(), _CMP_EQ_OQ));
    return {least_of(_mm256_min_ps(a, b)), high, zeros == 0xFF};
}

void encode(const float* values, float base, float per_step, std::uint16_t* code) {
    const auto part = [&](const float* eight) {
        const __m256 x = _mm256_mul_ps(_mm256_sub_ps(_mm256_loadu_ps(eight), _mm256_set1_ps(base)),
                                       _mm256_set1_ps(per_step));
        return _mm256_cvtps_epi32(x);
    };
    // Packing goes by halves of the registers.
    const __m256i packed = _mm256_packus_epi32(part(values), part(values + 8));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(code), _mm256_permute4x64_epi64(packed, 0xD8));
}

void decode(const std::uint16_t* code, float base, float step, float* values) {
    for (std::size_t k = 0; k < run; k += 8) {
        const __m128i eight = _mm_loadu_si128(reinterpret_cast<const __m128i*>(code + k));
        const __m256 x = _mm256_cvtepi32_ps(_mm256_cvtepu16_epi32(eight));
        // Whole numbers times a power of two are exact, so that one value alone is the same.
        const __m256 scaled = _mm256_mul_ps(x, _mm256_set1_ps(step));
        _mm256_storeu_ps(values + k, _mm256_add_ps(_mm256_set1_ps(base), scaled));
    }
}

}  // namespace

void PackedField::get(std::size_t r, std::size_t f, float* values) const {
    const std::size_t n = width(r);
    const std::uint16_t* const code = code_.data() + r * run * facets_ + f * n;
    const float base = base_[r * facets_ + f], unit = step(r, f);
    if (n == run) {
        diurna::decode(code, base, unit, values);
    } else {
        for (std::size_t k = 0; k < n; ++k) values[k] = base + float(code[k]) * unit;
    }
}

void PackedField::put(std::size_t r, std::size_t f, const float* values) {
    const std::size_t n = width(r);
    std::uint16_t* const code = code_.data() + r * run * facets_ + f * n;
    float& base = base_[r * facets_ + f];
    std::uint8_t& biased = step_[r * facets_ + f];
    float filled[run];
    if (n < run) {
        std::fill(std::copy_n(values, n, filled), filled + run, values[0]);
        values = filled;
    }
    const Range range = range_of(values);
    const float wide = range.high - range.low;
    const bool known = range.finite && wide < std::numeric_limits<float>::max();
    base = known ? range.low : std::numeric_limits<float>::quiet_NaN();
    biased = known ? exponent_of(wide) : std::uint8_t{0};
    if (biased == 0) {
        std::fill_n(code, n, std::uint16_t{0});
        return;
    }
    const float per_step = two_to(std::uint8_t(254 - biased));
    if (n == run) {
        encode(values, base, per_step, code);
        return;
    }
    std::uint16_t all[run];
    encode(values, base, per_step, all);
    std::copy_n(all, n, code);
}

namespace {

/// Rows of eight values become columns.
void transpose(__m256 (&x)[8]) {
    __m256 pair[8], four[8];
    for (int k = 0; k < 8; k += 2) {
        pair[k] = _mm256_unpacklo_ps(x[k], x[k + 1]);
        pair[k + 1] = _mm256_unpackhi_ps(x[k], x[k + 1]);
    }
    for (int k = 0; k < 8; k += 4) {
        four[k] = _mm256_shuffle_ps(pair[k], pair[k + 2], 0x44);
        four[k + 1] = _mm256_shuffle_ps(pair[k], pair[k + 2], 0xEE);
        four[k + 2] = _mm256_shuffle_ps(pair[k + 1], pair[k + 3], 0x44);
        four[k + 3] = _mm256_shuffle_ps(pair[k + 1], pair[k + 3], 0xEE);
    }
    for (int k = 0; k < 4; ++k) {
        x[k] = _mm256_permute2f128_ps(four[k], four[k + 4], 0x20);
        x[k + 4] = _mm256_permute2f128_ps(four[k], four[k + 4], 0x31);
    }
}

/// Eight rows of a run become its slots, and back.
void to_slots(const float* rows, std::size_t stride, float* slots) {
    for (std::size_t half = 0; half < run; half += 8) {
        __m256 x[8];
        for (std::size_t k = 0; k < 8; ++k) x[k] = _mm256_loadu_ps(rows + k * run + half);
        transpose(x);
        for (std::size_t k = 0; k < 8; ++k) _mm256_storeu_ps(slots + (half + k) * stride, x[k]);
    }
}
void to_rows(const float* slots, std::size_t stride, float* rows) {
    for (std::size_t half = 0; half < run; half += 8) {
        __m256 x[8];
        for (std::size_t k = 0; k < 8; ++k) x[k] = _mm256_loadu_ps(slots + (half + k) * stride);
        transpose(x);
        for (std::size_t k = 0; k < 8; ++k) _mm256_storeu_ps(rows + k * run + half, x[k]);
    }
}

}  // namespace

void PackedField::get(std::size_t r, std::span<const std::size_t> facets, std::size_t stride,
                      float* values) const {
    float rows[together * run];
    for (std::size_t first = 0; first < facets.size(); first += together) {
        const std::size_t n = std::min(together, facets.size() - first);
        for (std::size_t k = 0; k < together; ++k) {
            get(r, facets[first + std::min(k, n - 1)], rows + k * run);
        }
        if (width(r) == run) {
            to_slots(rows, stride, values + first);
            continue;
        }
        for (std::size_t slot = 0; slot < width(r); ++slot) {
            for (std::size_t k = 0; k < together; ++k) {
                values[slot * stride + first + k] = rows[k * run + slot];
            }
        }
    }
}

void PackedField::put(std::size_t r, std::span<const std::size_t> facets, std::size_t stride,
                      const float* values) {
    float rows[together * run];
    for (std::size_t first = 0; first < facets.size(); first += together) {
        const std::size_t n = std::min(together, facets.size() - first);
        if (width(r) == run) {
            to_rows(values + first, stride, rows);
        } else {
            for (std::size_t slot = 0; slot < width(r); ++slot) {
                for (std::size_t k = 0; k < n; ++k) {
                    rows[k * run + slot] = values[slot * stride + first + k];
                }
            }
        }
        for (std::size_t k = 0; k < n; ++k) put(r, facets[first + k], rows + k * run);
    }
}

void PackedField::get(std::size_t f, float* values) const {
    for (std::size_t r = 0; r < runs(); ++r) get(r, f, values + r * run);
}

void PackedField::put(std::size_t f, const float* values) {
    for (std::size_t r = 0; r < runs(); ++r) put(r, f, values + r * run);
}

void PackedField::fill(std::size_t f, float value) {
    for (std::size_t r = 0; r < runs(); ++r) {
        base_[r * facets_ + f] = value;
        step_[r * facets_ + f] = 0;
        std::fill_n(code_.begin() + std::ptrdiff_t(r * run * facets_ + f * width(r)), width(r),
                    std::uint16_t{0});
    }
}

void PackedField::decode(std::size_t instant, std::span<float> values) const {
    assert(values.size() == facets_);
    const Row from = row(instant);
    for (std::size_t f = 0; f < facets_; ++f) values[f] = from(f);
}

void PackedField::decode(std::span<const std::size_t> instants, std::span<float> values) const {
    assert(values.size() == instants.size() * facets_);
    std::size_t facet[together];
    float slots[run * together];
    for (std::size_t first = 0, next = 0; first < instants.size(); first = next) {
        if (slot_[instants[first]] < 0) {
            std::fill_n(values.begin() + std::ptrdiff_t(first * facets_), facets_, 0.0f);
            next = first + 1;
            continue;
        }
        const auto r = std::size_t(slot_[instants[first]]) / run;
        while (next < instants.size() && slot_[instants[next]] >= 0 &&
               std::size_t(slot_[instants[next]]) / run == r) {
            ++next;
        }
        for (std::size_t f = 0; f < facets_; f += together) {
            const std::size_t n = std::min(together, facets_ - f);
            for (std::size_t k = 0; k < n; ++k) facet[k] = f + k;
            get(r, {facet, n}, together, slots);
            for (std::size_t i = first; i < next; ++i) {
                const float* const from = slots + std::size_t(slot_[instants[i]]) % run * together;
                std::copy_n(from, n, values.data() + i * facets_ + f);
            }
        }
    }
}

PackedField::Extremes PackedField::extremes(std::size_t count) const {
    constexpr float none = std::numeric_limits<float>::quiet_NaN();
    Extremes all{std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()};
    bool known = true;
    float values[run];
    for (std::size_t r = 0; r < runs(); ++r) {
        for (std::size_t f = 0; f < count; ++f) {
            get(r, f, values);
            std::fill(values + width(r), values + run, values[0]);
            const Range range = range_of(values);
            known = known && range.finite;
            all.least = std::min(all.least, range.low);
            all.greatest = std::max(all.greatest, range.high);
        }
    }
    return known ? all : Extremes{none, none};
}

namespace {

std::size_t rounded_up(std::size_t facets) {
    return (facets + PackedField::together - 1) / PackedField::together * PackedField::together;
}

}  // namespace

const float* PackedReader::at(std::size_t instant) {
    const int slot = field_.slot(instant);
    if (slot < 0) return nullptr;
    if (field_.linear()) return between(instant);
    const std::size_t r = std::size_t(slot) / run;
    if (r != run_) {
        run_ = r;
        values_.resize(run * stride_);
        field_.get(r, facets_, stride_, values_.data());
    }
    return values_.data() + std::size_t(slot) % run * stride_;
}

const float* PackedReader::between(std::size_t instant) {
    if (values_.empty()) {
        values_.resize(field_.runs() * run * stride_);
        between_.resize(stride_);
        for (std::size_t r = 0; r < field_.runs(); ++r) {
            field_.get(r, facets_, stride_, &values_[r * run * stride_]);
        }
    }
    const float* const here = &values_[std::size_t(field_.slot(instant)) * stride_];
    const float share = field_.share(instant);
    if (share == 0.0f) return here;
    for (std::size_t l = 0; l < stride_; ++l) {
        between_[l] = here[l] + share * (here[l + stride_] - here[l]);
    }
    return between_.data();
}

PackedWriter::PackedWriter(PackedField& field, std::span<const std::size_t> facets)
    : field_(field), facets_(facets), stride_(rounded_up(facets.size())), values_(run * stride_) {}

void PackedWriter::add(const double* values) {
    float* const row = values_.data() + slot_++ % run * stride_;
    for (std::size_t k = 0; k < facets_.size(); ++k) row[k] = float(values[k]);
    if (slot_ % run == 0) flush();
}

void PackedWriter::flush() { field_.put((slot_ - 1) / run, facets_, stride_, values_.data()); }

}  // namespace diurna
