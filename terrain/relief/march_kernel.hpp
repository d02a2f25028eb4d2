#pragma once

// Included by one unit per processor; everything is local to it.

#include <immintrin.h>

#include "terrain/relief/march.hpp"

namespace diurna {
namespace {

#ifdef __AVX512F__
struct Lanes {
    static constexpr int width = 16;
    __m512 v;
    static Lanes all(float x) { return {_mm512_set1_ps(x)}; }
    static Lanes load(const float* p) { return {_mm512_loadu_ps(p)}; }
    void store(float* p) const { _mm512_storeu_ps(p, v); }
    friend Lanes operator-(Lanes a, Lanes b) { return {_mm512_sub_ps(a.v, b.v)}; }
    friend Lanes operator*(Lanes a, Lanes b) { return {_mm512_mul_ps(a.v, b.v)}; }
    static Lanes fma(Lanes a, Lanes b, Lanes c) { return {_mm512_fmadd_ps(a.v, b.v, c.v)}; }
    static Lanes max(Lanes a, Lanes b) { return {_mm512_max_ps(a.v, b.v)}; }
    static Lanes min(Lanes a, Lanes b) { return {_mm512_min_ps(a.v, b.v)}; }
    static unsigned greater(Lanes a, Lanes b) { return _mm512_cmp_ps_mask(a.v, b.v, _CMP_GT_OQ); }
    static Lanes where_greater(Lanes a, Lanes b, Lanes yes, Lanes no) {
        return {_mm512_mask_blend_ps(_mm512_cmp_ps_mask(a.v, b.v, _CMP_GT_OQ), no.v, yes.v)};
    }
};
#else
struct Lanes {
    static constexpr int width = 8;
    __m256 v;
    static Lanes all(float x) { return {_mm256_set1_ps(x)}; }
    static Lanes load(const float* p) { return {_mm256_loadu_ps(p)}; }
    void store(float* p) const { _mm256_storeu_ps(p, v); }
    friend Lanes operator-(Lanes a, Lanes b) { return {_mm256_sub_ps(a.v, b.v)}; }
    friend Lanes operator*(Lanes a, Lanes b) { return {_mm256_mul_ps(a.v, b.v)}; }
    static Lanes fma(Lanes a, Lanes b, Lanes c) { return {_mm256_fmadd_ps(a.v, b.v, c.v)}; }
    static Lanes max(Lanes a, Lanes b) { return {_mm256_max_ps(a.v, b.v)}; }
    static Lanes min(Lanes a, Lanes b) { return {_mm256_min_ps(a.v, b.v)}; }
    static unsigned greater(Lanes a, Lanes b) {
        return static_cast<unsigned>(_mm256_movemask_ps(_mm256_cmp_ps(a.v, b.v, _CMP_GT_OQ)));
    }
    static Lanes where_greater(Lanes a, Lanes b, Lanes yes, Lanes no) {
        return {_mm256_blendv_ps(no.v, yes.v, _mm256_cmp_ps(a.v, b.v, _CMP_GT_OQ))};
    }
};
#endif

constexpr int vectors = march_lanes / Lanes::width;

struct Block {
    Lanes up[vectors], tangent[vectors];

    /// Can terrain of this height, at 1/inverse_near or farther, raise any horizon?
    bool matters(float height, float inverse_near) const {
        const Lanes h = Lanes::all(height), inverse = Lanes::all(inverse_near);
        unsigned any = 0;
        for (int v = 0; v < vectors; ++v) {
            any |= Lanes::greater((h - up[v]) * inverse, tangent[v]);
        }
        return any != 0;
    }

    void walk(const float* post, const Crossing* begin, const Crossing* end) {
        for (const Crossing* c = begin; c != end; ++c) {
            const float *first = post + c->first, *second = post + c->second;
            const Lanes weight = Lanes::all(c->weight), inverse = Lanes::all(c->inverse_distance);
            for (int v = 0; v < vectors; ++v) {
                const Lanes low = Lanes::load(first + v * Lanes::width);
                const Lanes high = Lanes::load(second + v * Lanes::width);
                const Lanes height = Lanes::fma(weight, high - low, low);
                tangent[v] = Lanes::max(tangent[v], (height - up[v]) * inverse);
            }
        }
    }

    /// Marks lanes above the limit as finished.
    void settle(Lanes stop) {
        for (int v = 0; v < vectors; ++v) {
            tangent[v] = Lanes::where_greater(tangent[v], stop, Lanes::all(1e30f), tangent[v]);
        }
    }
};

void march(const MarchField& field, const MarchWay& way, const MarchPart& part, float* tangent,
           std::ptrdiff_t tangent_pitch) {
    const bool limited = part.stop < 1e29f;
    const Lanes none = Lanes::all(0.5f * no_ground), never = Lanes::all(-no_ground);
    const Lanes stop = Lanes::all(part.stop), lift = Lanes::all(-part.lift);
    for (int column = part.first_column; column < part.last_column; column += march_lanes) {
        for (int row = part.first_row; row < part.last_row; ++row) {
            const float* post = field.up + row * field.pitch + column;
            Block block;
            for (int v = 0; v < vectors; ++v) {
                const Lanes up = Lanes::load(post + v * Lanes::width);
                block.up[v] = Lanes::where_greater(up, none, up - lift, never);
                block.tangent[v] = Lanes::all(part.start);
            }
            for (int i = 0; i < way.stretches; ++i) {
                const Stretch& s = way.stretch[i];
                if (i > 0) {
                    const int c = column + s.column, r = row + s.row;
                    if (c >= field.columns || c + march_lanes + march_steps < 0 ||
                        r >= field.rows || r + march_steps + 1 < 0) {
                        break;
                    }
                    const float highest = field.window[(r >> 2) * field.window_pitch + (c >> 4)];
                    if (!block.matters(highest, s.inverse_near)) {
                        if (i % 4 == 0 && !block.matters(field.highest, s.inverse_near)) break;
                        continue;
                    }
                }
                block.walk(post, way.crossing + s.begin, way.crossing + s.end);
                if (limited) block.settle(stop);
            }
            const int count = part.last_column - column;
            float* out =
                tangent + (row - part.first_row) * tangent_pitch + column - part.first_column;
            if (count >= march_lanes) {
                for (int v = 0; v < vectors; ++v) {
                    Lanes::min(block.tangent[v], stop).store(out + v * Lanes::width);
                }
            } else {
                float last[march_lanes];
                for (int v = 0; v < vectors; ++v) {
                    Lanes::min(block.tangent[v], stop).store(last + v * Lanes::width);
                }
                for (int k = 0; k < count; ++k) out[k] = last[k];
            }
        }
    }
}

}  // namespace
}  // namespace diurna
