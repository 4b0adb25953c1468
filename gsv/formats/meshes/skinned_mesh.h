// A mesh with a skeleton and its animation, as rigid parts that move: for each bone the triangles
// that it moves most.
//
// Rule      A triangle belongs to the bones that weigh most at its corners. Where these are
//           several, each has a copy of it, so that no gap opens between parts. Bones that move
//           less than kFewest of the triangles leave them to the bone above.
// Frames    a skin's frame is its file's root, as MeshReader has it. A bone's own frame has no
//           scale.
// Sampling  evenly over the animation, about kFramesPerSecond, kMaxFrames at most. Of a file with
//           several animations all channels run at once, as Gazebo has them.
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

struct SkinnedMesh {
  struct Bone {
    std::string name;
    std::shared_ptr<const geometry::TriangleMesh> triangles;  // in the bone's frame; never empty
    std::vector<geometry::Pose> skin_from_bone;               // by frame
  };
  std::vector<Bone> bones;
  std::vector<model::Material> materials;  // as the parts of the meshes name them
  std::vector<geometry::Vector3> root;     // by frame: the root bone's place in the skin
  double length = 0;                       // s, above zero
};

inline constexpr double kFramesPerSecond = 30;
inline constexpr int kMaxFrames = 240;
inline constexpr double kFewest = 0.01;

// `motion`: the file whose animation moves the skeleton of `skin`, by the names of bones; it may be
// the same. `scale`: of all lengths. kNotFound: the skin has no skeleton, or the other file no
// animation that moves it.
base::Result<SkinnedMesh> ReadSkinnedMesh(const std::filesystem::path& skin,
                                          const std::filesystem::path& motion, double scale,
                                          const ReadLimits& limits, TextureReader& textures,
                                          base::Problems& problems);

}  // namespace gsv::formats
