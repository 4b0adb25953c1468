// Checks the texts of values in SDFormat and URDF files, and replaces invalid texts.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gsv::formats {

// A valid text for a value. `wrong` describes the problem with the original text, and is empty if
// the original text was valid.
struct RepairedText {
  std::string text;
  std::string wrong;
};

// Returns the words of a text, without blanks and without commas at their ends.
std::vector<std::string> WordsOf(std::string_view text);

// The number at the start of a word.
struct LeadingNumber {
  double value = 0;
  bool is_number = false;  // whether the word begins with a number
  bool is_all = false;     // whether the whole word is a number
};
LeadingNumber LeadingNumberOf(const std::string& word);

// Whether the text is three numbers, all of them 0.
bool IsZeroVector(std::string_view text);

// Repairs a text. `type` is libsdformat's name of the type: "bool", "double", "int", "unsigned
// int", "pose", "color", "vector3" and so on. Texts of other types are always valid. `otherwise` is
// used if no part of the text is valid. If `has_quaternion` is true, a pose has the form x y z qx
// qy qz qw.
RepairedText RepairText(const std::string& type, const std::string& text,
                        const std::string& otherwise, bool has_quaternion = false);

// Writes the numbers of a repaired text as plain decimals, because urdfdom rejects "1.0f", "0x10"
// and 1e-310. If a number is not finite, returns `otherwise` with the reason.
RepairedText AsPlainNumbers(RepairedText repaired, const std::string& otherwise);

// Returns at most about 60 characters of a text, on one line, for a message.
std::string Quoted(std::string_view text);

}  // namespace gsv::formats
