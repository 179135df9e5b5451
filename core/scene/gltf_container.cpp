#include "core/scene/gltf_check.h"

namespace boxwood {
namespace {

constexpr int kMaxJsonDepth = 128;

/// Refuses nesting that would overflow the stack of a recursive reader.
void check_json_depth(const InputFile& file, std::string_view json) {
    int depth = 0;
    bool is_text = false;
    for (size_t i = 0; i < json.size(); ++i) {
        const char c = json[i];
        if (is_text) {
            if (c == '\\') ++i;
            is_text = c != '"';
        } else if (c == '"') {
            is_text = true;
        } else if (c == '{' || c == '[') {
            if (++depth > kMaxJsonDepth)
                file.fail_at_byte(
                    static_cast<uint64_t>(json.data() - file.bytes.data()) + i,
                    "the JSON is nested deeper than " + std::to_string(kMaxJsonDepth) + " levels");
        } else if (c == '}' || c == ']') {
            --depth;
        }
    }
}

}  // namespace

GltfContainer open_gltf_container(const InputFile& file) {
    constexpr size_t kHeader = 12, kChunkHeader = 8;
    constexpr uint32_t kJsonChunk = 0x4e4f534a, kBinChunk = 0x004e4942;
    const std::string& bytes = file.bytes;
    GltfContainer container;
    if (!bytes.starts_with("glTF")) {
        container.json = bytes;
        if (bytes.starts_with("\xef\xbb\xbf")) container.json.remove_prefix(3);
        check_json_depth(file, container.json);
        return container;
    }
    container.is_binary = true;
    if (bytes.size() < kHeader + kChunkHeader)
        file.fail("a GLB of " + std::to_string(bytes.size()) + " bytes, expected at least 20");
    if (const uint32_t version = read_u32(bytes, 4); version != 2)
        file.fail_at_byte(4, "GLB version " + std::to_string(version) + ", expected 2");
    const uint64_t length = read_u32(bytes, 8);
    if (length > bytes.size())
        file.fail_at_byte(8, "the header says " + std::to_string(length) + " bytes, the file has " +
                                 std::to_string(bytes.size()));
    for (uint64_t at = kHeader; at + kChunkHeader <= length;) {
        const uint64_t size = read_u32(bytes, at);
        const uint32_t kind = read_u32(bytes, at + 4);
        if (size > length - at - kChunkHeader)
            file.fail_at_byte(at,
                              "a chunk of " + std::to_string(size) + " bytes goes past the end of the file");
        const std::string_view chunk = std::string_view(bytes).substr(at + kChunkHeader, size);
        if (at == kHeader && kind != kJsonChunk) file.fail_at_byte(at, "the first chunk is not JSON");
        if (at == kHeader) container.json = chunk;
        if (kind == kBinChunk && container.bin.empty()) container.bin = chunk;
        at += kChunkHeader + size;
    }
    check_json_depth(file, container.json);
    return container;
}

}  // namespace boxwood
