#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <vector>

#include "materials/base/error.hpp"
#include "terrain/objects/mesh_builder.hpp"
#include "terrain/objects/mesh_readers.hpp"
#include "terrain/objects/mesh_words.hpp"

namespace diurna {

namespace {

enum class Type { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

struct Property {
    std::string name;
    Type type{};  // of a list its elements'
    bool list = false;
    Type count{};          // of a list
    int axis = -1;         // 0 to 2: x, y or z of a vertex
    bool corners = false;  // the corners of a face
};

struct Element {
    std::string name;
    std::size_t rows = 0;
    std::vector<Property> property;
};

struct Head {
    std::vector<Element> element;
    bool text = false, big = false;  // big: the greatest byte first
    long long vertices = 0;
};

std::size_t bytes_of(Type type) {
    constexpr std::size_t size[] = {1, 1, 2, 2, 4, 4, 4, 8};
    return size[std::size_t(type)];
}

Type type_named(const MeshLines& lines, std::string_view word) {
    static const std::map<std::string_view, Type> named{
        {"char", Type::int8},      {"int8", Type::int8},       {"uchar", Type::uint8},
        {"uint8", Type::uint8},    {"short", Type::int16},     {"int16", Type::int16},
        {"ushort", Type::uint16},  {"uint16", Type::uint16},   {"int", Type::int32},
        {"int32", Type::int32},    {"uint", Type::uint32},     {"uint32", Type::uint32},
        {"float", Type::float32},  {"float32", Type::float32}, {"double", Type::float64},
        {"float64", Type::float64}};
    const auto found = named.find(word);
    if (found != named.end()) return found->second;
    throw InputError(lines.where(), fmt::format("found type '{}', expected one of PLY's, such as "
                                                "float",
                                                word.substr(0, 40)));
}

Property read_property(const MeshLines& lines, const std::string& element) {
    const auto& words = lines.words();
    const bool list = words.size() == 5 && words[1] == "list";
    if (!list && words.size() != 3) {
        throw InputError(lines.where(),
                         "expected property TYPE NAME, or property list TYPE TYPE "
                         "NAME");
    }
    Property property{.name = std::string(words.back()),
                      .type = type_named(lines, words[list ? 3 : 1]),
                      .list = list};
    if (list) property.count = type_named(lines, words[2]);
    const std::string& name = property.name;
    if (element == "vertex" && !list && name.size() == 1 && name[0] >= 'x' && name[0] <= 'z') {
        property.axis = name[0] - 'x';
    }
    property.corners =
        element == "face" && list && (name == "vertex_indices" || name == "vertex_index");
    return property;
}

/// Reads on to the line end_header.
Head read_head(MeshLines& lines, std::size_t bytes) {
    Head head;
    bool format = false;
    if (!lines.next() || lines.words().size() != 1 || lines.words()[0] != "ply") {
        throw InputError(lines.where(), "expected a line 'ply'");
    }
    while (lines.next()) {
        const auto& words = lines.words();
        if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
        if (words[0] == "end_header") {
            if (!format) throw InputError(lines.where(), "no line 'format' above it");
            return head;
        }
        if (words[0] == "format" && words.size() == 3) {
            head.text = words[1] == "ascii";
            head.big = words[1] == "binary_big_endian";
            format = head.text || head.big || words[1] == "binary_little_endian";
            if (!format) {
                throw InputError(lines.where(), fmt::format("found format '{}'", words[1]),
                                 "ascii, binary_little_endian or binary_big_endian");
            }
        } else if (words[0] == "element" && words.size() == 3) {
            const long long rows = lines.whole(words[2]);
            if (rows < 0 || std::size_t(rows) > bytes) {
                throw InputError(lines.where(),
                                 fmt::format("claims {} of {}, but the file has {} bytes", rows,
                                             words[1], bytes));
            }
            for (const Element& other : head.element) {
                if (other.name != words[1]) continue;
                throw InputError(lines.where(), fmt::format("element {} stands above, too",
                                                            words[1].substr(0, 40)));
            }
            head.element.push_back({std::string(words[1]), std::size_t(rows), {}});
            if (words[1] == "vertex") head.vertices = rows;
        } else if (words[0] == "property" && !head.element.empty()) {
            Element& element = head.element.back();
            element.property.push_back(read_property(lines, element.name));
        } else {
            throw InputError(lines.where(), fmt::format("found '{}' in the head of a PLY file",
                                                        words[0].substr(0, 40)));
        }
    }
    throw InputError(lines.where(), "no line 'end_header'");
}

/// Vertices have a place and faces corners.
void check_head(const std::string& name, const Head& head) {
    const auto with = [&](const char* element, auto&& is) {
        std::ptrdiff_t count = 0;
        for (const Element& e : head.element) {
            if (e.name != element) continue;
            count += std::count_if(e.property.begin(), e.property.end(), is);
        }
        return count;
    };
    if (with("vertex", [](const Property& p) { return p.axis >= 0; }) != 3) {
        throw InputError(name, "its vertices have not x, y and z once each");
    }
    if (with("face", [](const Property& p) { return p.corners; }) != 1) {
        throw InputError(name, "its faces have not one list vertex_indices");
    }
}

void check_count(const std::string& where, double count, const Property& property) {
    const double least = property.corners ? 3 : 0;
    if (count >= least && count <= (property.corners ? most_corners : 1e9)) return;
    throw InputError(
        where,
        fmt::format("found a list {} of {:g}, expected {:g} or more{}", property.name, count, least,
                    property.corners ? fmt::format(", {} at most", most_corners) : ""));
}

void check_value(const std::string& where, double value, const Property& property,
                 const Head& head) {
    if (property.axis >= 0 && !(std::abs(value) <= most_coordinate)) {
        throw InputError(where, fmt::format("found {} = {:g}", property.name, value));
    }
    const bool whole = value == std::floor(value);
    if (property.corners && !(whole && value >= 0.0 && value < double(head.vertices))) {
        throw InputError(
            where, fmt::format("found corner {:g}, expected 0 to {}", value, head.vertices - 1));
    }
}

/// What the rows say: places, and corners of faces one after the other.
struct Rows {
    std::vector<Eigen::Vector3d> place;
    std::vector<std::uint32_t> corner;
    std::vector<std::size_t> end;  // (face) in `corner`

