#include "core/scene/gltf_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "core/scene/scene.h"

namespace boxwood {
namespace {

using Json = nlohmann::json;

constexpr uint64_t kMaxSize = uint64_t{1} << 40;  ///< of any offset or length: sums of two cannot wrap
constexpr uint64_t kMaxCount = 0xfffffffe;
constexpr uint64_t kMaxSparse = 0x7fffffff;  ///< tinygltf keeps these as int

/// Bytes of a component; 0 for an unknown type.
uint64_t component_size(uint64_t type) {
    if (type == 5120 || type == 5121) return 1;
    if (type == 5122 || type == 5123) return 2;
    return type == 5125 || type == 5126 ? 4 : 0;
}

/// Components of an element; 0 for an unknown type.
uint64_t component_count(const std::string& type) {
    const std::array<std::pair<const char*, uint64_t>, 7> counts = {
        {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT2", 4}, {"MAT3", 9}, {"MAT4", 16}}};
    for (const auto& [name, count] : counts) {
        if (type == name) return count;
    }
    return 0;
}

/// Extensions that a scene of positions and base colours can do without.
bool is_harmless_extension(const std::string& name) {
    if (name == "KHR_mesh_quantization" || name == "KHR_lights_punctual") return true;
    for (const char* prefix : {"KHR_materials_", "KHR_texture_", "EXT_texture_", "MSFT_texture_"}) {
        if (name.starts_with(prefix)) return true;
    }
    return false;
}

/// Percent-encoding undone.
std::string decoded_uri(const std::string& uri) {
    const auto hex = [](char c) {
        if (c >= '0' && c <= '9') return c - '0';
        if (c >= 'a' && c <= 'f') return c - 'a' + 10;
        return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
    };
    std::string text;
    for (size_t i = 0; i < uri.size(); ++i) {
        const bool is_escape =
            uri[i] == '%' && i + 2 < uri.size() && hex(uri[i + 1]) >= 0 && hex(uri[i + 2]) >= 0;
        text += is_escape ? static_cast<char>(hex(uri[i + 1]) * 16 + hex(uri[i + 2])) : uri[i];
        if (is_escape) i += 2;
    }
    return text;
}

class Checker {
public:
    Checker(const InputFile& file, const GltfContainer& container, const Json& document)
        : file_(file), container_(container), in_(document) {}

    Json check() {
        if (!in_.is_object()) file_.fail("the JSON is not an object");
        check_extensions();
        out_["asset"]["version"] = "2.0";
        check_buffers();
        check_buffer_views();
        check_accessors();
        check_materials();
        check_meshes();
        check_nodes();
        check_tree();
        check_scenes();
        return out_;
    }

private:
    [[noreturn]] void fail(const std::string& place, const std::string& what) const {
        file_.fail(place + ": " + what);
    }

    // --- reading one value; a place is a JSON path such as accessors[3].count ---

    static const Json* find(const Json& object, const char* key) {
        const auto found = object.find(key);
        return found == object.end() ? nullptr : &*found;
    }
    uint64_t whole_number(const Json& value, const std::string& place, uint64_t max) const {
        std::optional<uint64_t> number;
        if (value.is_number_unsigned()) number = value.get<uint64_t>();
        if (value.is_number_float()) {
            const double real = value.get<double>();
            if (real >= 0.0 && real <= 0x1p53 && real == std::floor(real))
                number = static_cast<uint64_t>(real);
        }
        if (!number || *number > max)
            fail(place, "found " + in_quotes(value.is_number() ? value.dump() : value.type_name()) +
                            ", expected a whole number from 0 to " + std::to_string(max));
        return *number;
    }
    std::optional<uint64_t> number(const Json& object, const char* key, const std::string& place,
                                   uint64_t max) const {
        const Json* value = find(object, key);
        if (value == nullptr) return std::nullopt;
        return whole_number(*value, place + "." + key, max);
    }
    uint64_t needed_number(const Json& object, const char* key, const std::string& place,
                           uint64_t max) const {
        const std::optional<uint64_t> value = number(object, key, place, max);
        if (!value) fail(place, "has no " + std::string(key));
        return *value;
    }
    uint64_t index(const Json& value, const char* array, const std::string& place) const {
        const uint64_t i = whole_number(value, place, kMaxCount);
        const size_t count = out_.contains(array) ? out_[array].size() : 0;
        if (i >= count)
            fail(place, "names " + std::string(array) + "[" + std::to_string(i) + "], there are " +
                            std::to_string(count));
        return i;
    }
    std::optional<uint64_t> optional_index(const Json& object, const char* key, const char* array,
                                           const std::string& place) const {
        const Json* value = find(object, key);
        if (value == nullptr) return std::nullopt;
        return index(*value, array, place + "." + key);
    }
    std::string text(const Json& object, const char* key, const std::string& place) const {
        const Json* value = find(object, key);
        if (value == nullptr) return {};
        if (!value->is_string()) fail(place + "." + key, "expected a text");
        return value->get<std::string>();
    }
    /// A list of numbers; nothing if absent.
    std::optional<Json> reals(const Json& object, const char* key, size_t count,
                              const std::string& place) const {
        const Json* value = find(object, key);
        if (value == nullptr) return std::nullopt;
        bool is_good = value->is_array() && value->size() == count;
        for (size_t i = 0; is_good && i < count; ++i) is_good = (*value)[i].is_number();
        if (!is_good) fail(place + "." + key, "expected " + std::to_string(count) + " numbers");
        return *value;
    }
    /// Calls check(object, place) for each entry of an array of the document, and keeps what it returns.
    template <class Check>
    void check_each(const char* array, const Check& check) {
        const Json* list = find(in_, array);
        if (list == nullptr) return;
        if (!list->is_array()) fail(array, "expected an array");
        Json& kept = out_[array] = Json::array();
        for (size_t i = 0; i < list->size(); ++i) {
            const std::string place = std::string(array) + "[" + std::to_string(i) + "]";
            if (!(*list)[i].is_object()) fail(place, "expected an object");
            kept.push_back(check((*list)[i], place));
        }
    }

    // --- the parts of a document ---

    void check_extensions() const {
        const Json* required = find(in_, "extensionsRequired");
        if (required == nullptr) return;
        if (!required->is_array()) fail("extensionsRequired", "expected an array");
        for (const Json& name : *required) {
            if (!name.is_string() || !is_harmless_extension(name.get<std::string>()))
                fail("extensionsRequired", "the file needs the extension " +
                                               in_quotes(name.is_string() ? name.get<std::string>() : "?") +
                                               ", which is not supported");
        }
    }

    void check_buffers() {
        check_each("buffers", [this](const Json& buffer, const std::string& place) {
            const uint64_t length = needed_number(buffer, "byteLength", place, kMaxSize);
            const std::string uri = text(buffer, "uri", place);
            const bool is_chunk = uri.empty() && container_.is_binary && place == "buffers[0]";
            if (uri.empty() && !is_chunk) fail(place, "has no uri");
            Json kept;
            uint64_t size = container_.bin.size();
            if (uri.starts_with("data:")) {
                const std::string_view data = base64_of(uri, place + ".uri");
                size = data.size() / 4 * 3 - (data.ends_with("==") ? 2 : data.ends_with("=") ? 1 : 0);
                kept["uri"] = "data:application/octet-stream;base64," + std::string(data);
            } else if (!is_chunk) {
                size = external_size(uri, place + ".uri");
                kept["uri"] = encoded_plus(uri);
            }
            if (size < length)
                fail(place + ".byteLength",
                     std::to_string(length) + " bytes, the buffer has " + std::to_string(size));
            if (size == 0) fail(place, "the buffer is empty");
            kept["byteLength"] = is_chunk ? length : size;
            return kept;
        });
    }
    /// The payload of a data URI, whole groups of four valid characters.
    std::string_view base64_of(const std::string& uri, const std::string& place) const {
        constexpr std::string_view kMarker = ";base64,";
        const size_t marker = uri.find(kMarker);
        if (marker == std::string::npos) fail(place, "a data URI that is not base64");
        const std::string_view data = std::string_view(uri).substr(marker + kMarker.size());
        const size_t padding = data.ends_with("==") ? 2 : data.ends_with("=") ? 1 : 0;
        const auto is_base64 = [](char c) {
            return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '+' ||
                   c == '/';
        };
        const auto end = data.end() - static_cast<std::ptrdiff_t>(padding);
        const auto bad = std::find_if_not(data.begin(), end, is_base64);
        if (bad != end) fail(place, "character " + in_quotes(std::string(1, *bad)) + " is not base64");
        if (data.size() % 4 != 0) fail(place, "base64 data whose length is not a multiple of four");
        return data;
    }
    uint64_t external_size(const std::string& uri, const std::string& place) const {
        const std::string name = decoded_uri(uri);
        const std::string folder = folder_of(file_.path);
        if (name.find(':') != std::string::npos || name.find('\0') != std::string::npos)
            fail(place, in_quotes(name) + " is not a relative file name");
        if (name[0] == '/' || !is_inside_folder(folder, folder + "/" + name))
            fail(place, in_quotes(name) + " leads out of the file's folder");
        std::error_code error;
        if (!std::filesystem::is_regular_file(folder + "/" + name, error))
            fail(place, "there is no file " + in_quotes(name));
        const uint64_t size = std::filesystem::file_size(folder + "/" + name, error);
        if (error) fail(place, "the file " + in_quotes(name) + " cannot be read");
        return size;
    }
    /// tinygltf takes a plus for a blank.
    static std::string encoded_plus(const std::string& uri) {
        std::string encoded;
        for (const char c : uri) encoded += c == '+' ? std::string("%2B") : std::string(1, c);
        return encoded;
    }

    void check_buffer_views() {
        check_each("bufferViews", [this](const Json& view, const std::string& place) {
            const Json* buffer = find(view, "buffer");
            if (buffer == nullptr) fail(place, "has no buffer");
            const uint64_t i = index(*buffer, "buffers", place + ".buffer");
            const uint64_t offset = number(view, "byteOffset", place, kMaxSize).value_or(0);
            const uint64_t length = needed_number(view, "byteLength", place, kMaxSize);
            const uint64_t size = out_["buffers"][i]["byteLength"].get<uint64_t>();
            if (offset + length > size)
                fail(place, "bytes " + std::to_string(offset) + " to " + std::to_string(offset + length) +
                                ", the buffer has " + std::to_string(size));
            Json kept = {{"buffer", i}, {"byteOffset", offset}, {"byteLength", length}};
            if (const auto stride = number(view, "byteStride", place, 252)) {
                if (*stride < 4 || *stride % 4 != 0)
                    fail(place + ".byteStride",
                         std::to_string(*stride) + ", expected a multiple of 4 from 4 to 252");
                kept["byteStride"] = *stride;
            }
            return kept;
        });
    }

    /// Whether count elements of size bytes, stride apart, fit into a view from offset on.
    void check_range(uint64_t view, uint64_t offset, uint64_t count, uint64_t size, bool may_have_stride,
                     const std::string& place) const {
        const Json& v = out_["bufferViews"][view];
        const uint64_t stride = may_have_stride ? v.value("byteStride", size) : size;
        if (stride < size)
            fail(place, "elements of " + std::to_string(size) + " bytes overlap at a stride of " +
                            std::to_string(stride));
        const uint64_t length = v["byteLength"].get<uint64_t>();
        if (count != 0 && offset + (count - 1) * stride + size > length)
            fail(place, std::to_string(count) + " elements from byte " + std::to_string(offset) +
                            " go past the end of bufferViews[" + std::to_string(view) + "], which has " +
                            std::to_string(length) + " bytes");
    }

    void check_accessors() {
        check_each("accessors", [this](const Json& accessor, const std::string& place) {
            const uint64_t component = needed_number(accessor, "componentType", place, 65535);
            const std::string type = text(accessor, "type", place);
            const uint64_t size = component_size(component) * component_count(type);
            if (component_size(component) == 0)
                fail(place + ".componentType", std::to_string(component) + ", expected one of 5120 to 5126");
            if (size == 0)
                fail(place + ".type", "found " + in_quotes(type) + ", expected SCALAR, VEC3 or the like");
            const uint64_t count = needed_number(accessor, "count", place, kMaxCount);
            const uint64_t offset = number(accessor, "byteOffset", place, kMaxSize).value_or(0);
            Json kept = {
                {"componentType", component}, {"type", type}, {"count", count}, {"byteOffset", offset}};
            const Json* normalized = find(accessor, "normalized");
            kept["normalized"] = normalized != nullptr && normalized->is_boolean() && normalized->get<bool>();
            if (const auto view = optional_index(accessor, "bufferView", "bufferViews", place)) {
                check_range(*view, offset, count, size, true, place);
                kept["bufferView"] = *view;
            } else if (count > file_.bytes.size()) {
                fail(place + ".count", std::to_string(count) + " elements without a bufferView");
            }
            if (const Json* sparse = find(accessor, "sparse"))
                kept["sparse"] = checked_sparse(*sparse, count, size, place + ".sparse");
            return kept;
        });
    }

    Json checked_sparse(const Json& sparse, uint64_t accessor_count, uint64_t size,
                        const std::string& place) const {
        const Json* indices = sparse.is_object() ? find(sparse, "indices") : nullptr;
        const Json* values = sparse.is_object() ? find(sparse, "values") : nullptr;
        if (indices == nullptr || values == nullptr || !indices->is_object() || !values->is_object())
            fail(place, "expected an object with count, indices and values");
        const uint64_t count = needed_number(sparse, "count", place, std::min(accessor_count, kMaxSparse));
        const auto index_view = optional_index(*indices, "bufferView", "bufferViews", place + ".indices");
        const auto value_view = optional_index(*values, "bufferView", "bufferViews", place + ".values");
        if (!index_view || !value_view) fail(place, "indices and values need a bufferView each");
        const uint64_t component = needed_number(*indices, "componentType", place + ".indices", 65535);
        if (component != 5121 && component != 5123 && component != 5125)
            fail(place + ".indices.componentType",
                 std::to_string(component) + ", expected 5121, 5123 or 5125");
        const uint64_t index_offset =
            number(*indices, "byteOffset", place + ".indices", kMaxSparse).value_or(0);
        const uint64_t value_offset =
            number(*values, "byteOffset", place + ".values", kMaxSparse).value_or(0);
        check_range(*index_view, index_offset, count, component_size(component), false, place + ".indices");
        check_range(*value_view, value_offset, count, size, false, place + ".values");
        return {{"count", count},
                {"indices",
                 {{"bufferView", *index_view}, {"byteOffset", index_offset}, {"componentType", component}}},
                {"values", {{"bufferView", *value_view}, {"byteOffset", value_offset}}}};
    }

    void check_materials() {
        check_each("materials", [this](const Json& material, const std::string& place) {
            Json kept = {{"name", text(material, "name", place)}};
            const Json* surface = find(material, "pbrMetallicRoughness");
            if (surface == nullptr) return kept;
            if (!surface->is_object()) fail(place + ".pbrMetallicRoughness", "expected an object");
            if (const auto color = reals(*surface, "baseColorFactor", 4, place + ".pbrMetallicRoughness"))
                kept["pbrMetallicRoughness"]["baseColorFactor"] = *color;
            return kept;
        });
    }

    void check_meshes() {
        check_each("meshes", [this](const Json& mesh, const std::string& place) {
            Json kept = {{"name", text(mesh, "name", place)}, {"primitives", Json::array()}};
            const Json* primitives = find(mesh, "primitives");
            if (primitives == nullptr || !primitives->is_array()) fail(place, "has no array of primitives");
            for (size_t i = 0; i < primitives->size(); ++i) {
                const std::string inner = place + ".primitives[" + std::to_string(i) + "]";
                if (!(*primitives)[i].is_object()) fail(inner, "expected an object");
                kept["primitives"].push_back(checked_primitive((*primitives)[i], inner));
            }
            return kept;
        });
    }

    Json checked_primitive(const Json& primitive, const std::string& place) const {
        Json kept = {{"mode", number(primitive, "mode", place, 6).value_or(4)},
                     {"attributes", Json::object()}};
        const Json* attributes = find(primitive, "attributes");
        if (attributes == nullptr || !attributes->is_object()) fail(place, "has no attributes");
        if (const auto position =
                optional_index(*attributes, "POSITION", "accessors", place + ".attributes")) {
            check_position(out_["accessors"][*position], place + ".attributes.POSITION");
            kept["attributes"]["POSITION"] = *position;
        }
        if (const auto indices = optional_index(primitive, "indices", "accessors", place)) {
            const Json& accessor = out_["accessors"][*indices];
            const uint64_t component = accessor["componentType"].get<uint64_t>();
            if (accessor["type"] != "SCALAR" || (component != 5121 && component != 5123 && component != 5125))
                fail(place + ".indices", "the accessor is " + accessor["type"].get<std::string>() +
                                             " of componentType " + std::to_string(component) +
                                             ", expected SCALAR of 5121, 5123 or 5125");
            kept["indices"] = *indices;
        }
        if (const auto material = optional_index(primitive, "material", "materials", place))
            kept["material"] = *material;
        return kept;
    }

    void check_position(const Json& accessor, const std::string& place) const {
        const uint64_t component = accessor["componentType"].get<uint64_t>();
        if (accessor["type"] != "VEC3")
            fail(place, "the accessor is " + accessor["type"].get<std::string>() + ", expected VEC3");
        if (component == 5125)
            fail(place, "the accessor has componentType 5125, expected 5126 or one of 5120 to 5123");
    }

    void check_nodes() {
        const Json* list = find(in_, "nodes");
        if (list == nullptr || !list->is_array()) return;
        const size_t count = list->size();
        check_each("nodes", [this, count](const Json& node, const std::string& place) {
            Json kept = {{"name", text(node, "name", place)}};
            if (const auto mesh = optional_index(node, "mesh", "meshes", place)) kept["mesh"] = *mesh;
            const std::array<std::pair<const char*, size_t>, 4> transforms = {
                {{"matrix", 16}, {"translation", 3}, {"rotation", 4}, {"scale", 3}}};
            for (const auto& [key, length] : transforms) {
                if (const auto values = reals(node, key, length, place)) kept[key] = *values;
            }
            if (const Json* children = find(node, "children")) {
                if (!children->is_array()) fail(place + ".children", "expected an array");
                kept["children"] = Json::array();
                for (const Json& child : *children)
                    kept["children"].push_back(whole_number(child, place + ".children", count - 1));
            }
            return kept;
        });
    }

    /// One parent each; and from the roots down every node is met, or it stands in a cycle.
    void check_tree() {
        if (!out_.contains("nodes")) return;
        const Json& nodes = out_["nodes"];
        has_parent_.assign(nodes.size(), false);
        for (const Json& node : nodes) {
            if (!node.contains("children")) continue;
            for (const Json& child : node["children"]) {
                const size_t c = child.get<size_t>();
                if (has_parent_[c]) fail("nodes[" + std::to_string(c) + "]", "has more than one parent");
                has_parent_[c] = true;
            }
        }
        std::vector<bool> is_met(nodes.size(), false);
        std::vector<size_t> stack;
        for (size_t i = 0; i < nodes.size(); ++i) {
            if (!has_parent_[i]) stack.push_back(i);
        }
        while (!stack.empty()) {
            const size_t node = stack.back();
            stack.pop_back();
            is_met[node] = true;
            if (!nodes[node].contains("children")) continue;
            for (const Json& child : nodes[node]["children"]) stack.push_back(child.get<size_t>());
        }
        for (size_t i = 0; i < nodes.size(); ++i) {
            if (!is_met[i]) fail("nodes[" + std::to_string(i) + "]", "is part of a cycle of nodes");
        }
    }

    void check_scenes() {
        check_each("scenes", [this](const Json& scene, const std::string& place) {
            Json kept = {{"nodes", Json::array()}};
            std::vector<bool> is_listed(out_.contains("nodes") ? out_["nodes"].size() : 0, false);
            const Json* nodes = find(scene, "nodes");
            if (nodes == nullptr) return kept;
            if (!nodes->is_array()) fail(place + ".nodes", "expected an array");
            for (const Json& node : *nodes) {
                const uint64_t i = index(node, "nodes", place + ".nodes");
                if (is_listed[i]) fail(place + ".nodes", "names node " + std::to_string(i) + " twice");
                if (has_parent_[i])
                    fail(place + ".nodes", "names node " + std::to_string(i) + ", which is no root");
                is_listed[i] = true;
                kept["nodes"].push_back(i);
            }
            return kept;
        });
        if (const auto scene = optional_index(in_, "scene", "scenes", "document")) out_["scene"] = *scene;
    }

    const InputFile& file_;
    const GltfContainer& container_;
    const Json& in_;
    Json out_;
    std::vector<bool> has_parent_;
};

}  // namespace

std::string checked_gltf(const InputFile& file, const GltfContainer& container) {
    Json document;
    try {
        document = Json::parse(to_utf8(std::string(container.json)));
    } catch (const Json::parse_error& error) {
        const uint64_t start = static_cast<uint64_t>(container.json.data() - file.bytes.data());
        file.fail_at_byte(start + error.byte - 1, "this is not valid JSON");
    } catch (const Json::exception&) {
        file.fail("the JSON has a number that fits no type");
    }
    return Checker(file, container, document).check().dump();
}

}  // namespace boxwood
