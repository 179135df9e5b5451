#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include <tiny_gltf.h>

#include <algorithm>
#include <cstring>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <map>

#include "core/base/error.h"
#include "core/scene/gltf_check.h"
#include "core/scene/readers.h"

namespace boxwood {
namespace {

using Matrix = glm::dmat4;

/// Instances may make this many vertices or triangles of a file, and more of a larger one.
constexpr uint64_t kFreeElements = uint64_t{1} << 23, kElementsPerByte = 64;

/// A mesh in the world.
struct Instance {
    const tinygltf::Node* node;
    Matrix to_world;
};

/// tinygltf looks for a buffer's file through these; what lies outside `folder` does not exist for it.
tinygltf::FsCallbacks folder_callbacks(std::string& folder) {
    tinygltf::FsCallbacks calls{};
    calls.FileExists = [](const std::string& path, void* root) {
        return is_inside_folder(*static_cast<std::string*>(root), path);
    };
    calls.ExpandFilePath = [](const std::string& path, void*) { return path; };
    calls.ReadWholeFile = [](std::vector<unsigned char>* out, std::string* error, const std::string& path,
                             void* root) {
        if (!is_inside_folder(*static_cast<std::string*>(root), path)) return false;
        try {
            const InputFile file = read_input_file(path);
            out->assign(file.bytes.begin(), file.bytes.end());
        } catch (const Error& problem) {
            *error = problem.what();
            return false;
        }
        return true;
    };
    calls.WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
        return false;
    };
    calls.user_data = &folder;
    return calls;
}

void append_u32(std::string& bytes, uint64_t value) {
    for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(value >> shift & 0xff);
}

/// A GLB of the checked JSON and the file's own binary chunk.
std::string make_glb(std::string json, std::string_view bin) {
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const size_t bin_size = bin.size() / 4 * 4 + (bin.size() % 4 == 0 ? 0 : 4);
    std::string glb = "glTF";
    glb.reserve(28 + json.size() + bin_size);
    append_u32(glb, 2);
    append_u32(glb, 20 + json.size() + (bin_size == 0 ? 0 : 8 + bin_size));
    append_u32(glb, json.size());
    glb += "JSON" + json;
    if (bin_size == 0) return glb;
    append_u32(glb, bin_size);
    glb += std::string("BIN\0", 4);
    glb += bin;
    glb.resize(glb.size() + bin_size - bin.size(), '\0');
    return glb;
}

tinygltf::Model load_model(const InputFile& file) {
    const GltfContainer container = open_gltf_container(file);
    std::string text = checked_gltf(file, container);
    std::string folder = folder_of(file.path);
    tinygltf::TinyGLTF loader;
    loader.SetFsCallbacks(folder_callbacks(folder));
    if (container.is_binary) text = make_glb(std::move(text), container.bin);
    if (text.size() > std::numeric_limits<uint32_t>::max()) file.fail("more than 4 GiB of glTF");
    const uint32_t size = static_cast<uint32_t>(text.size());
    tinygltf::Model model;
    std::string problem, warning;
    const bool is_loaded =
        container.is_binary
            ? loader.LoadBinaryFromMemory(&model, &problem, &warning,
                                          reinterpret_cast<const unsigned char*>(text.data()), size, folder)
            : loader.LoadASCIIFromString(&model, &problem, &warning, text.c_str(), size, folder);
    if (!is_loaded) file.fail("the glTF cannot be read: " + in_quotes(problem));
    return model;
}

/// Bytes of one element and where they are: checked_gltf has seen to it that all lie inside their buffer.
struct Elements {
    const unsigned char* first;
    size_t stride;
};

Elements elements_of(const tinygltf::Model& model, int view_index, size_t offset, size_t packed_size) {
    const tinygltf::BufferView& view = model.bufferViews[static_cast<size_t>(view_index)];
    const tinygltf::Buffer& buffer = model.buffers[static_cast<size_t>(view.buffer)];
    return {buffer.data.data() + view.byteOffset + offset,
            view.byteStride == 0 ? packed_size : view.byteStride};
}

uint32_t read_index(const unsigned char* bytes, int component) {
    if (component == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE) return *bytes;
    if (component == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT)
        return bytes[0] | static_cast<uint32_t>(bytes[1]) << 8;
    return bytes[0] | static_cast<uint32_t>(bytes[1]) << 8 | static_cast<uint32_t>(bytes[2]) << 16 |
           static_cast<uint32_t>(bytes[3]) << 24;
}

size_t component_size(int component) {
    return static_cast<size_t>(tinygltf::GetComponentSizeInBytes(static_cast<uint32_t>(component)));
}

/// One coordinate; integers are those of KHR_mesh_quantization, normalized ones by the specification's 3.11.
float read_coordinate(const unsigned char* bytes, const tinygltf::Accessor& accessor) {
    const int component = accessor.componentType;
    if (component == TINYGLTF_COMPONENT_TYPE_FLOAT) {
        float value;
        std::memcpy(&value, bytes, sizeof value);
        return value;
    }
    const bool is_byte = component_size(component) == 1;
    const bool is_signed =
        component == TINYGLTF_COMPONENT_TYPE_BYTE || component == TINYGLTF_COMPONENT_TYPE_SHORT;
    const int raw = is_byte ? bytes[0] : bytes[0] | bytes[1] << 8;
    const int half = is_byte ? 0x80 : 0x8000;
    const int value = is_signed && raw >= half ? raw - 2 * half : raw;
    if (!accessor.normalized) return static_cast<float>(value);
    const float largest = static_cast<float>(is_signed ? half - 1 : 2 * half - 1);
    return std::max(static_cast<float>(value) / largest, -1.0f);
}

class GltfReader {
public:
    GltfReader(const InputFile& file, Scene& scene, Task& task)
        : file_(file), mesh_(scene.mesh), task_(task), model_(load_model(file)) {}

