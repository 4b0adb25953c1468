// Reads an animated mesh with a skeleton (a skin) as rigid parts, one for each bone.
//
// Rule      The main bone of a corner is the bone with the largest weight there. A triangle becomes
//           a part of the main bones of its three corners. If these are different bones, each of
//           them gets a copy of the triangle, so that there is no gap between the parts. If a bone
//           has less than the fraction kMinTriangles of all triangles, the triangles of the bone
//           go to its parent.
// Frames    the frame of a skin is the root of its file, as for MeshReader. The frame of a bone
//           has no scale.
// Sampling  at equal intervals over the animation, at about kFramesPerSecond, at most kMaxFrames.
//           If a file has several animations, all channels run at once, as in Gazebo.
// Units     metres, seconds.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "gsv/formats/images/texture_reader.h"
#include "gsv/geometry/pose.h"
#include "gsv/geometry/triangle_mesh.h"
#include "gsv/model/material.h"

namespace gsv::formats {

// A skin as rigid parts (bones), with the poses of the bones in each frame of its animation.
struct SkinnedMesh {
  struct Bone {
    std::string name;
    std::shared_ptr<const geometry::TriangleMesh> triangles;  // in the bone's frame; never empty
    std::vector<geometry::Pose> skin_from_bone;               // one per frame
  };
  std::vector<Bone> bones;
  std::vector<model::Material> materials;  // materials of the mesh's parts, by index
  std::vector<geometry::Vector3> root;     // one per frame: position of the root bone in the skin
  double length = 0;                       // s, above zero
};

inline constexpr double kFramesPerSecond = 30;
inline constexpr int kMaxFrames = 240;
inline constexpr double kMinTriangles = 0.01;

// Reads a skin with its animation. `motion` is the file with the animation for the skeleton of
// `skin`, matched by bone names; it may be the same file. `scale` is a factor of all lengths.
// kNotFound: the skin has no skeleton, or `motion` has no animation for it.
base::Result<SkinnedMesh> ReadSkinnedMesh(const std::filesystem::path& skin,
                                          const std::filesystem::path& motion, double scale,
                                          const ReadLimits& limits, TextureReader& textures,
                                          base::Problems& problems);

}  // namespace gsv::formats
