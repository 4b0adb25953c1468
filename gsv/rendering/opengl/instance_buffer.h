// The vertex arrays of a draw call: a mesh's vertices, and the data of its instances.
//
// Threads  the render thread only.
#pragma once

#include <cstddef>
#include <vector>

#include "gsv/rendering/opengl/gl_objects.h"
#include "gsv/rendering/scene/render_list.h"

namespace gsv::rendering {

// The data of one instance in the layout of the vertex shaders: the rows of relative_from_mesh,
// then the surface.
struct InstanceData {
  float rows[3][4];        // the upper three rows of the matrix relative_from_mesh
  SurfaceFactors factors;  // colours and roughness of the instance's material
};

// `origin` is the world position that the shader uses as its origin.
InstanceData InstanceOf(const DrawItem& item, const PlacedItem& placed,
                        const geometry::Vector3& origin);

// The instances of a draw call on the graphics card.
class InstanceBuffer {
 public:
  InstanceBuffer();

  // Replaces the instances, and binds the vertex arrays.
  void Upload(const std::vector<InstanceData>& instances);
  // Draws one group with the instances [first, first + count).
  void Draw(const DrawGroup& group, std::size_t first, std::size_t count) const;

 private:
  GlVertexArray arrays_;  // attributes of the mesh's vertices and of instances_
  GlBuffer instances_;    // the InstanceData of Upload()
};

}  // namespace gsv::rendering
