#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

#include "materials/base/error.hpp"
#include "terrain/objects/mesh_builder.hpp"
#include "terrain/objects/mesh_readers.hpp"
#include "terrain/objects/mesh_words.hpp"
#include "terrain/objects/ply_head.hpp"

namespace diurna {

namespace {

void check_count(const std::string& where, double count, const PlyProperty& property) {
    const double least = property.corners ? 3 : 0;
    if (count >= least && count <= (property.corners ? most_corners : 1e9)) return;
    throw InputError(
        where,
        fmt::format("found a list {} of {:g}, expected at least {:g}{}", property.name, count,
                    least, property.corners ? fmt::format(", at most {}", most_corners) : ""));
}

void check_value(const std::string& where, double value, const PlyProperty& property,
                 const PlyHead& head) {
    if (property.axis >= 0 && !(std::abs(value) <= most_coordinate)) {
        throw InputError(where, fmt::format("found {} = {:g}", property.name, value));
    }
    const bool whole = value == std::floor(value);
    if (property.strip && value == -1.0) return;
    if ((property.corners || property.strip) &&
        !(whole && value >= 0.0 && value < double(head.vertices))) {
        throw InputError(
            where, fmt::format("found corner {:g}, expected 0 to {}", value, head.vertices - 1));
    }
}

/// What the rows say: places, and corners of faces one after the other.
struct Rows {
    std::vector<Eigen::Vector3d> place;
    std::vector<std::uint32_t> corner;
    std::vector<std::size_t> end;  // (face) in `corner`

    void begin(const PlyElement& element) {
        if (element.name == "vertex") place.emplace_back(Eigen::Vector3d::Zero());
    }
    void take(const PlyProperty& property, double value) {
        if (property.axis >= 0) place.back()[property.axis] = value;
        if (property.corners) corner.push_back(static_cast<std::uint32_t>(value));
        if (property.strip) take_of_strip(value);
    }
    void finish(const PlyElement& element) {
        if (element.name == "face") end.push_back(corner.size());
        if (element.name == "tristrips") strip.clear();
    }

 private:
    std::vector<std::uint32_t> strip;  // as far as it goes

    /// Each corner after the second makes a triangle with the two before, turned by turns; one with
    /// a corner twice only joins strips.
    void take_of_strip(double value) {
        if (value < 0.0) return strip.clear();
        strip.push_back(static_cast<std::uint32_t>(value));
        const std::size_t n = strip.size();
        if (n < 3) return;
        std::uint32_t a = strip[n - 3], b = strip[n - 2], c = strip[n - 1];
        if (a == b || b == c || a == c) return;
        if (n % 2 == 0) std::swap(a, b);
        corner.insert(corner.end(), {a, b, c});
        end.push_back(corner.size());
    }
};

void read_text_row(MeshLines& lines, const PlyElement& element, const PlyHead& head, Rows& rows) {
    do {
        if (!lines.next()) {
            throw InputError(lines.where(),
                             fmt::format("ends within {} of {}", element.rows, element.name));
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
    for (const PlyProperty& property : element.property) {
        double count = 1.0;
        if (property.list) check_count(lines.where(), count = next(), property);
        for (double i = 0.0; i < count; ++i) {
            const double value = next();
            if (property.axis >= 0 || property.corners || property.strip) {
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

    double next(PlyType type) {
        switch (type) {
            case PlyType::int8:
                return double(take<std::int8_t>());
            case PlyType::uint8:
                return double(take<std::uint8_t>());
            case PlyType::int16:
                return double(take<std::int16_t>());
            case PlyType::uint16:
                return double(take<std::uint16_t>());
            case PlyType::int32:
                return double(take<std::int32_t>());
            case PlyType::uint32:
                return double(take<std::uint32_t>());
            case PlyType::float32:
                return double(take<float>());
            case PlyType::float64:
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
        throw InputError(name_, "is truncated: it has fewer rows than its header declares",
                         "copy the file again");
    }

    const std::string& name_;
    std::string_view rest_;
    bool big_;
};

void read_binary_row(Bytes& bytes, const std::string& where, const PlyElement& element,
                     const PlyHead& head, Rows& rows) {
    for (const PlyProperty& property : element.property) {
        double count = 1.0;
        if (property.list) check_count(where, count = bytes.next(property.count), property);
        if (property.axis < 0 && !property.corners && !property.strip) {
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
bool has_float_places(const PlyHead& head) {
    for (const PlyElement& element : head.element) {
        for (const PlyProperty& property : element.property) {
            if (property.axis >= 0 && property.type == PlyType::float32 && !head.text) return true;
        }
    }
    return false;
}

}  // namespace

MeshFile read_ply(const std::string& name, std::string_view text) {
    MeshLines lines(name, text);
    const PlyHead head = read_ply_head(name, lines, text.size());
    Bytes bytes(name, lines.rest(), head.big);
    Rows rows;
    for (const PlyElement& element : head.element) {
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
