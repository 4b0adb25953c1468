// Classes that own one OpenGL object each and delete it in their destructor, and a function that
// compiles shader programs.
//
// Threads  only the thread whose context is current, also for destruction.
#pragma once

#include <string>
#include <string_view>
#include <utility>

namespace gsv::rendering {

void FreeBuffer(unsigned name);
void FreeTexture(unsigned name);
void FreeVertexArray(unsigned name);
void FreeFramebuffer(unsigned name);
void FreeRenderbuffer(unsigned name);
void FreeProgram(unsigned name);

// Owns one OpenGL object, and deletes it in the destructor.
template <void (*Free)(unsigned)>
class GlObject {
 public:
  GlObject() = default;
  explicit GlObject(unsigned name) : name_(name) {}
  GlObject(GlObject&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  GlObject& operator=(GlObject&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
  }
  ~GlObject() {
    if (name_ != 0) Free(name_);
  }
  unsigned name() const { return name_; }

 private:
  unsigned name_ = 0;
};

using GlBuffer = GlObject<FreeBuffer>;
using GlTexture = GlObject<FreeTexture>;
using GlVertexArray = GlObject<FreeVertexArray>;
using GlFramebuffer = GlObject<FreeFramebuffer>;
using GlRenderbuffer = GlObject<FreeRenderbuffer>;
using GlProgram = GlObject<FreeProgram>;

GlBuffer CreateBuffer();
GlTexture CreateTexture2D();
GlVertexArray CreateVertexArray();
GlFramebuffer CreateFramebuffer();
GlRenderbuffer CreateRenderbuffer();

// Compiles a program. Inserts `defines` ("#define A\n…") after the #version line. The sources must
// be valid.
GlProgram CreateProgram(std::string_view defines, std::string_view vertex_source,
                        std::string_view fragment_source);

}  // namespace gsv::rendering
