#include "core/scene/import_stream.h"

#include <cstring>
#include <type_traits>

namespace boxwood {
namespace {

constexpr char kMeshMark = 'M', kFailureMark = 'F';

class StreamWriter {
public:
    explicit StreamWriter(char mark) : bytes_(1, mark) {}
    void write_text(const std::string& text) {
        const uint64_t count = text.size();
        append(&count, sizeof count);
        append(text.data(), text.size());
    }
    template <class T, class Allocator>
    void write_array(const std::vector<T, Allocator>& values) {
        static_assert(std::is_trivially_copyable_v<T>);
        const uint64_t count = values.size();
        append(&count, sizeof count);
        append(values.data(), values.size() * sizeof(T));
    }
    template <class T>
    void write(const T& value) {
        append(&value, sizeof value);
    }
    std::string take() { return std::move(bytes_); }

private:
    void append(const void* data, size_t size) { bytes_.append(static_cast<const char*>(data), size); }
    std::string bytes_;
};

class StreamReader {
public:
    StreamReader(const InputFile& file, const std::string& bytes) : file_(file), bytes_(bytes) {}
    template <class T>
    T read() {
        T value{};
        copy(&value, sizeof value);
        return value;
    }
    uint64_t read_count(size_t element_size) {
        const uint64_t count = read<uint64_t>();
        if (count > (bytes_.size() - at_) / element_size) fail();
        return count;
    }
    std::string read_text() {
        std::string text(read_count(1), '\0');
        copy(text.data(), text.size());
        return text;
    }
    template <class T, class Allocator>
    void read_array(std::vector<T, Allocator>& values) {
        values.resize(read_count(sizeof(T)));
        copy(values.data(), values.size() * sizeof(T));
    }
    [[noreturn]] void fail() const { file_.fail("the import ended without a whole result"); }

private:
    void copy(void* data, size_t size) {
        if (size > bytes_.size() - at_) fail();
        if (size == 0) return;
        std::memcpy(data, bytes_.data() + at_, size);
        at_ += size;
    }
    const InputFile& file_;
    const std::string& bytes_;
    size_t at_ = 0;
};

}  // namespace

std::string write_import_stream(const Mesh& mesh) {
    StreamWriter writer(kMeshMark);
    writer.write_array(mesh.positions);
    writer.write_array(mesh.triangles);
    writer.write_array(mesh.object);
    writer.write(uint64_t{mesh.objects.size()});
    for (const MeshObject& object : mesh.objects) {
        writer.write_text(object.name);
        writer.write(object.base_color);
    }
    return writer.take();
}

std::string write_import_failure(const std::string& sentence) {
    StreamWriter writer(kFailureMark);
    writer.write_text(sentence);
    return writer.take();
}

void read_import_stream(const InputFile& file, const std::string& stream, Scene& scene) {
    StreamReader reader(file, stream);
    const char mark = reader.read<char>();
    if (mark == kFailureMark) file.fail("the import refused it: " + in_quotes(reader.read_text()));
    if (mark != kMeshMark) reader.fail();
    Mesh& mesh = scene.mesh;
    reader.read_array(mesh.positions);
    reader.read_array(mesh.triangles);
    reader.read_array(mesh.object);
    const uint64_t object_count = reader.read_count(sizeof(uint64_t) + sizeof(Vec3));
    for (uint64_t i = 0; i < object_count; ++i) {
        const std::string name = reader.read_text();
        const Vec3 color = reader.read<Vec3>();
        add_object(mesh, name, glm::clamp(color, Vec3(0.0f), Vec3(1.0f)));
    }
    if (mesh.object.size() != mesh.triangles.size()) reader.fail();
    for (const uint32_t object : mesh.object) {
        if (object >= mesh.objects.size()) reader.fail();
    }
}

}  // namespace boxwood
