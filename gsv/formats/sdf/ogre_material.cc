#include "gsv/formats/sdf/ogre_material.h"

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <vector>

namespace gsv::formats {
namespace {

using model::Colour;

std::vector<std::string> Words(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

// Returns the script without comments, and with each brace on its own line.
std::string Tidied(std::string_view script) {
  std::string text;
  for (std::size_t i = 0; i < script.size(); ++i) {
    if (script.substr(i, 2) == "//") i = std::min(script.find('\n', i), script.size() - 1);
    const char c = script[i];
    if (c == '{' || c == '}') {
      text += '\n';
      text += c;
      text += '\n';
    } else {
      text += c == '\r' ? '\n' : c;
    }
  }
  return text;
}

std::optional<double> Number(const std::string& word) {
  char* end = nullptr;
  const double value = std::strtod(word.c_str(), &end);
  return end != word.c_str() && *end == '\0' ? std::optional(value) : std::nullopt;
}

std::optional<Colour> ColourFrom(const std::vector<std::string>& words) {
  std::vector<double> values;
  for (std::size_t i = 1; i < words.size(); ++i) {
    const auto value = Number(words[i]);
    if (!value) return std::nullopt;
    values.push_back(*value);
  }
  if (values.size() < 3) return std::nullopt;
  return Colour{values[0], values[1], values[2], values.size() > 3 ? values[3] : 1.0};
}

// Reads "specular R G B [A] SHININESS". The last of the four or five numbers is the shininess.
void ReadSpecular(std::vector<std::string> words, OgreMaterial& material) {
  if (words.size() >= 5) {
    material.shininess = Number(words.back()).value_or(0);
    words.pop_back();
  }
  if (auto colour = ColourFrom(words)) material.specular = colour;
}

void ReadLine(const std::vector<std::string>& words, OgreMaterial& material) {
  const std::string& key = words.front();
  if (key == "ambient") {
    if (auto colour = ColourFrom(words)) material.ambient = colour;
  } else if (key == "diffuse") {
    if (auto colour = ColourFrom(words)) material.diffuse = colour;
  } else if (key == "emissive") {
    if (auto colour = ColourFrom(words)) material.emissive = colour;
  } else if (key == "specular") {
    ReadSpecular(words, material);
  } else if (key == "texture" && words.size() > 1 && material.texture.empty()) {
    material.texture = words[1];
  }
}

}  // namespace

std::map<std::string, OgreMaterial> ParseOgreMaterials(std::string_view script) {
  std::map<std::string, OgreMaterial> materials;
  std::istringstream lines(Tidied(script));
  OgreMaterial* current = nullptr;
  int depth = 0;
  for (std::string line; std::getline(lines, line);) {
    const std::vector<std::string> words = Words(line);
    if (words.empty()) continue;
    if (words[0] == "{") {
      ++depth;
    } else if (words[0] == "}") {
      if (--depth <= 0) current = nullptr;
    } else if (depth == 0 && words[0] == "material" && words.size() > 1) {
      OgreMaterial parent;
      if (words.size() > 3 && words[2] == ":") parent = materials[words[3]];
      current = &(materials[words[1]] = parent);
    } else if (current != nullptr) {
      ReadLine(words, *current);
    }
  }
  return materials;
}

}  // namespace gsv::formats
