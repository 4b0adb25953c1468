// Writes models as URDF, whatever format they were read from: links, joints, limits, inertias,
// visuals and collisions.
//
// Frames    every link of the model keeps its name and its frame. Links are added where URDF's tree
//           needs them, see urdf_tree.h.
// Shapes    URDF has boxes, cylinders, spheres and meshes. All other shapes become meshes. A mesh
//           becomes one STL file for each of its materials, because STL has no materials.
// Gazebo    <gazebo> elements have Gazebo's additions to URDF: friction, gravity, static models,
//           and the setting that keeps fixed joints. Other readers ignore them.
// Left out  sensors, drives and textures (with a warning), restitution and shadows.
// Equal models give equal files.
// Threads   any.
#pragma once

#include <string>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/model/model.h"

namespace gsv::formats {

// A mesh file to which a URDF refers.
struct UrdfMesh {
  std::string file;  // "mesh_0.stl"
  std::string stl;   // content of the STL file
};

// A model as URDF: the XML, and the mesh files to which it refers.
struct Urdf {
  std::string text;  // the XML
  std::vector<UrdfMesh> meshes;
};

// Writes a model. `mesh_prefix` comes before the file names of meshes: "meshes/",
// "file:///tmp/robot/", "package://robot/". `problems` gets a warning for each part that URDF
// cannot represent.
Urdf WriteUrdf(const model::Model& model, const std::string& mesh_prefix, base::Problems& problems);

}  // namespace gsv::formats
