#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "terrain/objects/gltf_buffers.hpp"

namespace diurna {

/// Reads the numbers of accessors, of all component types, interleaved, sparse or without a view.
class GltfAccessors {
 public:
    /// Throws InputError if an accessor has an unknown type or claims more than its view holds.
    GltfAccessors(const Gltf& gltf, GltfBuffers& buffers);

    /// Element by element, each of `numbers` numbers; integers marked as normalized are returned as
    /// shares of their range (glTF 2.0, 3.6.2.2).
    ///
    /// - kind: "SCALAR", "VEC3" or "VEC4"; the accessor must have this type
    /// - where: user of the accessor, for messages
    std::vector<double> numbers(std::size_t accessor, const char* kind, const std::string& where);
    /// The same for integers from 0.
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
