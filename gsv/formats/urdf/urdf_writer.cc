#include "gsv/formats/urdf/urdf_writer.h"

#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>

#include <tinyxml2.h>

#include "gsv/formats/urdf/stl_writer.h"
#include "gsv/formats/urdf/urdf_tree.h"

namespace gsv::formats {
namespace {

using geometry::Pose;
using geometry::Vector3;

constexpr double kUnlimited = 1e16;  // the limit that SDFormat writes if there is no limit
constexpr int kSegments = 32;        // number of segments around a round shape that is converted to
                                     // a mesh

std::string Numbers(std::initializer_list<double> values) {
  std::string text;
  char number[32];
  for (const double value : values) {
    std::snprintf(number, sizeof number, "%.17g", value);
    text += (text.empty() ? "" : " ") + std::string(number);
  }
  return text;
}
std::string Numbers(const Vector3& v) { return Numbers({v.x, v.y, v.z}); }

double Finite(double value) {
  return std::isfinite(value) ? value : std::copysign(kUnlimited, value);
}

class UrdfText {
 public:
  UrdfText(const model::Model& model, const std::string& mesh_prefix, base::Problems& problems)
      : model_(model), mesh_prefix_(mesh_prefix), problems_(problems) {}

  Urdf Write() {
    const UrdfTree tree = MakeUrdfTree(model_, problems_);
    WarnOfWhatIsLeftOut();
    out_.PushHeader(false, true);
    out_.OpenElement("robot");
    out_.PushAttribute("name", model_.name.c_str());
    WriteMaterials();
    for (const std::string& link : tree.empty_links) {
      out_.OpenElement("link");
      out_.PushAttribute("name", link.c_str());
      out_.CloseElement();
    }
    for (const model::Link& link : model_.links) WriteLink(link);
    for (const UrdfJoint& joint : tree.joints) WriteJoint(joint);
    WriteGazeboElements(tree);
    out_.CloseElement();
    urdf_.text.assign(out_.CStr(), static_cast<std::size_t>(out_.CStrSize() - 1));
    return std::move(urdf_);
  }

 private:
  using ColourKey = std::array<double, 4>;

  static ColourKey KeyOf(const model::Colour& colour) {
    return {colour.r, colour.g, colour.b, colour.a};
  }

  void WarnOfWhatIsLeftOut() {
    const auto warn = [&](const std::string& what) {
      problems_.push_back({base::Problem::Severity::kWarning,
                           "the URDF leaves out " + what + ": URDF has no elements for them",
                           model_.name});
    };
    if (!model_.sensors.empty())
      warn("the model's sensors (" + std::to_string(model_.sensors.size()) + ")");
    if (model_.drive && model_.drive->origin == model::DriveOrigin::kPlugin)
      warn("the settings of the model's drive");
    if (!model_.loop_joints.empty()) warn("the joints that close loops");
    for (const model::Link& link : model_.links) {
      for (const model::Visual& visual : link.visuals) {
        for (const model::Material& material : visual.materials) {
          if (material.base_colour_map == nullptr) continue;
          warn("the textures of the meshes");
          return;
        }
      }
    }
  }

  // Writes each colour once, before its first use.
  void WriteMaterials() {
    for (const model::Link& link : model_.links) {
      for (const model::Visual& visual : link.visuals) {
        for (const model::Material& material : visual.materials) {
          const ColourKey key = KeyOf(material.base_colour);
          const auto [at, is_new] =
              materials_.emplace(key, "material_" + std::to_string(materials_.size()));
          if (!is_new) continue;
          out_.OpenElement("material");
          out_.PushAttribute("name", at->second.c_str());
          WriteElement("color", "rgba", Numbers({key[0], key[1], key[2], key[3]}));
          out_.CloseElement();
        }
      }
    }
  }

  void WriteElement(const char* element, const char* attribute, const std::string& value) {
    out_.OpenElement(element);
    out_.PushAttribute(attribute, value.c_str());
    out_.CloseElement();
  }

  static bool HasFriction(const model::Link& link) {
    const model::Surface standard;
    if (link.collisions.empty()) return false;
    const model::Surface& surface = link.collisions.front().surface;
    return surface.friction != standard.friction || surface.friction2 != standard.friction2;
  }

  void WriteOrigin(const Pose& pose) {
    const geometry::RollPitchYaw angles = ToRollPitchYaw(pose.orientation);
    out_.OpenElement("origin");
    out_.PushAttribute("xyz", Numbers(pose.position).c_str());
    out_.PushAttribute("rpy", Numbers({angles.roll, angles.pitch, angles.yaw}).c_str());
    out_.CloseElement();
  }

