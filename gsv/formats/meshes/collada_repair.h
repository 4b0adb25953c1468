// Repairs COLLADA text that other programs read and assimp refuses.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace gsv::formats {

// The result of a repair.
struct ColladaRepair {
  std::vector<std::string> changes;                // a sentence for each part that was left out
  std::multimap<std::string, std::string> ids_of;  // ids of nodes and geometries by name
};

// Changes `text` where necessary. Comments and the holes of polygons are removed. Images without a
// file get a placeholder name. A geometry that would harm assimp (collada_check.h) is left out if
// the file has other geometries. Text that is not COLLADA is not changed.
ColladaRepair RepairCollada(std::string& text);

// Leaves out optional parts of a mesh: at level 1 animations, cameras, lights and physics, at level
// 2 materials as well. Returns false if there were no such parts.
bool SimplifyCollada(std::string& text, int level);

}  // namespace gsv::formats
