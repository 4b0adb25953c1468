#include "gsv/formats/sdf/sdf_geometry.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include <sdf/Box.hh>
#include <sdf/Capsule.hh>
#include <sdf/Cylinder.hh>
#include <sdf/Element.hh>
#include <sdf/Ellipsoid.hh>
#include <sdf/Heightmap.hh>
#include <sdf/Mesh.hh>
#include <sdf/Plane.hh>
#include <sdf/Sphere.hh>

#include "gsv/formats/meshes/heightmap.h"
#include "gsv/formats/meshes/polyline.h"
#include "gsv/formats/meshes/terrain_texture.h"
#include "gsv/formats/sdf/sdf_document.h"

namespace gsv::formats {
namespace {

using base::ErrorCode;
using geometry::Vector3;

constexpr std::uint64_t kMaxLayers = 16;

base::Result<SdfShape> Checked(geometry::Shape shape, std::initializer_list<double> lengths) {
  for (const double length : lengths) {
    if (!(length > 0) || !std::isfinite(length)) {
      return Fail(ErrorCode::kBadModel, "a shape's sizes must be above zero");
    }
  }
  return SdfShape{std::move(shape), {}, {}};
}

base::Result<SdfShape> ReadMesh(const sdf::Mesh& mesh, const std::filesystem::path& file,
                                const ReadingContext& context) {
  const Vector3 scale = FromIgnition(mesh.Scale());
  if (!geometry::IsFinite(scale) || scale.x == 0 || scale.y == 0 || scale.z == 0) {
    return Fail(ErrorCode::kBadModel, "a mesh's scale must not be zero");
  }
  auto path = context.finder.Find(mesh.Uri(), file);
  if (!path) return Fail(path.error());
  auto read = context.meshes.Read(*path, mesh.Submesh(), mesh.CenterSubmesh(), context.problems);
  if (!read) return Fail(ErrorCode::kBadModel, read.error().Sentence());
  return SdfShape{geometry::Mesh{read->triangles, scale}, {}, read->materials};
}

bool IsElevationModel(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension == ".tif" || extension == ".tiff";
}

// Returns the textures of a visual's heightmap. Each texture except the first has a <blend>.
std::vector<TerrainLayer> ReadLayers(const sdf::Heightmap& heightmap,
                                     const std::filesystem::path& file,
                                     const ReadingContext& context) {
  std::vector<TerrainLayer> layers;
  bool any = false;
  for (std::uint64_t i = 0; i < std::min<std::uint64_t>(heightmap.TextureCount(), kMaxLayers);
       ++i) {
    const sdf::HeightmapTexture& texture = *heightmap.TextureByIndex(i);
    TerrainLayer layer;
    if (texture.Size() > 0 && std::isfinite(texture.Size())) layer.tile = texture.Size();
    if (i > 0 && i <= heightmap.BlendCount()) {
      layer.min_height = heightmap.BlendByIndex(i - 1)->MinHeight();
      layer.fade_distance = heightmap.BlendByIndex(i - 1)->FadeDistance();
    } else if (i > 0) {
      break;  // without a <blend>, the height at which the texture begins is unknown
    }
    const std::string place = texture.Element() == nullptr
                                  ? context.source.string()
                                  : PlaceOf(*texture.Element(), context.source);
    auto path = context.finder.Find(texture.Diffuse(), file);
    auto image = path ? context.textures.Read(*path)
                      : base::Result<std::shared_ptr<const model::Image>>(Fail(path.error()));
    if (image) {
      layer.image = *image;
      any = true;
    } else {
      context.Warn("the terrain is drawn in grey instead of a texture: " + image.error().Sentence(),
                   place);
    }
    layers.push_back(std::move(layer));
  }
  if (!any) layers.clear();
  return layers;
}

// Reads an image, or an elevation model in TIFF. Like in Gazebo, an elevation model may define its
// size.
base::Result<SdfShape> ReadHeightmap(const sdf::Heightmap& heightmap,
                                     const std::filesystem::path& file, bool is_drawn,
                                     const ReadingContext& context) {
  Vector3 size = FromIgnition(heightmap.Size());
  const bool has_size = heightmap.Element() != nullptr && heightmap.Element()->HasElement("size");
  if (!(size.x > 0 && size.y > 0 && size.z > 0) || !geometry::IsFinite(size)) {
    return Fail(ErrorCode::kBadModel, "a heightmap's size must be above zero");
  }
  auto path = context.finder.Find(heightmap.Uri(), file);
  if (!path) return Fail(path.error());
  geometry::TriangleMesh mesh;
  if (IsElevationModel(*path)) {
    const auto grid = ReadTiffHeights(*path, context.limits);
    if (!grid) return Fail(ErrorCode::kBadModel, grid.error().Sentence());
    if (!has_size) size = TrueSize(*grid);
    mesh = HeightmapMesh(*grid, size, context.limits.heightmap_side);
  } else {
    const auto picture = context.textures.Read(*path);
    if (!picture) return Fail(ErrorCode::kBadModel, picture.error().Sentence());
    mesh = HeightmapMesh(**picture, size, context.limits.heightmap_side);
  }
  std::vector<model::Material> materials;
  if (is_drawn) {
    if (const auto layers = ReadLayers(heightmap, file, context); !layers.empty()) {
      model::Material& material = materials.emplace_back();
      material.base_colour = {1, 1, 1, 1};
      material.base_colour_map =
          std::make_shared<const model::Image>(TerrainTexture(mesh, {size.x, size.y}, layers));
    }
  }
  SdfShape shape{geometry::Mesh{std::make_shared<const geometry::TriangleMesh>(std::move(mesh))},
                 {FromIgnition(heightmap.Position()), {}},
                 std::move(materials)};
  return shape;
}

base::Result<SdfShape> ReadPolyline(const sdf::ElementPtr& geometry) {
  std::vector<std::vector<geometry::Vector2>> outlines;
  double height = 0;
  for (auto polyline = geometry->GetElement("polyline"); polyline != nullptr;
       polyline = polyline->GetNextElement("polyline")) {
    height = polyline->Get<double>("height");
    outlines.emplace_back();
    if (!polyline->HasElement("point")) continue;
    for (auto point = polyline->GetElement("point"); point != nullptr;
         point = point->GetNextElement("point")) {
      const auto p = point->Get<ignition::math::Vector2d>();
      outlines.back().push_back({p.X(), p.Y()});
    }
  }
  auto mesh = ExtrudeOutlines(outlines, height);
  if (!mesh) return Fail(mesh.error());
  return SdfShape{
      geometry::Mesh{std::make_shared<const geometry::TriangleMesh>(std::move(*mesh))}, {}, {}};
}

base::Result<SdfShape> ReadPlane(const sdf::Plane& plane, const ReadingContext& context) {
  geometry::Vector3 normal = FromIgnition(plane.Normal());
  if (!(Norm(normal) > 0)) {
    context.Warn("the plane's normal is zero; the z axis is used",
                 plane.Element() == nullptr ? context.source.string()
                                            : PlaceOf(*plane.Element(), context.source));
    normal = {0, 0, 1};
  }
  const geometry::Vector2 size{plane.Size().X(), plane.Size().Y()};
  return Checked(geometry::Plane{geometry::Normalized(normal), size}, {size.x, size.y});
}

// Reads a <cone>, which exists since SDFormat 1.11. libsdformat 12 reads SDFormat up to 1.9 and has
// no class for cones, but it keeps the element as it is.
base::Result<SdfShape> ReadCone(const sdf::ElementPtr& geometry) {
  const sdf::ElementPtr cone = geometry->GetElement("cone");
  const double radius = cone->Get<double>("radius", 0.5).first;
  const double length = cone->Get<double>("length", 1.0).first;
  return Checked(geometry::Cone{radius, length}, {radius, length});
}

}  // namespace

base::Result<SdfShape> ReadGeometry(const sdf::Geometry& geometry, const sdf::ElementPtr& element,
                                    const ReadingContext& context) {
  const std::filesystem::path file = FileOf(*element, context.source);
  if (const sdf::Box* box = geometry.BoxShape()) {
    const Vector3 size = FromIgnition(box->Size());
    return Checked(geometry::Box{size}, {size.x, size.y, size.z});
  }
  if (const sdf::Sphere* sphere = geometry.SphereShape()) {
    return Checked(geometry::Sphere{sphere->Radius()}, {sphere->Radius()});
  }
  if (const sdf::Cylinder* cylinder = geometry.CylinderShape()) {
    return Checked(geometry::Cylinder{cylinder->Radius(), cylinder->Length()},
                   {cylinder->Radius(), cylinder->Length()});
  }
  if (const sdf::Capsule* capsule = geometry.CapsuleShape()) {
    return Checked(geometry::Capsule{capsule->Radius(), capsule->Length()},
                   {capsule->Radius(), capsule->Length()});
  }
  if (const sdf::Ellipsoid* ellipsoid = geometry.EllipsoidShape()) {
    const Vector3 radii = FromIgnition(ellipsoid->Radii());
    return Checked(geometry::Ellipsoid{radii}, {radii.x, radii.y, radii.z});
  }
  if (const sdf::Plane* plane = geometry.PlaneShape()) return ReadPlane(*plane, context);
  if (const sdf::Mesh* mesh = geometry.MeshShape()) return ReadMesh(*mesh, file, context);
  if (const sdf::Heightmap* map = geometry.HeightmapShape()) {
    const sdf::ElementPtr owner = element->GetParent();
    const bool is_drawn = owner != nullptr && owner->GetName() == "visual";
    return ReadHeightmap(*map, file, is_drawn, context);
  }
  if (element->HasElement("polyline")) return ReadPolyline(element);
  if (element->HasElement("cone")) return ReadCone(element);
  return Fail(ErrorCode::kBadModel, "the type of the geometry is unknown");
}

}  // namespace gsv::formats