  void WriteLink(const model::Link& link) {
    out_.OpenElement("link");
    out_.PushAttribute("name", link.name.c_str());
    if (link.inertial.mass > 0) WriteInertial(link.inertial);
    for (const model::Visual& visual : link.visuals) WriteVisual(visual);
    // libsdformat applies the friction of <gazebo> elements only to collisions without a name.
    const bool is_named = !HasFriction(link);
    for (const model::Collision& collision : link.collisions) {
      WriteShape("collision", is_named ? collision.name : "", collision.link_from_collision,
                 collision.shape, std::nullopt, nullptr);
    }
    out_.CloseElement();
  }

  void WriteInertial(const model::Inertial& inertial) {
    out_.OpenElement("inertial");
    WriteOrigin(inertial.link_from_com);
    WriteElement("mass", "value", Numbers({inertial.mass}));
    out_.OpenElement("inertia");
    const std::pair<const char*, double> moments[] = {{"ixx", inertial.ixx}, {"ixy", inertial.ixy},
                                                      {"ixz", inertial.ixz}, {"iyy", inertial.iyy},
                                                      {"iyz", inertial.iyz}, {"izz", inertial.izz}};
    for (const auto& [name, value] : moments) out_.PushAttribute(name, Numbers({value}).c_str());
    out_.CloseElement();
    out_.CloseElement();
  }

  // Writes a mesh with several materials as one visual for each material.
  void WriteVisual(const model::Visual& visual) {
    const auto* mesh = std::get_if<geometry::Mesh>(&visual.shape);
    if (mesh == nullptr || visual.materials.size() < 2 || mesh->triangles->parts.size() < 2) {
      WriteShape("visual", visual.name, visual.link_from_visual, visual.shape, std::nullopt,
                 &visual.materials.front());
      return;
    }
    const auto& parts = mesh->triangles->parts;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const std::size_t material =
          std::min<std::size_t>(parts[i].material, visual.materials.size() - 1);
      WriteShape("visual", visual.name + "_" + std::to_string(i), visual.link_from_visual,
                 visual.shape, i, &visual.materials[material]);
    }
  }

  void WriteShape(const char* element, const std::string& name, const Pose& pose,
                  const geometry::Shape& shape, std::optional<std::size_t> part,
                  const model::Material* material) {
    out_.OpenElement(element);
    if (!name.empty()) out_.PushAttribute("name", name.c_str());
    WriteOrigin(pose);
    out_.OpenElement("geometry");
    WriteGeometry(shape, part);
    out_.CloseElement();
    if (material != nullptr) {
      WriteElement("material", "name", materials_.at(KeyOf(material->base_colour)));
    }
    out_.CloseElement();
  }

  void WriteGeometry(const geometry::Shape& shape, std::optional<std::size_t> part) {
    if (const auto* box = std::get_if<geometry::Box>(&shape)) {
      WriteElement("box", "size", Numbers(box->size));
    } else if (const auto* sphere = std::get_if<geometry::Sphere>(&shape)) {
      WriteElement("sphere", "radius", Numbers({sphere->radius}));
    } else if (const auto* cylinder = std::get_if<geometry::Cylinder>(&shape)) {
      out_.OpenElement("cylinder");
      out_.PushAttribute("radius", Numbers({cylinder->radius}).c_str());
      out_.PushAttribute("length", Numbers({cylinder->length}).c_str());
      out_.CloseElement();
    } else if (const auto* mesh = std::get_if<geometry::Mesh>(&shape)) {
      WriteMesh(MeshFileOf(*mesh, part), mesh->scale);
    } else {
      WriteMesh(AddMesh(Tessellate(shape, kSegments)), {1, 1, 1});
    }
  }

  void WriteMesh(const std::string& file, const Vector3& scale) {
    out_.OpenElement("mesh");
    out_.PushAttribute("filename", (mesh_prefix_ + file).c_str());
    if (!(scale == Vector3{1, 1, 1})) out_.PushAttribute("scale", Numbers(scale).c_str());
    out_.CloseElement();
  }

  // Returns the name of the STL file of a mesh, or of one part of the mesh. Writes the file at the
  // first call. So shapes with the same mesh use the same file.
  const std::string& MeshFileOf(const geometry::Mesh& mesh, std::optional<std::size_t> part) {
    const auto key = std::make_pair(mesh.triangles.get(), part);
    const auto known = mesh_files_.find(key);
    if (known != mesh_files_.end()) return known->second;
    const geometry::TriangleMesh& triangles = *mesh.triangles;
    const geometry::MeshPart whole{
        {}, 0, static_cast<std::uint32_t>(triangles.triangles.size()), 0};
    const geometry::MeshPart& run = part ? triangles.parts[*part] : whole;
    return mesh_files_[key] = AddMesh(triangles, run.first_triangle, run.triangle_count);
  }

