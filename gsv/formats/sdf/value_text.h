// Values as they are written in SDFormat and URDF files, and what is taken where they are wrong.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gsv::formats {

// A value's text that can be used, and what was wrong with the written one; `wrong` is empty where
// nothing was.
struct RepairedText {
  std::string text;
  std::string wrong;
};

// The words of a text, without blanks and without commas at their ends.
std::vector<std::string> WordsOf(std::string_view text);

// The number that a word begins with, and whether it holds nothing else.
struct LeadingNumber {
  double value = 0;
  bool is_number = false;  // it begins with one
  bool is_all = false;
};
LeadingNumber LeadingNumberOf(const std::string& word);

// `type` is libsdformat's name for it: "bool", "double", "int", "unsigned int", "pose", "color",
// "vector3" and so on; texts of other types are right as they stand. `has_quaternion`: the pose is
// written as x y z qx qy qz qw.
RepairedText RepairText(const std::string& type, const std::string& text,
                        const std::string& otherwise, bool has_quaternion = false);

// At most about 60 characters of a text, on one line, for a message.
std::string Quoted(std::string_view text);

}  // namespace gsv::formats
