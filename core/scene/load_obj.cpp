#include <tiny_obj_loader.h>

#include <algorithm>
#include <filesystem>
#include <istream>
#include <map>
#include <sstream>
#include <streambuf>

#include "core/base/error.h"
#include "core/scene/polygon.h"
#include "core/scene/readers.h"

namespace boxwood {
namespace {

std::string_view trim(std::string_view text) {
    const size_t begin = text.find_first_not_of(" \t");
    if (begin == std::string_view::npos) return {};
    return text.substr(begin, text.find_last_not_of(" \t") + 1 - begin);
}

/// Whether a line is the statement `keyword`.
bool is_statement(std::string_view line, std::string_view keyword) {
    return line.size() > keyword.size() && line.starts_with(keyword) &&
           (line[keyword.size()] == ' ' || line[keyword.size()] == '\t');
}

/// Hands the file to tinyobjloader one statement at a time, so that the line of a face is known when it is
/// called back. Joins lines that a backslash carries on; takes LF, CR LF and CR as line ends. Coordinates
/// are read here, because tinyobjloader takes a word for 0 and rounds twice; normals and texture coordinates
/// are not read at all.
class ObjStatements : public std::streambuf {
public:
    ObjStatements(const InputFile& file, Array<Vec3>& positions, Task& task)
        : file_(file), positions_(positions), task_(task) {}

    uint64_t line() const { return line_; }

protected:
    int_type underflow() override {
        while (next_line()) {
            const std::string_view text = trim(statement_);
            if (text.empty() || text[0] == '#' || is_statement(text, "vn") || is_statement(text, "vt"))
                continue;
            if (is_statement(text, "v")) {
                read_vertex(text.substr(1));
                continue;
            }
            if (is_statement(text, "l") || is_statement(text, "p")) {
                task_.skipped.add("line or point", 1);
                continue;
            }
            if (is_statement(text, "f")) check_face(text);
            statement_ += '\n';
            setg(statement_.data(), statement_.data(), statement_.data() + statement_.size());
            return traits_type::to_int_type(*gptr());
        }
        return traits_type::eof();
    }

private:
    /// Puts the next whole statement into statement_, and the number of its first line into line_.
    bool next_line() {
        const std::string& text = file_.bytes;
        if (at_ >= text.size() || (++statements_ % 1024 == 0 && task_.stopped())) return false;
        statement_.clear();
        line_ = next_line_;
        while (at_ < text.size()) {
            const size_t end = std::min(text.find_first_of("\r\n", at_), text.size());
            statement_.append(text, at_, end - at_);
            const bool is_pair = text.compare(end, 2, "\r\n") == 0;
            at_ = end + (is_pair ? 2 : 1);
            ++next_line_;
            if (statement_.empty() || statement_.back() != '\\') break;
            statement_.back() = ' ';
        }
        std::replace(statement_.begin(), statement_.end(), '\0', ' ');
        return true;
    }

    void read_vertex(std::string_view rest) {
        Vec3 position(0.0f);
        for (int axis = 0; axis < 3; ++axis) {
            rest = trim(rest);
            const std::string_view word = rest.substr(0, rest.find_first_of(" \t"));
            if (!parse_number(word, position[axis]))
                file_.fail_at_line(line_, "found " + in_quotes(word) + ", expected the " +
                                              std::string(1, "xyz"[axis]) + " coordinate of a vertex");
            rest.remove_prefix(word.size());
        }
        if (positions_.size() + 1 >= kNoIndex)
            file_.fail_at_line(line_, "more vertices than 32 bits can count");
        positions_.push_back(position);
    }

    /// Refuses what tinyobjloader would take for some other number; a comment behind the face is cut off.
    void check_face(std::string_view text) {
        constexpr size_t kMostDigits = 9;
        size_t digits = 0;
        for (size_t i = 1; i < text.size(); ++i) {
            const char c = text[i];
            if (c == '#') {
                statement_ = std::string(text.substr(0, i));
                return;
            }
            const bool is_digit = c >= '0' && c <= '9';
            digits = is_digit ? digits + 1 : 0;
            if (digits > kMostDigits) file_.fail_at_line(line_, "a vertex index of more than nine digits");
            if (!is_digit && c != ' ' && c != '\t' && c != '/' && c != '-')
                file_.fail_at_line(line_, "found " + in_quotes(text) + ", expected a face of vertex indices");
        }
    }

    const InputFile& file_;
    Array<Vec3>& positions_;
    Task& task_;
    std::string statement_;
    size_t at_ = 0;
    uint64_t line_ = 0, next_line_ = 1, statements_ = 0;
};

/// Reads the material files beside the OBJ, and keeps the colours.
class Materials : public tinyobj::MaterialReader {
public:
    Materials(const InputFile& file, Scene& scene) : file_(file), scene_(scene) {}