  std::string AddMesh(const geometry::TriangleMesh& mesh) {
    return AddMesh(mesh, 0, mesh.triangles.size());
  }
  std::string AddMesh(const geometry::TriangleMesh& mesh, std::size_t first, std::size_t count) {
    urdf_.meshes.push_back(
        {"mesh_" + std::to_string(urdf_.meshes.size()) + ".stl", WriteStl(mesh, first, count)});
    return urdf_.meshes.back().file;
  }

  void WriteJoint(const UrdfJoint& joint) {
    out_.OpenElement("joint");
    out_.PushAttribute("name", joint.name.c_str());
    out_.PushAttribute("type", joint.type.c_str());
    WriteOrigin(joint.parent_from_child);
    WriteElement("parent", "link", joint.parent);
    WriteElement("child", "link", joint.child);
    if (joint.type != "fixed" && joint.type != "floating") {
      WriteElement("axis", "xyz", Numbers(joint.axis));
      WriteLimits(joint);
      if (joint.source->mimic) WriteMimic(*joint.source->mimic);
    }
    out_.CloseElement();
  }

  // In URDF, the reference of a mimic joint is always 0.
  void WriteMimic(const model::Mimic& mimic) {
    out_.OpenElement("mimic");
    out_.PushAttribute("joint", model_.joints[static_cast<std::size_t>(mimic.leader)].name.c_str());
    out_.PushAttribute("multiplier", Numbers({mimic.multiplier}).c_str());
    out_.PushAttribute("offset",
                       Numbers({mimic.offset - mimic.multiplier * mimic.reference}).c_str());
    out_.CloseElement();
  }

  void WriteLimits(const UrdfJoint& joint) {
    const model::Joint& source = *joint.source;
    out_.OpenElement("limit");
    if (joint.type != "continuous") {
      out_.PushAttribute("lower", Numbers({Finite(source.position_limits.min)}).c_str());
      out_.PushAttribute("upper", Numbers({Finite(source.position_limits.max)}).c_str());
    }
    out_.PushAttribute("effort", Numbers({Finite(source.effort_limit)}).c_str());
    out_.PushAttribute("velocity", Numbers({Finite(source.velocity_limit)}).c_str());
    out_.CloseElement();
    if (source.damping == 0 && source.friction == 0) return;
    out_.OpenElement("dynamics");
    out_.PushAttribute("damping", Numbers({source.damping}).c_str());
    out_.PushAttribute("friction", Numbers({source.friction}).c_str());
    out_.CloseElement();
  }

  void WriteText(const char* element, const std::string& text) {
    out_.OpenElement(element);
    out_.PushText(text.c_str());
    out_.CloseElement();
  }

  void OpenGazebo(const std::string& reference) {
    out_.OpenElement("gazebo");
    if (!reference.empty()) out_.PushAttribute("reference", reference.c_str());
  }

  void WriteGazeboElements(const UrdfTree& tree) {
    if (model_.is_static) {
      OpenGazebo("");
      WriteText("static", "true");
      out_.CloseElement();
    }
    for (const model::Link& link : model_.links) {
      const bool has_friction = HasFriction(link);
      if (!has_friction && link.has_gravity) continue;
      OpenGazebo(link.name);
      if (has_friction) {
        const model::Surface& surface = link.collisions.front().surface;
        WriteText("mu1", Numbers({surface.friction}));
        WriteText("mu2", Numbers({surface.friction2}));
      }
      if (!link.has_gravity) WriteText("gravity", "false");
      out_.CloseElement();
    }
    for (const UrdfJoint& joint : tree.joints) {
      if (joint.type != "fixed" || joint.source == nullptr) continue;
      OpenGazebo(joint.name);
      WriteText("preserveFixedJoint", "true");
      out_.CloseElement();
    }
  }

  const model::Model& model_;
  const std::string& mesh_prefix_;
  base::Problems& problems_;
  tinyxml2::XMLPrinter out_;
  Urdf urdf_;
  std::map<ColourKey, std::string> materials_;
  // The order of the pointers does not affect the output, because the map is only used for lookups.
  std::map<std::pair<const geometry::TriangleMesh*, std::optional<std::size_t>>, std::string>
      mesh_files_;
};

}  // namespace

Urdf WriteUrdf(const model::Model& model, const std::string& mesh_prefix,
               base::Problems& problems) {
  return UrdfText(model, mesh_prefix, problems).Write();
}

}  // namespace gsv::formats
