// Fuzz test: reads the input as a mesh. The first byte selects the format. The reader must refuse
// the mesh, or return a mesh that is valid.
#include "gsv/base/check.h"
#include "gsv/formats/fuzz/scratch_file.h"
#include "gsv/formats/meshes/mesh_reader.h"
#include "gsv/geometry/pose.h"

using namespace gsv;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static constexpr const char* kNames[] = {"m.dae", "m.obj", "m.stl", "m.gltf", "m.glb"};
  if (size == 0) return 0;
  formats::ReadLimits limits;
  limits.mesh_bytes = 1 << 20;
  limits.mesh_triangles = 10'000;
  limits.mesh_vertices = 10'000;
  formats::TextureReader textures(limits);
  formats::MeshReader meshes(limits, textures);
  base::Problems problems;
  const auto file = formats::ScratchFile(kNames[data[0] % 5], data + 1, size - 1);
  const auto read = meshes.Read(file, "", false, problems);
  if (!read) {
    GSV_CHECK(!read.error().message.empty());
    return 0;
  }
  const geometry::TriangleMesh& mesh = *read->triangles;
  GSV_CHECK(!mesh.triangles.empty() && mesh.triangles.size() <= limits.mesh_triangles);
  for (const geometry::Vector3& position : mesh.positions) GSV_CHECK(geometry::IsFinite(position));
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t corner : triangle) GSV_CHECK(corner < mesh.positions.size());
  }
  GSV_CHECK(mesh.normals.empty() || mesh.normals.size() == mesh.positions.size());
  GSV_CHECK(mesh.texture_coordinates.empty() ||
            mesh.texture_coordinates.size() == mesh.positions.size());
  std::size_t covered = 0;
  for (const geometry::MeshPart& part : mesh.parts) {
    GSV_CHECK(part.first_triangle == covered && part.material < read->materials.size());
    covered += part.triangle_count;
  }
  GSV_CHECK(covered == mesh.triangles.size());
  return 0;
}
