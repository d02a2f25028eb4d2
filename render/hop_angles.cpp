#include "render/hop_angles.hpp"

#include "materials/planck.hpp"
#include "terrain/parallel.hpp"

namespace diurna {

namespace {

bool is_flat(const Spectrum& s) {
    return std::all_of(s.value.begin(), s.value.end(),
                       [&](double x) { return x == s.value.front(); });
}

}  // namespace

AngleTable::AngleTable(const Material& material, const Band& band, const Channels& channels,
                       double temperature)
    : padded_(channels.padded()) {
    values_.assign(nodes * parts * padded_, 0.0f);
    hemisphere_.assign(padded_, 0.0f);
    std::vector<double> shape(band.node_um.size());
    for (std::size_t n = 0; n < shape.size(); ++n) {
        shape[n] = band.weight[n] * planck(band.node_um[n], temperature) + 1e-300;
    }
    // An index of refraction that is one number everywhere is looked up once.
    const auto* glossy = std::get_if<Glossy>(&material.finish);
    std::vector<double> known;
    if (glossy && (glossy->metal || (is_flat(glossy->index) && is_flat(glossy->extinction)))) {
        known.resize(nodes);
        for_each_index(
            nodes,
            [&](std::size_t k) {
                known[k] = interface_reflectance(material.finish, band.node_um[0], cosine(k));
            },
            1);
    }
    for_each_index(
        channels.size(),
        [&](std::size_t c) {
            double total = 0.0;
            for (std::size_t n = channels.first[c]; n < channels.first[c + 1]; ++n) {
                total += shape[n];
            }
            // An index of refraction is one number in a channel.
            const double middle = band.node_um[(channels.first[c] + channels.first[c + 1]) / 2];
            const double normal = interface_reflectance(material.finish, middle, laboratory_cosine);
            for (std::size_t k = 0; k < nodes; ++k) {
                const double here = known.empty()
                                        ? interface_reflectance(material.finish, middle, cosine(k))
                                        : known[k];
                float* at = &values_[k * parts * padded_ + c];
                for (std::size_t n = channels.first[c]; n < channels.first[c + 1]; ++n) {
                    const double share = shape[n] / total;
                    const DirectionalOptics o =
                        directional_optics(material, band.node_um[n], cosine(k), here, normal);
                    at[0] += static_cast<float>(share * o.mirrored);
                    at[padded_] += static_cast<float>(share * o.diffuse);
                    at[2 * padded_] += static_cast<float>(share * o.transmittance);
                }
            }
            // ∫ diffuse 2 cosθ d cosθ with cosθ = u², nodes equal in u.
            for (std::size_t k = 0; k < nodes; ++k) {
                const double u = double(k) / double(nodes - 1);
                const double ends = k == 0 || k + 1 == nodes ? 0.5 : 1.0;
                hemisphere_[c] += static_cast<float>(ends * 4.0 * u * u * u / double(nodes - 1)) *
                                  values_[(k * parts + 1) * padded_ + c];
            }
        },
        1);
    if (glossy) roughness = glossy->roughness;
}

}  // namespace diurna
