#include "gsv/rendering/opengl/instance_buffer.h"

#include "gsv/rendering/opengl/gl.h"
#include "gsv/rendering/opengl/gpu_mesh.h"
#include "gsv/rendering/opengl/shaders.h"

namespace gsv::rendering {
namespace {

constexpr unsigned kMeshBinding = 0, kInstanceBinding = 1;

void AddAttribute(unsigned arrays, unsigned attribute, int components, std::size_t offset,
                  unsigned binding) {
  glEnableVertexArrayAttrib(arrays, attribute);
  glVertexArrayAttribFormat(arrays, attribute, components, GL_FLOAT, GL_FALSE,
                            static_cast<unsigned>(offset));
  glVertexArrayAttribBinding(arrays, attribute, binding);
}

}  // namespace

InstanceData InstanceOf(const DrawItem& item, const PlacedItem& placed,
                        const geometry::Vector3& origin) {
  const auto& [x, y, z] = placed.columns;
  const geometry::Vector3 t = placed.origin - origin;
  const auto f = [](double value) { return static_cast<float>(value); };
  return {{{f(x.x), f(y.x), f(z.x), f(t.x)},
           {f(x.y), f(y.y), f(z.y), f(t.y)},
           {f(x.z), f(y.z), f(z.z), f(t.z)}},
          item.factors};
}

InstanceBuffer::InstanceBuffer() : arrays_(CreateVertexArray()), instances_(CreateBuffer()) {
  const unsigned name = arrays_.name();
  AddAttribute(name, kPositionAttribute, 3, 0, kMeshBinding);
  AddAttribute(name, kNormalAttribute, 3, 3 * sizeof(float), kMeshBinding);
  AddAttribute(name, kUvAttribute, 2, 6 * sizeof(float), kMeshBinding);
  AddAttribute(name, kSurfaceAttribute, 1, 8 * sizeof(float), kMeshBinding);
  unsigned attribute = kFirstInstanceAttribute;
  for (std::size_t row = 0; row < 3; ++row) {
    AddAttribute(name, attribute++, 4, row * 4 * sizeof(float), kInstanceBinding);
  }
  const std::size_t factors = offsetof(InstanceData, factors);
  AddAttribute(name, attribute++, 4, factors + offsetof(SurfaceFactors, base_colour),
               kInstanceBinding);
  AddAttribute(name, attribute++, 4, factors + offsetof(SurfaceFactors, emissive_metalness),
               kInstanceBinding);
  AddAttribute(name, attribute++, 2, factors + offsetof(SurfaceFactors, roughness),
               kInstanceBinding);
  glVertexArrayBindingDivisor(name, kInstanceBinding, 1);
}

void InstanceBuffer::Upload(const std::vector<InstanceData>& instances) {
  if (!instances.empty()) {
    glNamedBufferData(instances_.name(),
                      static_cast<GLsizeiptr>(instances.size() * sizeof(InstanceData)),
                      instances.data(), GL_STREAM_DRAW);
  }
  glVertexArrayVertexBuffer(arrays_.name(), kInstanceBinding, instances_.name(), 0,
                            sizeof(InstanceData));
  glBindVertexArray(arrays_.name());
}

void InstanceBuffer::Draw(const DrawGroup& group, std::size_t first, std::size_t count) const {
  const auto& mesh = static_cast<const GpuMesh&>(*group.mesh);
  glVertexArrayVertexBuffer(arrays_.name(), kMeshBinding, mesh.vertices.name(), 0,
                            kVertexFloats * sizeof(float));
  glVertexArrayElementBuffer(arrays_.name(), mesh.indices.name());
  const std::size_t offset = group.first_index * sizeof(std::uint32_t);
  glDrawElementsInstancedBaseInstance(GL_TRIANGLES, static_cast<int>(group.index_count),
                                      GL_UNSIGNED_INT, reinterpret_cast<const void*>(offset),
                                      static_cast<int>(count), static_cast<unsigned>(first));
}

}  // namespace gsv::rendering
