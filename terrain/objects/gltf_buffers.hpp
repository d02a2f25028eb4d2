#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "materials/base/confines.hpp"
#include "terrain/objects/gltf_json.hpp"

namespace diurna {

/// The bytes that a glTF names: in its own binary piece, in base64, or in files within the
/// confines. Each is read when a view of it is wanted first.
class GltfBuffers {
 public:
    /// Throws InputError where a view ends beyond its buffer. The arguments are to outlive it.
    ///
    /// - own_piece: of a GLB; empty: none
    GltfBuffers(const Gltf& gltf, std::string_view own_piece, const std::filesystem::path& folder,
                const Confines& confines);
    /// The bytes of a bufferView. Throws InputError where the buffer cannot be read, or has fewer
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