    const Vec3& color(int material) const {
        return material < 0 ? kDefault : colors_[static_cast<size_t>(material)];
    }

    bool operator()(const std::string& name, std::vector<tinyobj::material_t>* materials,
                    std::map<std::string, int>* ids, std::string* /*warn*/, std::string* /*err*/) override {
        const std::string folder = folder_of(file_.path);
        const std::string path = folder + "/" + name;
        if (!is_inside_folder(folder, path)) return warn(name, "lies outside of the file's folder");
        InputFile library;
        try {
            library = read_input_file(path);
        } catch (const Error&) {
            return warn(name, "cannot be read");
        }
        std::istringstream stream(library.bytes);
        std::string unused_warning, unused_error;
        tinyobj::LoadMtl(ids, materials, &stream, &unused_warning, &unused_error);
        colors_.clear();
        for (const tinyobj::material_t& m : *materials) {
            const Vec3 color(m.diffuse[0], m.diffuse[1], m.diffuse[2]);
            colors_.push_back(glm::clamp(color, Vec3(0.0f), Vec3(1.0f)));
        }
        return true;
    }

private:
    bool warn(const std::string& name, const std::string& what) {
        scene_.warnings.push_back("the material file " + in_quotes(name) + " " + what +
                                  "; its colours are grey");
        return false;
    }

    inline static const Vec3 kDefault = MeshObject{}.base_color;
    const InputFile& file_;
    Scene& scene_;
    std::vector<Vec3> colors_;
};

/// Takes tinyobjloader's calls for one file.
class ObjReader {
public:
    ObjReader(const InputFile& file, Scene& scene, Task& task)
        : file_(file),
          mesh_(scene.mesh),
          task_(task),
          materials_(file, scene),
          statements_(file, scene.mesh.positions, task) {}

    void read() {
        tinyobj::callback_t calls;
        calls.index_cb = [](void* self, tinyobj::index_t* corners, int count) {
            static_cast<ObjReader*>(self)->add_face(std::span(corners, static_cast<size_t>(count)));
        };
        calls.usemtl_cb = [](void* self, const char*, int id) {
            static_cast<ObjReader*>(self)->material_ = id;
        };
        calls.object_cb = [](void* self, const char* name) { static_cast<ObjReader*>(self)->name_ = name; };
        calls.group_cb = [](void* self, const char** names, int count) {
            if (count > 0) static_cast<ObjReader*>(self)->name_ = names[0];
        };
        std::istream stream(&statements_);
        stream.exceptions(std::ios::badbit);  // lets an Error of underflow through
        tinyobj::LoadObjWithCallback(stream, calls, this, &materials_);
        if (small_faces_ > 0) task_.skipped.add("face with fewer than three corners", small_faces_);
    }

private:
    void add_face(std::span<const tinyobj::index_t> corners) {
        const int64_t vertex_count = static_cast<int64_t>(mesh_.positions.size());
        corners_.clear();
        for (const tinyobj::index_t& corner : corners) {
            const int64_t index = corner.vertex_index;  // from 1, or back from -1, the last vertex so far
            const int64_t vertex = index > 0 ? index - 1 : vertex_count + index;
            if (index == 0 || vertex < 0 || vertex >= vertex_count)
                file_.fail_at_line(statements_.line(), "vertex index " + std::to_string(index) +
                                                           ", expected 1 to " + std::to_string(vertex_count) +
                                                           " or -1 to -" + std::to_string(vertex_count));
            corners_.push_back(static_cast<uint32_t>(vertex));
        }
        if (corners_.size() < 3) {
            ++small_faces_;
            return;
        }
        cut_polygon(mesh_.positions, corners_, mesh_.triangles);
        mesh_.object.resize(mesh_.triangles.size(), current_object());
    }

    /// One object for each pair of a name and a material.
    uint32_t current_object() {
        const auto [found, is_new] = objects_.try_emplace({name_, material_}, 0);
        if (is_new) found->second = add_object(mesh_, name_, materials_.color(material_));
        return found->second;
    }

    const InputFile& file_;
    Mesh& mesh_;
    Task& task_;
    Materials materials_;
    ObjStatements statements_;
    std::string name_ = "mesh";
    int material_ = -1;
    std::map<std::pair<std::string, int>, uint32_t> objects_;
    std::vector<uint32_t> corners_;
    uint64_t small_faces_ = 0;
};

}  // namespace

void read_obj(const InputFile& file, Scene& scene, Task& task) { ObjReader(file, scene, task).read(); }

}  // namespace boxwood
