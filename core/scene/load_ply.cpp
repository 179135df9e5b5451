#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <optional>

#include "core/scene/ply_header.h"
#include "core/scene/polygon.h"
#include "core/scene/readers.h"

namespace boxwood {
namespace {

constexpr uint32_t kRestart = 0xffffffffu;  ///< stands for -1, the end of a strip

std::string shown(double value) {
    std::array<char, 32> text;
    std::snprintf(text.data(), text.size(), "%.10g", value);
    return text.data();
}

/// The values after the header, one by one, of any format.
class PlyBody {
public:
    PlyBody(const InputFile& file, const PlyHeader& header)
        : file_(file), format_(header.format), at_(header.body), line_(header.body_line) {}

    bool is_ascii() const { return format_ == PlyFormat::Ascii; }
    uint64_t bytes_left() const { return file_.bytes.size() - at_; }
    [[noreturn]] void fail(const std::string& sentence) const {
        if (is_ascii()) file_.fail_at_line(line_, sentence);
        file_.fail_at_byte(at_, sentence);
    }

    double read(PlyType type) {
        if (is_ascii()) return read_word(type);
        switch (type) {
            case PlyType::Int8:
                return read_binary<int8_t, uint8_t>();
            case PlyType::UInt8:
                return read_binary<uint8_t, uint8_t>();
            case PlyType::Int16:
                return read_binary<int16_t, uint16_t>();
            case PlyType::UInt16:
                return read_binary<uint16_t, uint16_t>();
            case PlyType::Int32:
                return read_binary<int32_t, uint32_t>();
            case PlyType::UInt32:
                return read_binary<uint32_t, uint32_t>();
            case PlyType::Float:
                return static_cast<double>(read_binary<float, uint32_t>());
            case PlyType::Double:
                break;
        }
        return read_binary<double, uint64_t>();
    }

    /// A list's length, checked against what is left of the file.
    uint64_t read_list_length(const PlyProperty& property) {
        const double length = read(property.count_type);
        if (!(length >= 0.0) || length != std::floor(length))
            fail("a list of length " + shown(length) + ", expected a whole number from 0");
        const double bytes = is_ascii() ? 1.0 : static_cast<double>(ply_type_size(property.type));
        if (length * bytes > static_cast<double>(bytes_left()))
            fail("a list of " + shown(length) + " values goes past the end of the file");
        return static_cast<uint64_t>(length);
    }

    void skip(const PlyProperty& property) {
        const uint64_t count = property.is_list ? read_list_length(property) : 1;
        if (is_ascii()) {
            for (uint64_t i = 0; i < count; ++i) next_word();
            return;
        }
        const uint64_t bytes = count * ply_type_size(property.type);
        if (bytes > bytes_left()) fail("the file ends too early");
        at_ += bytes;
    }

private:
    template <class Value, class Bits>
    Value read_binary() {
        if (bytes_left() < sizeof(Bits)) fail("the file ends too early");
        std::array<char, sizeof(Bits)> raw;
        std::memcpy(raw.data(), file_.bytes.data() + at_, raw.size());
        if ((format_ == PlyFormat::BigEndian) == (std::endian::native == std::endian::little))
            std::reverse(raw.begin(), raw.end());
        at_ += raw.size();
        return std::bit_cast<Value>(raw);
    }
    std::string_view next_word() {
        const std::string& text = file_.bytes;
        const auto is_blank = [](char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; };
        for (; at_ < text.size() && is_blank(text[at_]); ++at_) {
            const bool is_pair = text[at_] == '\n' && at_ > 0 && text[at_ - 1] == '\r';
            if ((text[at_] == '\n' && !is_pair) || text[at_] == '\r') ++line_;
        }
        if (at_ == text.size()) fail("the file ends too early");
        const size_t begin = at_;
        while (at_ < text.size() && !is_blank(text[at_])) ++at_;
        return std::string_view(text).substr(begin, at_ - begin);
    }
    double read_word(PlyType type) {
        const std::string_view word = next_word();
        float single = 0.0f;
        double value = 0.0;
        const bool is_number =
            type == PlyType::Float ? parse_number(word, single) : parse_number(word, value);
        if (!is_number) fail("found " + in_quotes(word) + ", expected a number");
        return type == PlyType::Float ? static_cast<double>(single) : value;
    }

    const InputFile& file_;
    PlyFormat format_;
    size_t at_;
    uint64_t line_;
};

/// Polygons or strips as they stand in the file: list i ends before ends[i].
struct IndexLists {
    std::vector<uint32_t> values;
    std::vector<size_t> ends;
};

class PlyReader {
public:
    PlyReader(const InputFile& file, Task& task)
        : task_(task), header_(parse_ply_header(file)), body_(file, header_) {}

    void read(Scene& scene) {
        for (const PlyElement& element : header_.elements) {
            check_size(element);
            if (element.name == "vertex") {
                read_vertices(element, scene.mesh);
            } else if (element.name == "face") {
                read_lists(element, faces_);
            } else if (element.name == "tristrips") {
                read_lists(element, strips_);
            } else {
                read_rows(element, [](size_t) { return false; });
            }
            if (task_.stopped()) return;
        }
        add_triangles(scene.mesh);
        if (scene.mesh.triangles.empty()) {
            scene.mesh.points.positions = std::move(scene.mesh.positions);
            scene.mesh.points.normals = std::move(normals_);
            scene.mesh.positions.clear();
        }
    }

private:
    /// Before anything is allocated: each value takes at least a byte of text, or its size in binary.
    void check_size(const PlyElement& element) const {
        uint64_t row = 0;
        for (const PlyProperty& p : element.properties)
            row += body_.is_ascii() ? 1 : ply_type_size(p.is_list ? p.count_type : p.type);
        if (row != 0 && element.count > body_.bytes_left() / row)
            body_.fail("the header declares " + std::to_string(element.count) + " of element " +
                       in_quotes(element.name) + ", the rest of the file has " +
                       std::to_string(body_.bytes_left()) + " bytes");
    }