    void read() {
        const std::vector<Instance> instances = flatten();
        reserve(instances);
        for (const Instance& instance : instances) {
            add_instance(instance);
            if (task_.stopped()) return;
        }
        task_.skipped.add("primitive of points or lines", other_modes_);
    }

private:
    static Matrix local_matrix(const tinygltf::Node& node) {
        Matrix matrix(1.0);
        if (node.matrix.size() == 16) {
            for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = node.matrix[static_cast<size_t>(i)];
            return matrix;
        }
        if (node.translation.size() == 3)
            matrix[3] = glm::dvec4(node.translation[0], node.translation[1], node.translation[2], 1.0);
        if (node.rotation.size() == 4) {
            const std::vector<double>& q = node.rotation;
            matrix *= glm::mat4_cast(glm::dquat(q[3], q[0], q[1], q[2]));
        }
        if (node.scale.size() == 3) {
            for (int i = 0; i < 3; ++i) matrix[i] *= node.scale[static_cast<size_t>(i)];
        }
        return matrix;
    }

    /// All uses of meshes, depth first, in the order of the file.
    std::vector<Instance> flatten() const {
        struct Visit {
            int node;
            Matrix parent_to_world;
        };
        std::vector<Visit> stack;
        const std::vector<int> roots = root_nodes();
        for (auto root = roots.rbegin(); root != roots.rend(); ++root) stack.push_back({*root, Matrix(1.0)});
        std::vector<Instance> instances;
        while (!stack.empty()) {
            const Visit visit = stack.back();
            stack.pop_back();
            const tinygltf::Node& node = model_.nodes[static_cast<size_t>(visit.node)];
            const Matrix to_world = visit.parent_to_world * local_matrix(node);
            if (node.mesh >= 0) instances.push_back({&node, to_world});
            for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
                stack.push_back({*child, to_world});
        }
        return instances;
    }

    /// Those of the default scene, or of the first; without scenes all nodes that have no parent.
    std::vector<int> root_nodes() const {
        if (!model_.scenes.empty())
            return model_.scenes[static_cast<size_t>(std::max(model_.defaultScene, 0))].nodes;
        std::vector<bool> is_child(model_.nodes.size(), false);
        for (const tinygltf::Node& node : model_.nodes) {
            for (const int child : node.children) is_child[static_cast<size_t>(child)] = true;
        }
        std::vector<int> roots;
        for (size_t i = 0; i < is_child.size(); ++i) {
            if (!is_child[i]) roots.push_back(static_cast<int>(i));
        }
        return roots;
    }

    const tinygltf::Accessor* position_accessor(const tinygltf::Primitive& primitive) const {
        const auto found = primitive.attributes.find("POSITION");
        return found == primitive.attributes.end() ? nullptr
                                                   : &model_.accessors[static_cast<size_t>(found->second)];
    }
    const tinygltf::Mesh& mesh_of(const Instance& instance) const {
        return model_.meshes[static_cast<size_t>(instance.node->mesh)];
    }

