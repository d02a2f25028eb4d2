#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "terrain/objects/file_mesh.hpp"

namespace diurna {

/// Builds a mesh as its file is read: equal places become one vertex, polygons triangles. Places
/// are compared as doubles; vertices that no triangle uses are removed.
class MeshBuilder {
 public:
    /// - name: of the file, in messages
    explicit MeshBuilder(std::string name) : name_(std::move(name)) {}

    /// The part with this name and material, a new one if it does not exist.
    std::uint16_t part(const std::string& node, const std::string& material);
    /// Throws InputError if it is not finite or beyond most_coordinate.
    std::uint32_t vertex(const Eigen::Vector3d& at);
    const Eigen::Vector3d& at(std::uint32_t vertex) const { return mesh_.vertex[vertex]; }
    /// Throws InputError if there are too many.
    void triangle(const std::array<std::uint32_t, 3>& corner, std::uint16_t part);
    /// - where: place of the polygon, for a note if it crosses itself
    void polygon(std::span<const std::uint32_t> corner, std::uint16_t part,
                 const std::string& where);
    void note(const std::string& line);
    void warn(const std::string& line) { mesh_.warnings.push_back(line); }
    /// Declares that the file's numbers have 32 bits, with this largest absolute value.
    void stored_as_float(double largest);

    /// Welds the vertices. Throws InputError if there is no triangle.
    MeshFile finish();

 private:
    struct Hash {
        std::size_t operator()(const std::array<double, 3>& at) const;
    };
    std::string name_;
    MeshFile mesh_;
    std::map<std::pair<std::string, std::string>, std::uint16_t> parts_;
    std::unordered_map<std::array<double, 3>, std::uint32_t, Hash> number_;
    std::size_t crossing_ = 0;  // polygons
    std::string first_crossing_;
    double step_ = 0.0;  // between neighbouring floats of the file
};

}  // namespace diurna