    /// Calls on_property(index) in file order for each row; what it does not consume (false) is skipped.
    template <class OnProperty>
    void read_rows(const PlyElement& element, const OnProperty& on_property) {
        if (element.properties.empty()) return;
        for (uint64_t row = 0; row < element.count; ++row) {
            if (row % 4096 == 0 && task_.stopped()) return;
            for (size_t p = 0; p < element.properties.size(); ++p) {
                if (!on_property(p)) body_.skip(element.properties[p]);
            }
        }
    }

    void read_vertices(const PlyElement& element, Mesh& mesh) {
        const std::array<const char*, 6> names = {"x", "y", "z", "nx", "ny", "nz"};
        std::array<bool, 6> has{};
        std::vector<std::optional<size_t>> slot(element.properties.size());
        for (size_t p = 0; p < slot.size(); ++p) {
            for (size_t i = 0; i < names.size(); ++i) {
                if (element.properties[p].name != names[i] || element.properties[p].is_list) continue;
                slot[p] = i;
                has[i] = true;
            }
        }
        if (!has[0] || !has[1] || !has[2]) body_.fail("element vertex needs the properties x, y and z");
        const bool has_normals = has[3] && has[4] && has[5];
        if (element.count >= kNoIndex) body_.fail("more vertices than 32 bits can count");
        mesh.positions.reserve(element.count);
        if (has_normals) normals_.reserve(element.count);
        std::array<float, 6> vertex{};
        read_rows(element, [&](size_t p) {
            if (slot[p]) vertex[*slot[p]] = static_cast<float>(body_.read(element.properties[p].type));
            if (p + 1 == slot.size()) {
                if (!slot[p]) body_.skip(element.properties[p]);
                mesh.positions.push_back({vertex[0], vertex[1], vertex[2]});
                if (has_normals) normals_.push_back({vertex[3], vertex[4], vertex[5]});
                return true;
            }
            return slot[p].has_value();
        });
    }

    void read_lists(const PlyElement& element, IndexLists& lists) {
        std::optional<size_t> indices;
        for (size_t p = 0; p < element.properties.size(); ++p) {
            const PlyProperty& property = element.properties[p];
            if (property.is_list && (property.name == "vertex_indices" || property.name == "vertex_index"))
                indices = p;
        }
        if (!indices)
            body_.fail("element " + element.name + " needs the list property vertex_indices or vertex_index");
        const PlyProperty& property = element.properties[*indices];
        const uint64_t vertex_count = declared_vertex_count();
        const bool is_strip = &lists == &strips_;
        lists.ends.reserve(element.count);
        read_rows(element, [&](size_t p) {
            if (p != *indices) return false;
            const uint64_t length = body_.read_list_length(property);
            for (uint64_t i = 0; i < length; ++i) {
                const double index = body_.read(property.type);
                if (is_strip && index == -1.0) {
                    lists.values.push_back(kRestart);
                    continue;
                }
                if (!(index >= 0.0 && index < static_cast<double>(vertex_count)) ||
                    index != std::floor(index))
                    body_.fail("vertex index " + shown(index) + " in row " +
                               std::to_string(lists.ends.size()) + " of element " + element.name +
                               ", expected 0 to " + std::to_string(vertex_count) + " - 1");
                lists.values.push_back(static_cast<uint32_t>(index));
            }
            lists.ends.push_back(lists.values.size());
            return true;
        });
    }

    uint64_t declared_vertex_count() const {
        for (const PlyElement& element : header_.elements) {
            if (element.name == "vertex") return element.count;
        }
        return 0;
    }

    void add_triangles(Mesh& mesh) {
        mesh.triangles.reserve(faces_.ends.size());
        size_t begin = 0;
        for (const size_t end : faces_.ends) {
            cut_polygon(mesh.positions, std::span(faces_.values).subspan(begin, end - begin), mesh.triangles);
            begin = end;
        }
        begin = 0;
        for (const size_t end : strips_.ends) {
            add_strips(std::span(strips_.values).subspan(begin, end - begin), mesh);
            begin = end;
        }
        if (mesh.triangles.empty()) return;
        mesh.object.assign(mesh.triangles.size(), add_object(mesh, "mesh"));
    }

    /// Every second triangle of a strip is turned round, so that all face the same way.
    static void add_strips(std::span<const uint32_t> strip, Mesh& mesh) {
        size_t start = 0;
        for (size_t i = 0; i < strip.size(); ++i) {
            if (strip[i] == kRestart) {
                start = i + 1;
            } else if (i >= start + 2) {
                const bool is_turned = (i - start) % 2 == 1;
                mesh.triangles.push_back(
                    {strip[i - 2], strip[is_turned ? i : i - 1], strip[is_turned ? i - 1 : i]});
            }
        }
    }

    Task& task_;
    PlyHeader header_;
    PlyBody body_;
    std::vector<Vec3> normals_;
    IndexLists faces_, strips_;
};

}  // namespace

void read_ply(const InputFile& file, Scene& scene, Task& task) { PlyReader(file, task).read(scene); }

}  // namespace boxwood