    /// Instances can multiply a small file: the sums are taken before anything is allocated.
    void reserve(const std::vector<Instance>& instances) {
        uint64_t vertex_count = 0, triangle_count = 0;
        uint64_t most = kFreeElements + kElementsPerByte * file_.bytes.size();
        for (const tinygltf::Buffer& buffer : model_.buffers) most += kElementsPerByte * buffer.data.size();
        most = std::min(most, uint64_t{kNoIndex});
        for (const Instance& instance : instances) {
            std::map<const tinygltf::Accessor*, bool> is_counted;
            for (const tinygltf::Primitive& primitive : mesh_of(instance).primitives) {
                const tinygltf::Accessor* position = position_accessor(primitive);
                if (position == nullptr || primitive.mode < TINYGLTF_MODE_TRIANGLES) continue;
                if (!is_counted[position]) vertex_count += position->count;
                is_counted[position] = true;
                const uint64_t corners = corner_count(primitive, *position);
                const bool is_list = primitive.mode == TINYGLTF_MODE_TRIANGLES;
                triangle_count += is_list ? corners / 3 : corners - std::min<uint64_t>(corners, 2);
            }
            if (vertex_count > most || triangle_count > most)
                file_.fail("its instances have more than " + std::to_string(most) + " vertices or triangles");
        }
        mesh_.positions.reserve(vertex_count);
        mesh_.triangles.reserve(triangle_count);
        mesh_.object.reserve(triangle_count);
    }

    uint64_t corner_count(const tinygltf::Primitive& primitive, const tinygltf::Accessor& position) const {
        return primitive.indices < 0 ? position.count
                                     : model_.accessors[static_cast<size_t>(primitive.indices)].count;
    }

    void add_instance(const Instance& instance) {
        const tinygltf::Mesh& mesh = mesh_of(instance);
        std::map<const tinygltf::Accessor*, uint32_t> first_vertex;  // primitives may share their vertices
        for (size_t i = 0; i < mesh.primitives.size(); ++i) {
            const tinygltf::Primitive& primitive = mesh.primitives[i];
            if (primitive.mode < TINYGLTF_MODE_TRIANGLES) {
                ++other_modes_;
                continue;
            }
            const tinygltf::Accessor* position = position_accessor(primitive);
            if (position == nullptr) continue;
            const auto [vertex, is_new] =
                first_vertex.try_emplace(position, static_cast<uint32_t>(mesh_.positions.size()));
            if (is_new) add_positions(*position, instance.to_world);
            const size_t first_triangle = mesh_.triangles.size();
            add_triangles(primitive, *position, vertex->second, place_of(mesh, i));
            if (glm::determinant(glm::dmat3(instance.to_world)) < 0.0) {  // a mirror turns triangles round
                for (size_t t = first_triangle; t < mesh_.triangles.size(); ++t)
                    std::swap(mesh_.triangles[t].y, mesh_.triangles[t].z);
            }
            mesh_.object.resize(mesh_.triangles.size(), add_primitive_object(*instance.node, mesh, i));
        }
    }

    std::string place_of(const tinygltf::Mesh& mesh, size_t primitive) const {
        return "meshes[" + std::to_string(&mesh - model_.meshes.data()) + "].primitives[" +
               std::to_string(primitive) + "]";
    }

    uint32_t add_primitive_object(const tinygltf::Node& node, const tinygltf::Mesh& mesh, size_t primitive) {
        std::string name = !node.name.empty() ? node.name : mesh.name;
        if (name.empty()) name = "mesh " + std::to_string(node.mesh);
        if (mesh.primitives.size() > 1) name += " / " + std::to_string(primitive);
        const int material = mesh.primitives[primitive].material;
        if (material < 0) return add_object(mesh_, name);
        const std::vector<double>& factor =
            model_.materials[static_cast<size_t>(material)].pbrMetallicRoughness.baseColorFactor;
        const Vec3 color = factor.size() < 3 ? Vec3(1.0f) : Vec3(DVec3(factor[0], factor[1], factor[2]));
        return add_object(mesh_, name, glm::clamp(color, Vec3(0.0f), Vec3(1.0f)));
    }

    Vec3 read_position(const unsigned char* bytes, const tinygltf::Accessor& accessor) const {
        const size_t size = component_size(accessor.componentType);
        const float x = read_coordinate(bytes, accessor);
        const float y = read_coordinate(bytes + size, accessor);
        const float z = read_coordinate(bytes + 2 * size, accessor);
        return {x, y, z};
    }