    void begin(const Element& element) {
        if (element.name == "vertex") place.emplace_back(Eigen::Vector3d::Zero());
    }
    void take(const Property& property, double value) {
        if (property.axis >= 0) place.back()[property.axis] = value;
        if (property.corners) corner.push_back(static_cast<std::uint32_t>(value));
    }
    void finish(const Element& element) {
        if (element.name == "face") end.push_back(corner.size());
    }
};

void read_text_row(MeshLines& lines, const Element& element, const Head& head, Rows& rows) {
    do {
        if (!lines.next()) {
            throw InputError(lines.where(),
                             fmt::format("ends within its {} of {}", element.rows, element.name));
        }
    } while (lines.words().empty());
    const auto& words = lines.words();
    std::size_t at = 0;
    const auto next = [&] {
        if (at >= words.size()) {
            throw InputError(lines.where(), fmt::format("found {} numbers, expected more", at));
        }
        return lines.coordinate(words[at++]);
    };
    for (const Property& property : element.property) {
        double count = 1.0;
        if (property.list) check_count(lines.where(), count = next(), property);
        for (double i = 0.0; i < count; ++i) {
            const double value = next();
            if (property.axis >= 0 || property.corners) {
                check_value(lines.where(), value, property, head);
            }
            rows.take(property, value);
        }
    }
    if (at != words.size()) {
        throw InputError(lines.where(),
                         fmt::format("found {} numbers, expected {}", words.size(), at));
    }
}

/// Numbers one after the other.
class Bytes {
 public:
    Bytes(const std::string& name, std::string_view rest, bool big)
        : name_(name), rest_(rest), big_(big) {}

    double next(Type type) {
        switch (type) {
            case Type::int8:
                return double(take<std::int8_t>());
            case Type::uint8:
                return double(take<std::uint8_t>());
            case Type::int16:
                return double(take<std::int16_t>());
            case Type::uint16:
                return double(take<std::uint16_t>());
            case Type::int32:
                return double(take<std::int32_t>());
            case Type::uint32:
                return double(take<std::uint32_t>());
            case Type::float32:
                return double(take<float>());
            case Type::float64:
                return take<double>();
        }
        return 0.0;
    }
    void skip(std::size_t bytes) {
        check(bytes);
        rest_.remove_prefix(bytes);
    }

 private:
    template <class T>
    T take() {
        check(sizeof(T));
        char bytes[sizeof(T)];
        std::memcpy(bytes, rest_.data(), sizeof bytes);
        if (big_ != (std::endian::native == std::endian::big))
            std::reverse(bytes, bytes + sizeof bytes);
        rest_.remove_prefix(sizeof bytes);
        T value;
        std::memcpy(&value, bytes, sizeof value);
        return value;
    }
    void check(std::size_t bytes) const {
        if (bytes <= rest_.size()) return;
        throw InputError(name_, "ends before the rows that its head claims", "is it whole?");
    }

    const std::string& name_;
    std::string_view rest_;
    bool big_;
};

void read_binary_row(Bytes& bytes, const std::string& where, const Element& element,
                     const Head& head, Rows& rows) {
    for (const Property& property : element.property) {
        double count = 1.0;
        if (property.list) check_count(where, count = bytes.next(property.count), property);
        if (property.axis < 0 && !property.corners) {
            bytes.skip(std::size_t(count) * bytes_of(property.type));
            continue;
        }
        for (double i = 0.0; i < count; ++i) {
            const double value = bytes.next(property.type);
            check_value(where, value, property, head);
            rows.take(property, value);
        }
    }
}

/// Whether places are of 32 bits, or of fewer.
bool has_float_places(const Head& head) {
    for (const Element& element : head.element) {
        for (const Property& property : element.property) {
            if (property.axis >= 0 && property.type == Type::float32 && !head.text) return true;
        }
    }
    return false;
}

}  // namespace

MeshFile read_ply(const std::string& name, std::string_view text) {
    MeshLines lines(name, text);
    const Head head = read_head(lines, text.size());
    check_head(name, head);
    Bytes bytes(name, lines.rest(), head.big);
    Rows rows;
    for (const Element& element : head.element) {
        if (element.property.empty()) continue;
        for (std::size_t row = 0; row < element.rows; ++row) {
            rows.begin(element);
            if (head.text) {
                read_text_row(lines, element, head, rows);
            } else {
                read_binary_row(bytes, name, element, head, rows);
            }
            rows.finish(element);
        }
    }
    MeshBuilder mesh(name);
    const std::uint16_t part = mesh.part("", "");
    std::vector<std::uint32_t> corner;
    std::size_t at = 0;
    for (std::size_t face = 0; face < rows.end.size(); ++face) {
        corner.clear();
        for (; at < rows.end[face]; ++at)
            corner.push_back(mesh.vertex(rows.place[rows.corner[at]]));
        mesh.polygon(corner, part, fmt::format("face {}", face));
    }
    if (has_float_places(head)) {
        double largest = 0.0;
        for (const Eigen::Vector3d& place : rows.place) {
            largest = std::max(largest, place.cwiseAbs().maxCoeff());
        }
        mesh.stored_as_float(largest);
    }
    return mesh.finish();
}

}  // namespace diurna
