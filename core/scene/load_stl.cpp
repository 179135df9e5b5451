#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cstring>

#include "core/scene/readers.h"

namespace boxwood {
namespace {

constexpr size_t kHeaderSize = 84;  ///< 80 bytes of any text and the count of triangles
constexpr size_t kFacetSize = 50;   ///< normal, three corners, two bytes of attributes

bool starts_with_solid(const std::string& bytes) {
    const size_t begin = bytes.find_first_not_of(" \t\r\n");
    constexpr std::string_view kWord = "solid";
    if (begin == std::string::npos || bytes.size() - begin < kWord.size()) return false;
    return std::equal(kWord.begin(), kWord.end(), bytes.begin() + static_cast<std::ptrdiff_t>(begin),
                      [](char a, char b) { return a == std::tolower(static_cast<unsigned char>(b)); });
}

bool has_exact_binary_size(const std::string& bytes) {
    return bytes.size() >= kHeaderSize &&
           bytes.size() == kHeaderSize + uint64_t{kFacetSize} * read_u32(bytes, 80);
}

bool is_text(const std::string& bytes) {
    return starts_with_solid(bytes) && bytes.find('\0') == std::string::npos;
}

void read_binary(const InputFile& file, Scene& scene, Task& task) {
    if (file.bytes.size() < kHeaderSize)
        file.fail("an STL of " + std::to_string(file.bytes.size()) + " bytes, expected at least 84");
    const uint64_t count = read_u32(file.bytes, 80);
    const uint64_t room = (file.bytes.size() - kHeaderSize) / kFacetSize;
    if (count > room)
        file.fail_at_byte(80, "the STL declares " + std::to_string(count) +
                                  " triangles, the file has room for " + std::to_string(room));
    if (count >= kNoIndex / 3) file.fail_at_byte(80, "more corners than 32 bits can count");
    if (!has_exact_binary_size(file.bytes))
        scene.warnings.push_back("bytes after the last of " + std::to_string(count) +
                                 " triangles are ignored");
    Mesh& mesh = scene.mesh;
    mesh.positions.resize(3 * count);
    mesh.triangles.resize(count);
    for (uint64_t i = 0; i < count; ++i) {
        if (i % 4096 == 0 && task.stopped()) return;
        const size_t facet = kHeaderSize + i * kFacetSize;
        for (size_t corner = 0; corner < 3; ++corner) {
            Vec3& position = mesh.positions[3 * i + corner];
            for (int axis = 0; axis < 3; ++axis) {
                const size_t at = facet + 12 + 12 * corner + 4 * static_cast<size_t>(axis);
                position[axis] = std::bit_cast<float>(read_u32(file.bytes, at));
            }
        }
        const uint32_t first = static_cast<uint32_t>(3 * i);
        mesh.triangles[i] = {first, first + 1, first + 2};
    }
    mesh.object.assign(count, add_object(mesh, "solid"));
}

/// Reads the words of a text STL; keywords in any case.
class TextReader {
public:
    TextReader(const InputFile& file, Scene& scene, Task& task)
        : file_(file), mesh_(scene.mesh), task_(task) {}

    void read() {
        while (next_word()) {
            if (!is_word("solid")) fail("solid");
            const uint32_t object = add_object(mesh_, solid_name());
            read_facets(object);
            skip_line();  // the name after endsolid
            if (task_.stopped()) return;
        }
    }

private:
    [[noreturn]] void fail(const std::string& expected) const {
        const std::string found = word_.empty() ? "the end of the file" : in_quotes(word_);
        file_.fail_at_line(line_, "found " + found + ", expected " + expected);
    }
    bool is_word(std::string_view lower) const {
        return std::equal(word_.begin(), word_.end(), lower.begin(), lower.end(),
                          [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; });
    }
    bool next_word() {
        const std::string& text = file_.bytes;
        for (; at_ < text.size() && std::isspace(static_cast<unsigned char>(text[at_])); ++at_) {
            if (text[at_] == '\n' || (text[at_] == '\r' && (at_ + 1 == text.size() || text[at_ + 1] != '\n')))
                ++line_;
        }
        const size_t begin = at_;
        while (at_ < text.size() && !std::isspace(static_cast<unsigned char>(text[at_]))) ++at_;
        word_ = std::string_view(text).substr(begin, at_ - begin);
        return !word_.empty();
    }
    void skip_line() {
        while (at_ < file_.bytes.size() && file_.bytes[at_] != '\n' && file_.bytes[at_] != '\r') ++at_;
    }
    std::string solid_name() {
        const size_t begin = at_;
        skip_line();
        const std::string name = file_.bytes.substr(begin, at_ - begin);
        const size_t first = name.find_first_not_of(" \t");
        return first == std::string::npos ? "solid"
                                          : name.substr(first, name.find_last_not_of(" \t") + 1 - first);
    }
    void expect(const std::string& lower) {
        next_word();
        if (!is_word(lower)) fail(lower);
    }
    float read_float() {
        float value = 0.0f;
        next_word();
        if (!parse_number(word_, value)) fail("a number");
        return value;
    }
    void read_facets(uint32_t object) {
        while (true) {
            if (!next_word()) fail("facet or endsolid");
            if (is_word("endsolid")) return;
            if (!is_word("facet")) fail("facet or endsolid");
            if (mesh_.triangles.size() % 4096 == 0 && task_.stopped()) return;
            expect("normal");
            for (int i = 0; i < 3; ++i) read_float();
            expect("outer");
            expect("loop");
            const uint32_t first = static_cast<uint32_t>(mesh_.positions.size());
            for (int corner = 0; corner < 3; ++corner) {
                expect("vertex");
                const float x = read_float(), y = read_float(), z = read_float();
                mesh_.positions.push_back({x, y, z});
            }
            expect("endloop");
            expect("endfacet");
            mesh_.triangles.push_back({first, first + 1, first + 2});
            mesh_.object.push_back(object);
        }
    }

    const InputFile& file_;
    Mesh& mesh_;
    Task& task_;
    std::string_view word_;
    size_t at_ = 0;
    uint64_t line_ = 1;
};

}  // namespace

bool is_stl(const std::string& bytes) { return has_exact_binary_size(bytes) || starts_with_solid(bytes); }

void read_stl(const InputFile& file, Scene& scene, Task& task) {
    if (!has_exact_binary_size(file.bytes) && is_text(file.bytes)) {
        TextReader(file, scene, task).read();
    } else {
        read_binary(file, scene, task);
    }
}

}  // namespace boxwood