    /// In double, rounded once; untouched where the node has no transform.
    void add_positions(const tinygltf::Accessor& accessor, const Matrix& to_world) {
        const size_t first = mesh_.positions.size();
        mesh_.positions.resize(first + accessor.count, Vec3(0.0f));
        const size_t size = 3 * component_size(accessor.componentType);
        if (accessor.bufferView >= 0) {
            const Elements elements = elements_of(model_, accessor.bufferView, accessor.byteOffset, size);
            for (size_t i = 0; i < accessor.count; ++i)
                mesh_.positions[first + i] = read_position(elements.first + i * elements.stride, accessor);
        }
        for_each_sparse(accessor, size, [this, first, &accessor](uint32_t i, const unsigned char* value) {
            mesh_.positions[first + i] = read_position(value, accessor);
        });
        if (to_world == Matrix(1.0)) return;
        for (size_t i = first; i < mesh_.positions.size(); ++i)
            mesh_.positions[i] = Vec3(DVec3(to_world * glm::dvec4(DVec3(mesh_.positions[i]), 1.0)));
    }

    /// Calls replace(index, value) for each sparse value, `size` bytes each; the index is in range.
    template <class Replace>
    void for_each_sparse(const tinygltf::Accessor& accessor, size_t size, const Replace& replace) const {
        const auto& sparse = accessor.sparse;
        if (!sparse.isSparse) return;
        const int type = sparse.indices.componentType;
        const size_t index_size = component_size(type);
        const Elements indices = elements_of(model_, sparse.indices.bufferView,
                                             static_cast<size_t>(sparse.indices.byteOffset), index_size);
        const Elements values = elements_of(model_, sparse.values.bufferView,
                                            static_cast<size_t>(sparse.values.byteOffset), size);
        for (size_t i = 0; i < static_cast<size_t>(sparse.count); ++i) {
            const uint32_t index = read_index(indices.first + i * index_size, type);
            if (index >= accessor.count)
                file_.fail("accessors[" + std::to_string(&accessor - model_.accessors.data()) +
                           "].sparse: index " + std::to_string(index) + ", the accessor has " +
                           std::to_string(accessor.count) + " elements");
            replace(index, values.first + i * size);
        }
    }

    /// Indices of an accessor, zero where it has no data, each below the count of vertices.
    std::vector<uint32_t> read_indices(const tinygltf::Accessor& accessor, size_t vertex_count,
                                       const std::string& place) const {
        std::vector<uint32_t> indices(accessor.count, 0);
        const int type = accessor.componentType;
        const size_t size = component_size(type);
        if (accessor.bufferView >= 0) {
            const Elements elements = elements_of(model_, accessor.bufferView, accessor.byteOffset, size);
            for (size_t i = 0; i < indices.size(); ++i)
                indices[i] = read_index(elements.first + i * elements.stride, type);
        }
        for_each_sparse(accessor, size, [&indices, type](uint32_t i, const unsigned char* value) {
            indices[i] = read_index(value, type);
        });
        for (size_t i = 0; i < indices.size(); ++i) {
            if (indices[i] >= vertex_count)
                file_.fail(place + ".indices: entry " + std::to_string(i) + " is " +
                           std::to_string(indices[i]) + ", there are " + std::to_string(vertex_count) +
                           " vertices");
        }
        return indices;
    }

    /// Lists, strips and fans. A strip's odd triangles are turned round as the specification's 3.7.2.1 says.
    void add_triangles(const tinygltf::Primitive& primitive, const tinygltf::Accessor& position,
                       uint32_t first_vertex, const std::string& place) {
        std::vector<uint32_t> indices;
        if (primitive.indices >= 0)
            indices =
                read_indices(model_.accessors[static_cast<size_t>(primitive.indices)], position.count, place);
        const auto vertex = [&](size_t i) {
            return first_vertex + (primitive.indices >= 0 ? indices[i] : static_cast<uint32_t>(i));
        };
        const size_t count = corner_count(primitive, position);
        if (primitive.mode == TINYGLTF_MODE_TRIANGLES) {
            for (size_t i = 0; i + 2 < count; i += 3)
                mesh_.triangles.push_back({vertex(i), vertex(i + 1), vertex(i + 2)});
            return;
        }
        const bool is_strip = primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP;
        for (size_t i = 0; i + 2 < count; ++i) {
            if (is_strip) {
                mesh_.triangles.push_back({vertex(i), vertex(i + 1 + i % 2), vertex(i + 2 - i % 2)});
            } else {
                mesh_.triangles.push_back({vertex(i + 1), vertex(i + 2), vertex(0)});
            }
        }
    }

    const InputFile& file_;
    Mesh& mesh_;
    Task& task_;
    const tinygltf::Model model_;
    uint64_t other_modes_ = 0;
};

}  // namespace

void read_gltf(const InputFile& file, Scene& scene, Task& task) { GltfReader(file, scene, task).read(); }

}  // namespace boxwood
