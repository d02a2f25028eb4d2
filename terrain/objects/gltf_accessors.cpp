#include "terrain/objects/gltf_accessors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "materials/base/error.hpp"

namespace diurna {

namespace {

using Json = nlohmann::json;

struct Kind {
    const char* name;
    int numbers;
};
constexpr std::array<Kind, 7> kinds{
    {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT2", 4}, {"MAT3", 9}, {"MAT4", 16}}};
struct Component {
    int type;
    int bytes;
    double most;  // of a whole number
};
constexpr std::array<Component, 6> components{{{5120, 1, 127.0},
                                               {5121, 1, 255.0},
                                               {5122, 2, 32767.0},
                                               {5123, 2, 65535.0},
                                               {5125, 4, 4294967295.0},
                                               {5126, 4, 0.0}}};
constexpr double most_without_data = 1e8;  // bytes of zeros
constexpr double most_work = 3e8;          // numbers; a file may name the same ones many times

static_assert(std::endian::native == std::endian::little,
              "glTF data are read without conversion of byte order");

int numbers_of(const Gltf& gltf, const Json& accessor, const std::string& where) {
    const Json& type = Gltf::member(accessor, "type");
    for (const Kind& kind : kinds) {
        if (type.is_string() && type.get_ref<const std::string&>() == kind.name)
            return kind.numbers;
    }
    throw gltf.fault(where, "has an unknown type: " + Gltf::shown(type));
}

const Component& component_of(const Gltf& gltf, const Json& of, const std::string& where) {
    const Json& type = Gltf::member(of, "componentType");
    for (const Component& component : components) {
        if (type.is_number_unsigned() && type.get<std::size_t>() == std::size_t(component.type)) {
            return component;
        }
    }
    throw gltf.fault(where, "has an unknown component type: " + Gltf::shown(type));
}

template <class T>
double value_at(const char* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return double(value);
}

double number_at(const char* bytes, int type) {
    switch (type) {
        case 5120:
            return value_at<std::int8_t>(bytes);
        case 5121:
            return value_at<std::uint8_t>(bytes);
        case 5122:
            return value_at<std::int16_t>(bytes);
        case 5123:
            return value_at<std::uint16_t>(bytes);
        case 5125:
            return value_at<std::uint32_t>(bytes);
        default:
            return value_at<float>(bytes);
    }
}

void check_fit(const Gltf& gltf, const std::string& where, double from, double count, double stride,
               double element, double length) {
    if (stride < element) {
        throw gltf.fault(
            where,
            fmt::format("has a stride of {:.0f} bytes, expected at least {:.0f}", stride, element));
    }
    if (from + (count - 1.0) * stride + element > length) {
        throw gltf.fault(where, fmt::format("declares {:.0f} elements, but has only {:.0f} bytes",
                                            count, length));
    }
}

/// Where the numbers of a view lie.
struct Layout {
    std::string_view bytes;
    std::size_t from, stride;
};

}  // namespace

GltfAccessors::GltfAccessors(const Gltf& gltf, GltfBuffers& buffers)
    : gltf_(gltf), buffers_(buffers) {
    const Json &accessors = gltf.list("accessors"), &views = gltf.list("bufferViews");
    for (std::size_t i = 0; i < accessors.size(); ++i) {
        const std::string where = fmt::format("accessors[{}]", i);
        const Json &one = accessors[i], &view = Gltf::member(one, "bufferView");
        const double element = double(numbers_of(gltf, one, where)) *
                               component_of(gltf, one, where).bytes,
                     count = gltf.size(Gltf::member(one, "count"), 0.0, where),
                     from = gltf.size(Gltf::member(one, "byteOffset"), 0.0, where);
        if (count < 1.0) throw gltf.fault(where, "has no elements, expected vertices or indices");
        if (view.is_null()) {
            if (count * element > most_without_data) {
                throw gltf.fault(where,
                                 fmt::format("declares {:.0f} elements, but has no data", count));
            }
            continue;
        }
        const Json& in = views[gltf.index(view, views.size(), where)];
        check_fit(gltf, where, from, count,
                  gltf.size(Gltf::member(in, "byteStride"), element, where), element,
                  gltf.size(Gltf::member(in, "byteLength"), 0.0, where));
    }
}

int GltfAccessors::component_type(std::size_t accessor) const {
    return component_of(gltf_, gltf_.list("accessors")[accessor], "accessors").type;
}

void GltfAccessors::count_work(double numbers) {
    work_ += numbers;
    if (work_ > most_work) {
        throw InputError(gltf_.name(),
                         fmt::format("its meshes have more than {:g} numbers", most_work));
    }
}

std::vector<double> GltfAccessors::numbers(std::size_t accessor, const char* kind,
                                           const std::string& user) {
    const Json& one = gltf_.list("accessors")[accessor];
    const std::string where = fmt::format("accessors[{}]", accessor);
    if (Gltf::shown(Gltf::member(one, "type")) != fmt::format("\"{}\"", kind)) {
        throw gltf_.fault(user, fmt::format("found {} of {}, expected {}", where,
                                            Gltf::shown(Gltf::member(one, "type")), kind));
    }
    const int per_element = numbers_of(gltf_, one, where);
    const Component& component = component_of(gltf_, one, where);
    const auto count = std::size_t(gltf_.size(Gltf::member(one, "count"), 0.0, where));
    count_work(double(count) * per_element);
    std::vector<double> number(count * std::size_t(per_element), 0.0);
    const Json& view = Gltf::member(one, "bufferView");
    if (!view.is_null()) {
        const Json& in = gltf_.list("bufferViews")[view.get<std::size_t>()];
        const std::string_view bytes = buffers_.view(view.get<std::size_t>());
        const auto from = std::size_t(gltf_.size(Gltf::member(one, "byteOffset"), 0.0, where));
        const auto stride = std::size_t(gltf_.size(Gltf::member(in, "byteStride"),
                                                   double(per_element * component.bytes), where));
        for (std::size_t i = 0; i < count; ++i) {
            for (int k = 0; k < per_element; ++k) {
                number[i * std::size_t(per_element) + std::size_t(k)] =
                    number_at(bytes.data() + from + i * stride + std::size_t(k * component.bytes),
                              component.type);
            }
        }
    }
    put_sparse(one, per_element, count, where, number);
    const Json& normalized = Gltf::member(one, "normalized");
    if (normalized.is_boolean() && normalized.get<bool>() && component.most > 0.0) {
        for (double& value : number) value = std::max(value / component.most, -1.0);
    }
    return number;
}

void GltfAccessors::put_sparse(const Json& accessor, int per_element, std::size_t count,
                               const std::string& of, std::vector<double>& number) {
    const Json& sparse = Gltf::member(accessor, "sparse");
    if (sparse.is_null()) return;
    const std::string where = of + ".sparse";
    const Json &indices = Gltf::member(sparse, "indices"), &values = Gltf::member(sparse, "values"),
               &views = gltf_.list("bufferViews");
    const double some = gltf_.size(Gltf::member(sparse, "count"), 0.0, where);
    if (some < 1.0 || some > double(count)) {
        throw gltf_.fault(where,
                          fmt::format("found {:.0f} elements, expected 1 to {}", some, count));
    }
    const Component &type = component_of(gltf_, indices, where + ".indices"),
                    &value = component_of(gltf_, accessor, of);
    const auto layout = [&](const Json& part, const char* key, double element) {
        const std::size_t view =
            gltf_.index(Gltf::member(part, "bufferView"), views.size(), where + key);
        const double from = gltf_.size(Gltf::member(part, "byteOffset"), 0.0, where + key);
        const std::string_view bytes = buffers_.view(view);
        check_fit(gltf_, where + key, from, some, element, element, double(bytes.size()));
        return Layout{bytes, std::size_t(from), std::size_t(element)};
    };
    const Layout which = layout(indices, ".indices", type.bytes),
                 what = layout(values, ".values", double(per_element) * value.bytes);
    for (std::size_t i = 0; i < std::size_t(some); ++i) {
        const double at = number_at(which.bytes.data() + which.from + i * which.stride, type.type);
        if (!(at >= 0.0 && at < double(count))) {
            throw gltf_.fault(where + ".indices",
                              fmt::format("found index {:g}, expected 0 to {}", at, count - 1));
        }
        for (int k = 0; k < per_element; ++k) {
            number[std::size_t(at) * std::size_t(per_element) + std::size_t(k)] = number_at(
                what.bytes.data() + what.from + i * what.stride + std::size_t(k * value.bytes),
                value.type);
        }
    }
}

std::vector<std::uint32_t> GltfAccessors::indices(std::size_t accessor, const std::string& where) {
    const int type = component_type(accessor);
    if (type != 5121 && type != 5123 && type != 5125) {
        throw gltf_.fault(where, "are not whole numbers from 0");
    }
    std::vector<std::uint32_t> index;
    for (const double value : numbers(accessor, "SCALAR", where)) {
        index.push_back(static_cast<std::uint32_t>(value));
    }
    return index;
}

}  // namespace diurna
