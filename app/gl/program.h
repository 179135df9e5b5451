#pragma once

#include <string>

#include "app/gl/gl_object.h"
#include "core/base/vec.h"

namespace boxwood {

struct ProgramKind {
    static void destroy(GLuint name) { glDeleteProgram(name); }
};

/// A linked program of the shaders embedded from shaders/. A shader that does not compile is our own mistake:
/// the constructor throws std::logic_error with the compiler's log.
class Program {
public:
    /// The vertex and the fragment shader of these file names: ("boxes.vert", "boxes.frag").
    Program(const char* vertex, const char* fragment);
    /// The compute shader of this file name.
    explicit Program(const char* compute);

    void use() const { glUseProgram(program_.name()); }
    /// Sets a uniform by its name; one that the compiler removed is passed over.
    void set(const char* name, int value) const;
    void set(const char* name, uint32_t value) const;
    void set(const char* name, float value) const;
    void set(const char* name, const Vec2& value) const;
    void set(const char* name, const Vec3& value) const;
    void set(const char* name, const Vec4& value) const;
    void set(const char* name, std::span<const Vec3> values) const;
    void set(const char* name, std::span<const Vec4> values) const;

private:
    GLint location(const char* name) const { return glGetUniformLocation(program_.name(), name); }
    GlObject<ProgramKind> program_;
};

/// Text of an embedded file of shaders/, with the files that it names in lines `#include "file"` put in
/// place.
std::string shader_source(const std::string& file_name);

}  // namespace boxwood
