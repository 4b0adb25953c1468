// WorldFrames stores the frames of a world, and resolves the poses of models and lights that are
// relative to each other.
#pragma once

#include <map>
#include <string>

#include <tinyxml2.h>

#include "gsv/base/error.h"
#include "gsv/geometry/pose.h"

namespace gsv::formats {

// A <pose> as in the file.
struct WrittenPose {
  geometry::Pose pose;
  std::string relative_to;  // the name of a frame; empty: the world
};

// Reads the <pose> of an element (default: the identity). It has six numbers, optionally with
// @degrees, or seven with @rotation_format "quat_xyzw". A malformed or infinite pose is an error.
base::Result<WrittenPose> ReadPose(const tinyxml2::XMLElement& element);

// Reads the pose of a <frame>. Without @relative_to it is relative to the frame in @attached_to.
base::Result<WrittenPose> ReadFramePose(const tinyxml2::XMLElement& frame);

// The frames of a world, and the poses between them.
class WorldFrames {
 public:
  // Adds a model or frame. `at` is the element's pose. If the model has a placement frame, `at` is
  // the pose of that frame. Then `frame_from_origin` is the inverse of the placement frame's pose
  // in the model.
  void Add(const std::string& name, WrittenPose at, geometry::Pose frame_from_origin = {},
           const std::map<std::string, geometry::Pose>* inner_frames = nullptr);

  // Returns the pose in the world of an element that was added. Fails if a frame on the way to the
  // world does not exist, or if frames are relative to each other in a cycle.
  base::Result<geometry::Pose> WorldFrom(const std::string& name) const;
  // Converts a <pose> to a pose in the world. Fails as above.
  base::Result<geometry::Pose> WorldFrom(const WrittenPose& pose) const;

 private:
  // The arguments of Add() for a model or frame.
  struct Entry {
    WrittenPose at;  // pose of the element, or of its placement frame
    geometry::Pose frame_from_origin;
    const std::map<std::string, geometry::Pose>* inner_frames;
  };

  // Returns the pose in the world of a frame. Fails if more than `links_left` frames lie on the way
  // to the world, because then the frames form a cycle.
  base::Result<geometry::Pose> Follow(const std::string& name, int links_left) const;

  std::map<std::string, Entry> entries_;
};

}  // namespace gsv::formats
