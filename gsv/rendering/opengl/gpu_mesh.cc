#include "gsv/rendering/opengl/gpu_mesh.h"

#include <algorithm>

#include "gsv/rendering/opengl/gl.h"

namespace gsv::rendering {
namespace {

template <typename T>
GlBuffer Upload(const std::vector<T>& values) {
  GlBuffer buffer = CreateBuffer();
  // OpenGL refuses an empty buffer, so an empty mesh gets one element, which is never drawn.
  const T none{};
  glNamedBufferStorage(buffer.name(),
                       static_cast<GLsizeiptr>(std::max<std::size_t>(1, values.size()) * sizeof(T)),
                       values.empty() ? &none : values.data(), 0);
  return buffer;
}

}  // namespace

std::shared_ptr<const DrawMesh> UploadMesh(MeshArrays arrays) {
  auto mesh = std::make_shared<GpuMesh>();
  mesh->chunks = std::move(arrays.chunks);
  mesh->vertices = Upload(arrays.vertices);
  mesh->indices = Upload(arrays.indices);
  return mesh;
}

}  // namespace gsv::rendering
