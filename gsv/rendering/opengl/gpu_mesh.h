// Triangle meshes on the graphics card.
//
// Threads  the render thread only.
#pragma once

#include "gsv/rendering/opengl/gl_objects.h"
#include "gsv/rendering/scene/mesh_store.h"

namespace gsv::rendering {

// A mesh that stores the arrays of MeshArrays on the card. Indices have 32 bits.
struct GpuMesh final : DrawMesh {
  GlBuffer vertices;
  GlBuffer indices;
};

// Copies a mesh to the graphics card.
std::shared_ptr<const DrawMesh> UploadMesh(MeshArrays arrays);

}  // namespace gsv::rendering
