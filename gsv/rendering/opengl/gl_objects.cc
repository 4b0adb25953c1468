#include "gsv/rendering/opengl/gl_objects.h"

#include <cstdio>
#include <cstdlib>

#include "gsv/rendering/opengl/gl.h"

namespace gsv::rendering {
namespace {

[[noreturn]] void DieOf(const char* stage, const std::string& log) {
  std::fprintf(stderr, "gsv/rendering: a shader does not %s: %s\n", stage, log.c_str());
  std::abort();
}

unsigned Compile(unsigned kind, std::string_view defines, std::string_view source) {
  const std::string text =
      "#version 450 core\n" + std::string(defines) + "#line 1\n" + std::string(source);
  const unsigned shader = glCreateShader(kind);
  const char* pointer = text.c_str();
  glShaderSource(shader, 1, &pointer, nullptr);
  glCompileShader(shader);
  int ok = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
  if (!ok) {
    std::string log(4096, '\0');
    glGetShaderInfoLog(shader, static_cast<int>(log.size()), nullptr, log.data());
    DieOf("compile", log);
  }
  return shader;
}

}  // namespace

void FreeBuffer(unsigned name) { glDeleteBuffers(1, &name); }
void FreeTexture(unsigned name) { glDeleteTextures(1, &name); }
void FreeVertexArray(unsigned name) { glDeleteVertexArrays(1, &name); }
void FreeFramebuffer(unsigned name) { glDeleteFramebuffers(1, &name); }
void FreeRenderbuffer(unsigned name) { glDeleteRenderbuffers(1, &name); }
void FreeProgram(unsigned name) { glDeleteProgram(name); }

GlBuffer CreateBuffer() {
  unsigned name = 0;
  glCreateBuffers(1, &name);
  return GlBuffer(name);
}

GlTexture CreateTexture2D() {
  unsigned name = 0;
  glCreateTextures(GL_TEXTURE_2D, 1, &name);
  return GlTexture(name);
}

GlVertexArray CreateVertexArray() {
  unsigned name = 0;
  glCreateVertexArrays(1, &name);
  return GlVertexArray(name);
}

GlFramebuffer CreateFramebuffer() {
  unsigned name = 0;
  glCreateFramebuffers(1, &name);
  return GlFramebuffer(name);
}

GlRenderbuffer CreateRenderbuffer() {
  unsigned name = 0;
  glCreateRenderbuffers(1, &name);
  return GlRenderbuffer(name);
}

GlProgram CreateProgram(std::string_view defines, std::string_view vertex_source,
                        std::string_view fragment_source) {
  const unsigned vertex = Compile(GL_VERTEX_SHADER, defines, vertex_source);
  const unsigned fragment = Compile(GL_FRAGMENT_SHADER, defines, fragment_source);
  GlProgram program(glCreateProgram());
  glAttachShader(program.name(), vertex);
  glAttachShader(program.name(), fragment);
  glLinkProgram(program.name());
  glDeleteShader(vertex);
  glDeleteShader(fragment);
  int ok = 0;
  glGetProgramiv(program.name(), GL_LINK_STATUS, &ok);
  if (!ok) {
    std::string log(4096, '\0');
    glGetProgramInfoLog(program.name(), static_cast<int>(log.size()), nullptr, log.data());
    DieOf("link", log);
  }
  return program;
}

}  // namespace gsv::rendering
