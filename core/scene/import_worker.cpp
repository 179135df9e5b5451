#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <charconv>
#include <cstring>
#include <exception>
#include <filesystem>

#include "core/scene/import_stream.h"

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define BOXWOOD_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define BOXWOOD_SANITIZED 1
#endif
#endif

namespace boxwood {
namespace {

void limit(__rlimit_resource resource, uint64_t value) {
    const rlimit bound{value, value};
    ::setrlimit(resource, &bound);
}

/// A sanitizer reserves terabytes of addresses, so that only time is limited there.
void limit_process(uint64_t file_size) {
    limit(RLIMIT_CPU, import_seconds(file_size));
    limit(RLIMIT_CORE, 0);
#ifndef BOXWOOD_SANITIZED
    limit(RLIMIT_AS, import_memory(file_size));
#endif
}

Vec3 base_color(const aiMaterial& material) {
    aiColor4D color;
    if (material.Get(AI_MATKEY_BASE_COLOR, color) == AI_SUCCESS ||
        material.Get(AI_MATKEY_COLOR_DIFFUSE, color) == AI_SUCCESS)
        return {color.r, color.g, color.b};
    return MeshObject{}.base_color;
}

void append_mesh(const aiScene& scene, const aiMesh& source, const std::string& name,
                 const aiMatrix4x4t<double>& to_world, Mesh& mesh) {
    const uint32_t first = static_cast<uint32_t>(mesh.positions.size());
    for (unsigned i = 0; i < source.mNumVertices; ++i) {
        const aiVector3D& v = source.mVertices[i];
        const aiVector3t<double> p =
            to_world *
            aiVector3t<double>(static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z));
        mesh.positions.push_back({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
    }
    const Vec3 color = source.mMaterialIndex < scene.mNumMaterials
                           ? base_color(*scene.mMaterials[source.mMaterialIndex])
                           : MeshObject{}.base_color;
    const uint32_t object = add_object(mesh, name, color);
    for (unsigned i = 0; i < source.mNumFaces; ++i) {
        const aiFace& face = source.mFaces[i];
        if (face.mNumIndices != 3) continue;  // points and lines
        mesh.triangles.push_back(
            {first + face.mIndices[0], first + face.mIndices[1], first + face.mIndices[2]});
        mesh.object.push_back(object);
    }
}

aiMatrix4x4t<double> in_double(const aiMatrix4x4& m) {
    aiMatrix4x4t<double> result;
    for (unsigned row = 0; row < 4; ++row) {
        for (unsigned column = 0; column < 4; ++column)
            result[row][column] = static_cast<double>(m[row][column]);
    }
    return result;
}

Mesh flatten(const aiScene& scene) {
    struct Visit {
        const aiNode* node;
        aiMatrix4x4t<double> parent_to_world;
    };
    Mesh mesh;
    std::vector<Visit> stack;
    stack.push_back({scene.mRootNode, {}});
    while (!stack.empty()) {
        const Visit visit = stack.back();
        stack.pop_back();
        const aiNode& node = *visit.node;
        const aiMatrix4x4t<double> to_world = visit.parent_to_world * in_double(node.mTransformation);
        for (unsigned i = 0; i < node.mNumMeshes; ++i) {
            const aiMesh& source = *scene.mMeshes[node.mMeshes[i]];
            const aiString& name = node.mName.length > 0 ? node.mName : source.mName;
            append_mesh(scene, source, name.C_Str(), to_world, mesh);
        }
        for (unsigned i = node.mNumChildren; i > 0; --i) stack.push_back({node.mChildren[i - 1], to_world});
    }
    return mesh;
}

std::string import_file(const std::string& path) {
    Assimp::Importer importer;
    importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS,
                                aiComponent_NORMALS | aiComponent_TANGENTS_AND_BITANGENTS |
                                    aiComponent_COLORS | aiComponent_TEXCOORDS | aiComponent_BONEWEIGHTS |
                                    aiComponent_ANIMATIONS | aiComponent_TEXTURES | aiComponent_LIGHTS |
                                    aiComponent_CAMERAS);
    const aiScene* scene =
        importer.ReadFile(path, static_cast<unsigned>(aiProcess_Triangulate) |
                                    static_cast<unsigned>(aiProcess_RemoveComponent) |
                                    static_cast<unsigned>(aiProcess_ValidateDataStructure));
    if (scene == nullptr || scene->mRootNode == nullptr)
        return write_import_failure(importer.GetErrorString());
    return write_import_stream(flatten(*scene));
}

bool write_all(int sink, const std::string& bytes) {
    for (size_t at = 0; at < bytes.size();) {
        const ssize_t count = ::write(sink, bytes.data() + at, bytes.size() - at);
        if (count <= 0) return false;
        at += static_cast<size_t>(count);
    }
    return true;
}

}  // namespace

uint64_t import_seconds(uint64_t file_size) { return 10 + file_size / (1 << 20); }
uint64_t import_memory(uint64_t file_size) { return (uint64_t{1} << 30) + 64 * file_size; }

bool is_known_to_import(const std::string& path) {
    const std::string extension = std::filesystem::path(path).extension().string();
    return !extension.empty() && Assimp::Importer().IsExtensionSupported(extension);
}

int run_import_worker(int argc, char** argv) {
    if (argc != 4 || std::strcmp(argv[1], kImportWorkerArgument) != 0) return 2;
    int sink = -1;
    std::from_chars(argv[3], argv[3] + std::strlen(argv[3]), sink);
    std::error_code error;
    const uintmax_t size = std::filesystem::file_size(argv[2], error);
    limit_process(error ? 0 : size);
    std::string result;
    try {
        result = import_file(argv[2]);
    } catch (const std::bad_alloc&) {
        result = write_import_failure("it needs more memory than the import's limit");
    } catch (const std::exception& problem) {
        result = write_import_failure(problem.what());
    }
    return write_all(sink, result) ? 0 : 3;
}

}  // namespace boxwood
