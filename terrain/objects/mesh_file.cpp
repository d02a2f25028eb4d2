#include "terrain/objects/mesh_file.hpp"

#include <assimp/DefaultIOSystem.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cctype>
#include <map>
#include <optional>

#include "materials/base/error.hpp"
#include "materials/base/files_read.hpp"
#include "materials/base/plain_text.hpp"
#include "terrain/objects/mesh_gate.hpp"

namespace diurna {

namespace {

constexpr std::size_t most_triangles = 5'000'000;

using Corner = std::array<double, 3>;

/// Keeps what a mesh names in turn (materials' libraries, buffers) within its confines, and notes
/// what is read of it. Writes none.
class GuardedFiles : public Assimp::DefaultIOSystem {
 public:
    GuardedFiles(const Confines& confines, std::optional<Mistake>& refused)
        : confines_(confines), refused_(refused) {}

    bool Exists(const char* file) const override {
        return why_not(confines_, file).empty() && DefaultIOSystem::Exists(file);
    }
    Assimp::IOStream* Open(const char* file, const char* mode) override {
        if (mode == nullptr || mode[0] != 'r') return nullptr;
        const std::string why = why_not(confines_, file);
        if (!why.empty()) {
            if (!refused_) refused_ = Mistake{file, why, allow_outside_hint};
            return nullptr;
        }
        note_file_read(file);
        return DefaultIOSystem::Open(file, mode);
    }

 private:
    const Confines& confines_;
    std::optional<Mistake>& refused_;  // the first
};

/// Puts the meshes of a tree of nodes together.
class Collector {
 public:
    Collector(const aiScene& scene, const std::string& name) : scene_(scene), name_(name) {}

    void add(const aiNode& node, const aiMatrix4x4& above) {
        const aiMatrix4x4 transform = above * node.mTransformation;
        for (unsigned m = 0; m < node.mNumMeshes; ++m) {
            add(*scene_.mMeshes[node.mMeshes[m]], node, transform);
        }
        for (unsigned c = 0; c < node.mNumChildren; ++c) add(*node.mChildren[c], transform);
    }
    MeshFile result() { return std::move(mesh_); }

 private:
    void add(const aiMesh& mesh, const aiNode& node, const aiMatrix4x4& transform) {
        if (mesh_.triangle.size() + mesh.mNumFaces > most_triangles) {
            throw InputError(name_, fmt::format("holds more than {} triangles", most_triangles));
        }
        aiString material;
        scene_.mMaterials[mesh.mMaterialIndex]->Get(AI_MATKEY_NAME, material);
        const auto part = static_cast<std::uint16_t>(mesh_.part.size());
        const aiString& group = mesh.mName.length > 0 ? mesh.mName : node.mName;
        mesh_.part.push_back({plain(group.C_Str()), plain(material.C_Str())});

        std::vector<std::uint32_t> number(mesh.mNumVertices);
        for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
            const aiVector3D at = transform * mesh.mVertices[v];
            const Corner corner{at.x, at.y, at.z};
            if (!(Eigen::Array3d(at.x, at.y, at.z).abs() <= most_coordinate).all()) {
                throw InputError(name_, fmt::format("vertex {} of part \"{}\" is not finite, or "
                                                    "beyond {:g}",
                                                    v, group.C_Str(), most_coordinate));
            }
            const auto [known, fresh] =
                number_.try_emplace(corner, static_cast<std::uint32_t>(mesh_.vertex.size()));
            if (fresh) mesh_.vertex.emplace_back(at.x, at.y, at.z);
            number[v] = known->second;
        }
        for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
            const aiFace& face = mesh.mFaces[f];
            if (face.mNumIndices != 3) continue;  // points and lines
            if (std::any_of(face.mIndices, face.mIndices + 3,
                            [&](unsigned i) { return i >= mesh.mNumVertices; })) {
                throw InputError(name_, fmt::format("face {} of part \"{}\" has a corner that is "
                                                    "not there",
                                                    f, group.C_Str()));
            }
            const auto a = number[face.mIndices[0]], b = number[face.mIndices[1]],
                       c = number[face.mIndices[2]];
            if (a == b || b == c || c == a) continue;
            mesh_.triangle.push_back({a, b, c});
            mesh_.part_of.push_back(part);
        }
    }

    const aiScene& scene_;
    const std::string& name_;
    MeshFile mesh_;
    std::map<Corner, std::uint32_t> number_;
};

}  // namespace

MeshFile read_mesh_file(const std::filesystem::path& file, const std::optional<Confines>& given) {
    const std::string name = file.string();
    std::string kind = file.extension().string();
    std::transform(kind.begin(), kind.end(), kind.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    constexpr std::array known{".obj", ".ply", ".stl", ".gltf", ".glb"};
    if (std::find(known.begin(), known.end(), kind) == known.end()) {
        throw InputError(name, fmt::format("found a file \"{}\", expected one of {}", kind,
                                           fmt::join(known, " ")));
    }
    const Confines confines = given ? *given : confines_of(file);
    std::optional<Mistake> refused;
    check_mesh_bytes(file, kind);
    Assimp::Importer importer;
    importer.SetIOHandler(new GuardedFiles(confines, refused));  // the importer's from here on
    // Only places and faces are wanted: normals and texture places would keep equal corners apart.
    importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS,
                                aiComponent_NORMALS | aiComponent_TANGENTS_AND_BITANGENTS |
                                    aiComponent_COLORS | aiComponent_TEXCOORDS |
                                    aiComponent_ANIMATIONS | aiComponent_TEXTURES |
                                    aiComponent_LIGHTS | aiComponent_CAMERAS);
    const aiScene* scene =
        importer.ReadFile(name, aiProcess_RemoveComponent | aiProcess_Triangulate |
                                    aiProcess_SortByPType | aiProcess_ValidateDataStructure);
    if (refused) {
        throw InputError(name, fmt::format("names {}, which {}", refused->where, refused->problem),
                         refused->hint);
    }
    if (scene == nullptr || scene->mRootNode == nullptr) {
        throw InputError(name,
                         fmt::format("not readable as a mesh: {}", importer.GetErrorString()));
    }
    std::size_t faces = 0;
    for (unsigned m = 0; m < scene->mNumMeshes; ++m) faces += scene->mMeshes[m]->mNumFaces;
    if (faces > most_triangles) {
        throw InputError(
            name, fmt::format("holds {} triangles, expected at most {}", faces, most_triangles));
    }
    Collector collector(*scene, name);
    collector.add(*scene->mRootNode, aiMatrix4x4());
    MeshFile mesh = collector.result();
    if (mesh.triangle.empty()) throw InputError(name, "holds no triangle");
    return mesh;
}

}  // namespace diurna
