#include "app/gl/program.h"

#include <cstring>
#include <stdexcept>

#include <glm/gtc/type_ptr.hpp>

#include "app/gl/embedded_shaders.h"

namespace boxwood {
namespace {

constexpr const char* kHeader = "#version 450 core\n";

struct ShaderKind {
    static void destroy(GLuint name) { glDeleteShader(name); }
};
using Shader = GlObject<ShaderKind>;

Shader compile(GLenum stage, const char* file_name) {
    Shader shader(glCreateShader(stage));
    const std::string source = shader_source(file_name);
    const char* parts[] = {kHeader, source.c_str()};
    glShaderSource(shader.name(), 2, parts, nullptr);
    glCompileShader(shader.name());
    GLint is_compiled = GL_FALSE;
    glGetShaderiv(shader.name(), GL_COMPILE_STATUS, &is_compiled);
    if (is_compiled == GL_TRUE) return shader;
    std::string log(4096, '\0');
    GLsizei length = 0;
    glGetShaderInfoLog(shader.name(), static_cast<GLsizei>(log.size()), &length, log.data());
    log.resize(static_cast<size_t>(length));
    throw std::logic_error(std::string(file_name) + ": " + log);
}

GlObject<ProgramKind> link(std::span<const Shader> shaders, const char* file_name) {
    GlObject<ProgramKind> program(glCreateProgram());
    for (const Shader& shader : shaders) glAttachShader(program.name(), shader.name());
    glLinkProgram(program.name());
    for (const Shader& shader : shaders) glDetachShader(program.name(), shader.name());
    GLint is_linked = GL_FALSE;
    glGetProgramiv(program.name(), GL_LINK_STATUS, &is_linked);
    if (is_linked == GL_TRUE) return program;
    std::string log(4096, '\0');
    GLsizei length = 0;
    glGetProgramInfoLog(program.name(), static_cast<GLsizei>(log.size()), &length, log.data());
    log.resize(static_cast<size_t>(length));
    throw std::logic_error(std::string(file_name) + ": " + log);
}

}  // namespace

std::string shader_source(const std::string& file_name) {
    constexpr const char* kInclude = "#include \"";
    for (const EmbeddedShader& shader : embedded_shaders()) {
        if (file_name != shader.name) continue;
        std::string text = shader.source;
        for (size_t at = text.find(kInclude); at != std::string::npos; at = text.find(kInclude, at)) {
            const size_t name_begin = at + std::strlen(kInclude);
            const size_t name_end = text.find('"', name_begin);
            const std::string included = shader_source(text.substr(name_begin, name_end - name_begin));
            text.replace(at, name_end + 1 - at, included);
        }
        return text;
    }
    throw std::logic_error("no shader " + file_name + " is embedded");
}

Program::Program(const char* vertex, const char* fragment) {
    const Shader shaders[] = {compile(GL_VERTEX_SHADER, vertex), compile(GL_FRAGMENT_SHADER, fragment)};
    program_ = link(shaders, fragment);
}

Program::Program(const char* compute) {
    const Shader shaders[] = {compile(GL_COMPUTE_SHADER, compute)};
    program_ = link(shaders, compute);
}

void Program::set(const char* name, int value) const {
    glProgramUniform1i(program_.name(), location(name), value);
}
void Program::set(const char* name, uint32_t value) const {
    glProgramUniform1ui(program_.name(), location(name), value);
}
void Program::set(const char* name, float value) const {
    glProgramUniform1f(program_.name(), location(name), value);
}
void Program::set(const char* name, const Vec2& value) const {
    glProgramUniform2fv(program_.name(), location(name), 1, glm::value_ptr(value));
}
void Program::set(const char* name, const Vec3& value) const {
    glProgramUniform3fv(program_.name(), location(name), 1, glm::value_ptr(value));
}
void Program::set(const char* name, const Vec4& value) const {
    glProgramUniform4fv(program_.name(), location(name), 1, glm::value_ptr(value));
}
void Program::set(const char* name, std::span<const Vec3> values) const {
    glProgramUniform3fv(program_.name(), location(name), static_cast<GLsizei>(values.size()),
                        glm::value_ptr(values.front()));
}
void Program::set(const char* name, std::span<const Vec4> values) const {
    glProgramUniform4fv(program_.name(), location(name), static_cast<GLsizei>(values.size()),
                        glm::value_ptr(values.front()));
}

}  // namespace boxwood
