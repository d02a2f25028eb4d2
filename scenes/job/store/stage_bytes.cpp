#include "scenes/job/store/stage_bytes.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string_view>
#include <type_traits>
#include <utility>

namespace diurna {

namespace {

// `fields` of a type writes and reads it, by one of these.

struct Writer {
    StageContent content{};

    /// Sizes and single values are often of a moment only: copied.
    void piece(const void* from, std::size_t size) {
        constexpr std::size_t small = 64;
        std::string_view bytes(static_cast<const char*>(from), size);
        if (size <= small) bytes = content.small.emplace_back(bytes);
        content.piece.push_back(bytes);
    }
    /// Writes an array's size.
    template <class Array>
    void size(const Array& values) {
        const auto count = std::uint64_t(values.size());
        piece(&count, sizeof count);
    }
};

struct Reader {
    std::string_view bytes;

    void piece(void* to, std::size_t size) {
        if (size > bytes.size()) throw std::runtime_error("too few bytes");
        if (size > 0) std::memcpy(to, bytes.data(), size);
        bytes.remove_prefix(size);
    }
    /// Reads an array's size and gives it that size. Every element takes a byte at least.
    template <class Array>
    void size(Array& values) {
        std::uint64_t count = 0;
        piece(&count, sizeof count);
        if (count > bytes.size()) throw std::runtime_error("too few bytes");
        values.resize(count);
    }
};

template <class Archive, class T>
void one(Archive& archive, T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    archive.piece(&value, sizeof value);
}

/// An array in one piece.
template <class Archive, class Array>
void whole(Archive& archive, Array& values) {
    static_assert(std::is_trivially_copyable_v<typename Array::value_type>);
    archive.size(values);
    archive.piece(values.data(), values.size() * sizeof(typename Array::value_type));
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
    one(archive, row);
    sun.fraction.resize(sun.instant.size() * row);
    for (std::size_t i = 0; i < sun.instant.size(); ++i) {
        const std::span<float> of = std::span(sun.fraction).subspan(i * row, row);
        bool lit = std::any_of(of.begin(), of.end(), [](float share) { return share != 0.0f; });
        one(archive, lit);
        if (lit) archive.piece(of.data(), of.size_bytes());
    }
}

template <class Archive>
void fields(Archive& archive, FoundHeat& heat) {
    TemperatureField& field = heat.temperature;
    auto facets = std::uint64_t(field.facets);
    one(archive, facets);
    field.facets = facets;
    whole(archive, field.instant);
    whole(archive, field.kelvin);
    whole(archive, field.water.facet);
    whole(archive, field.water.cover);
    whole(archive, field.solved_as);
    one(archive, field.representative_rms);
    archive.size(heat.reported);
    for (auto& [name, text] : heat.reported) {
        whole(archive, name);
        whole(archive, text);
    }
}

template <class T>
StageContent written(const T& what) {
    Writer archive;
    fields(archive, const_cast<T&>(what));  // one template reads and writes; a writer only reads
    return std::move(archive.content);
}

template <class T>
T read(const std::string& bytes) {
    Reader archive{bytes};
    T what{};
    fields(archive, what);
    return what;
}

}  // namespace

StageContent content_of(const FacetViews& views) { return written(views); }
StageContent content_of(const SunExposure& sun) { return written(sun); }
StageContent content_of(const FoundHeat& heat) { return written(heat); }

FacetViews views_of(const std::string& bytes) { return read<FacetViews>(bytes); }
SunExposure sun_of(const std::string& bytes) { return read<SunExposure>(bytes); }
FoundHeat heat_of(const std::string& bytes) { return read<FoundHeat>(bytes); }

}  // namespace diurna
