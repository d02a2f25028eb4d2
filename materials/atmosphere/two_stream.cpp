#include "materials/atmosphere/two_stream.hpp"

#include <algorithm>
#include <cmath>

namespace diurna {

DiffuseFlux two_stream(std::span<const ScatteringLayer> layers, double sun_cosine, double albedo,
                       double down_at_top) {
    struct Response {
        double reflect, transmit;  // of diffuse light
        double up, down;           // from the beam, out of its top and bottom
    };
    const std::size_t count = layers.size();
    std::vector<Response> response(count);
    for (std::size_t i = 0; i < count; ++i) {
        const ScatteringLayer& layer = layers[i];
        // Above 1 - 1e-9 the root vanishes and the forms below lose their meaning.
        const double w = std::min(layer.single_albedo, 1.0 - 1e-9), g = layer.asymmetry;
        const double g1 = 0.25 * (7.0 - w * (4.0 + 3.0 * g));
        // Eddington's streams reflect less than nothing where little is scattered at all.
        const double g2 = std::max(0.0, -0.25 * (1.0 - w * (4.0 - 3.0 * g)));
        const double g3 = 0.25 * (2.0 - 3.0 * g * sun_cosine), g4 = 1.0 - g3;
        const double root = std::sqrt(std::max(g1 * g1 - g2 * g2, 1e-18));
        const double ratio = g2 / (g1 + root);
        const double fade = std::exp(-root * layer.depth);
        const double denominator = 1.0 - ratio * ratio * fade * fade;
        Response& r = response[i];
        r.reflect = ratio * (1.0 - fade * fade) / denominator;
        r.transmit = fade * (1.0 - ratio * ratio) / denominator;
        r.up = r.down = 0.0;
        if (layer.beam_in <= 0.0 || layer.depth <= 0.0) continue;
        // The beam's rate of fading; where it equals the diffuse one the forms are moved aside.
        double k = std::log(layer.beam_in / std::max(layer.beam_out, 1e-300)) / layer.depth;
        k = std::clamp(k, 0.0, 200.0);
        if (std::abs(k - root) < 1e-3 * root) k = root * (1.0 + 1e-3);
        const double scale = w / (root * root - k * k);
        const double to_up = scale * (g3 * (g1 - k) + g2 * g4);
        const double to_down = scale * (g4 * (g1 + k) + g2 * g3);
        const double out = layer.beam_in * std::exp(-k * layer.depth);
        r.up =
            to_up * layer.beam_in - r.reflect * to_down * layer.beam_in - r.transmit * to_up * out;
        r.down = to_down * out - r.transmit * to_down * layer.beam_in - r.reflect * to_up * out;
    }
    // Reflectance and glow of all below each level, from the ground up.
    std::vector<double> reflect(count + 1), glow(count + 1);
    reflect[count] = albedo;
    glow[count] = count > 0 ? albedo * sun_cosine * layers[count - 1].beam_out : 0.0;
    for (std::size_t i = count; i-- > 0;) {
        const Response& r = response[i];
        const double between = 1.0 / (1.0 - r.reflect * reflect[i + 1]);
        glow[i] = r.up + r.transmit * between * (glow[i + 1] + reflect[i + 1] * r.down);
        reflect[i] = r.reflect + r.transmit * r.transmit * between * reflect[i + 1];
    }
    DiffuseFlux flux{std::vector<double>(count + 1), std::vector<double>(count + 1)};
    flux.down[0] = down_at_top;
    flux.up[0] = glow[0] + reflect[0] * down_at_top;
    for (std::size_t i = 0; i < count; ++i) {
        const Response& r = response[i];
        const double between = 1.0 / (1.0 - r.reflect * reflect[i + 1]);
        flux.down[i + 1] = between * (r.transmit * flux.down[i] + r.down + r.reflect * glow[i + 1]);
        flux.up[i + 1] = glow[i + 1] + reflect[i + 1] * flux.down[i + 1];
    }
    return flux;
}

}  // namespace diurna
