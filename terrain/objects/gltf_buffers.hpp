#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "materials/base/confines.hpp"
#include "terrain/objects/gltf_json.hpp"

namespace diurna {

/// The bytes that a glTF refers to: in its own binary chunk, in base64, or in files within the
/// confines. Each buffer is read when a view of it is first needed.
class GltfBuffers {
 public:
    /// Throws InputError if a view ends beyond its buffer. The arguments must outlive it.
    ///
    /// - own_piece: binary chunk of a GLB; empty: none
    GltfBuffers(const Gltf& gltf, std::string_view own_piece, const std::filesystem::path& folder,
                const Confines& confines);
    /// The bytes of a bufferView. Throws InputError if the buffer cannot be read, or has fewer
    /// bytes than it claims.
    std::string_view view(std::size_t number);

 private:
    std::string_view buffer(std::size_t number);
    std::string bytes_named(const std::string& uri, const std::string& where) const;

    const Gltf& gltf_;
    std::string_view own_piece_;
    const std::filesystem::path& folder_;
    const Confines& confines_;
    std::map<std::size_t, std::string> read_;
};

}  // namespace diurna
