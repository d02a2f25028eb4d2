#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "terrain/objects/gltf_buffers.hpp"

namespace diurna {

/// Reads the numbers of accessors, of all component types, interleaved, sparse or without a view.
class GltfAccessors {
 public:
    /// Throws InputError where an accessor is of no known type or claims more than its view holds.
    GltfAccessors(const Gltf& gltf, GltfBuffers& buffers);

    /// Element by element, each of `numbers` numbers; whole ones that are said to be normalized as
    /// shares of their range (glTF 2.0, 3.6.2.2).
    ///
    /// - kind: "SCALAR", "VEC3" or "VEC4", which it must be
    /// - where: who uses it, in messages
    std::vector<double> numbers(std::size_t accessor, const char* kind, const std::string& where);
    /// The same of whole numbers from 0.
    std::vector<std::uint32_t> indices(std::size_t accessor, const std::string& where);
    /// 5120 int8, 5121 uint8, 5122 int16, 5123 uint16, 5125 uint32, 5126 float
    int component_type(std::size_t accessor) const;

 private:
    void put_sparse(const nlohmann::json& accessor, int per_element, std::size_t count,
                    const std::string& where, std::vector<double>& number);
    void count_work(double numbers);

    const Gltf& gltf_;
    GltfBuffers& buffers_;
    double work_ = 0.0;  // numbers read so far
};

}  // namespace diurna
