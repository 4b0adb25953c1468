// Repairs COLLADA text that other programs read and assimp refuses.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace gsv::formats {

struct ColladaRepair {
  std::vector<std::string> changes;                // a sentence for each thing left out
  std::multimap<std::string, std::string> ids_of;  // by name: ids of nodes and geometries
};

// Changes `text` where it must: comments are dropped, images without a file stay without one,
// polygons with holes lose their holes, and of several geometries one that would harm assimp
// (collada_check.h) is left out. Text that is no COLLADA stays as it is.
ColladaRepair RepairCollada(std::string& text);

// Leaves out what a mesh can be shown without: at level 1 animations, cameras, lights and physics,
// at level 2 materials as well. False when there was nothing of it.
bool SimplifyCollada(std::string& text, int level);

}  // namespace gsv::formats
