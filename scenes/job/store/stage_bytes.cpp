#include "scenes/job/store/stage_bytes.hpp"

#include <algorithm>
#include <cereal/archives/binary.hpp>
#include <cereal/types/string.hpp>
#include <cereal/types/utility.hpp>
#include <cereal/types/vector.hpp>
#include <cstdint>
#include <span>
#include <sstream>
#include <type_traits>

namespace diurna {

namespace {

/// An array in one piece.
template <class Archive, class T>
void whole(Archive& archive, std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T>);
    auto size = std::uint64_t(values.size());
    archive(size);
    values.resize(size);
    archive(cereal::binary_data(values.data(), values.size() * sizeof(T)));
}

template <class Archive>
void rows(Archive& archive, ViewFactors& factors) {
    whole(archive, factors.row);
    whole(archive, factors.facet);
    whole(archive, factors.factor);
}

template <class Archive>
void fields(Archive& archive, FacetViews& views) {
    whole(archive, views.sky);
    whole(archive, views.below);
    rows(archive, views.others);
    whole(archive, views.hidden);
    whole(archive, views.rays);
    whole(archive, views.shares);
    whole(archive, views.buried);
    rows(archive, views.copied);
}

/// Of instants with the sun down nothing but that.
template <class Archive>
void fields(Archive& archive, SunExposure& sun) {
    whole(archive, sun.instant);
    whole(archive, sun.edge);
    const std::size_t facets = sun.instant.empty() ? 0 : sun.fraction.size() / sun.instant.size();
    auto row = std::uint64_t(facets);
    archive(row);
    sun.fraction.resize(sun.instant.size() * row);
    for (std::size_t i = 0; i < sun.instant.size(); ++i) {
        const std::span<float> of = std::span(sun.fraction).subspan(i * row, row);
        bool lit = std::any_of(of.begin(), of.end(), [](float share) { return share != 0.0f; });
        archive(lit);
        if (lit) archive(cereal::binary_data(of.data(), of.size_bytes()));
    }
}

template <class Archive>
void fields(Archive& archive, FoundHeat& heat) {
    TemperatureField& field = heat.temperature;
    auto facets = std::uint64_t(field.facets);
    archive(facets);
    field.facets = facets;
    whole(archive, field.instant);
    whole(archive, field.kelvin);
    whole(archive, field.water.facet);
    whole(archive, field.water.cover);
    whole(archive, field.solved_as);
    archive(field.representative_rms);
    archive(heat.reported);
}

template <class T>
std::string written(T what) {  // a copy, for one template reads and writes
    std::ostringstream stream(std::ios::binary);
    cereal::BinaryOutputArchive archive(stream);
    fields(archive, what);
    return std::move(stream).str();
}

template <class T>
T read(const std::string& bytes) {
    std::istringstream stream(bytes, std::ios::binary);
    cereal::BinaryInputArchive archive(stream);
    T what{};
    fields(archive, what);
    return what;
}

}  // namespace

std::string bytes_of(const FacetViews& views) { return written(views); }
std::string bytes_of(const SunExposure& sun) { return written(sun); }
std::string bytes_of(const FoundHeat& heat) { return written(heat); }

FacetViews views_of(const std::string& bytes) { return read<FacetViews>(bytes); }
SunExposure sun_of(const std::string& bytes) { return read<SunExposure>(bytes); }
FoundHeat heat_of(const std::string& bytes) { return read<FoundHeat>(bytes); }

}  // namespace diurna
