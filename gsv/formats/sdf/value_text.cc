#include "gsv/formats/sdf/value_text.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "gsv/base/named.h"

namespace gsv::formats {
namespace {

constexpr std::size_t kMaxQuoteLength = 60;
// if no component of a colour exceeds this value, components above 1 count as 1; else as parts of
// 255
constexpr double kMaxRoundedToOne = 2;
constexpr double kByteColour = 255;

std::string TextOf(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.9g", value);
  return text;
}

std::string Joined(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : " ") + TextOf(value);
  return text;
}

struct WrittenNumbers {
  std::vector<double> values;  // numbers before the first word that is not a number
  std::size_t words = 0;
  bool are_all_clean = true;
};

WrittenNumbers ReadNumbers(const std::string& text) {
  WrittenNumbers numbers;
  const std::vector<std::string> words = WordsOf(text);
  numbers.words = words.size();
  for (const std::string& word : words) {
    const LeadingNumber number = LeadingNumberOf(word);
    numbers.are_all_clean = numbers.are_all_clean && number.is_all;
    if (!number.is_number) break;
    numbers.values.push_back(number.value);
  }
  return numbers;
}

RepairedText RepairFlag(const std::string& text, const std::string& otherwise) {
  std::string lower;
  const std::string first = WordsOf(text).front();
  for (const char c : first) {
    lower += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  if (lower == "true" || lower == "false" || lower == "1" || lower == "0") return {text, ""};
  // The default of a flag may be 1 or 0, because libsdformat writes it so.
  return {otherwise == "1" || otherwise == "true" ? "true" : "false", "true or false is expected"};
}

RepairedText RepairOne(const std::string& type, const std::string& text,
                       const std::string& otherwise) {
  const WrittenNumbers numbers = ReadNumbers(text);
  if (numbers.values.empty()) return {otherwise, "a number is expected"};
  const double value = numbers.values.front();
  const bool is_whole = type == "int" || type == "unsigned int" || type == "uint64_t";
  if (!is_whole) {
    if (numbers.words == 1 && numbers.are_all_clean) return {text, ""};
    return {TextOf(value), "one number is expected"};
  }
  const double largest = type == "int" ? 2e9 : 4294967295.0;
  if (!std::isfinite(value) || std::abs(value) > largest || (type != "int" && value < 0)) {
    return {otherwise, type == "int" ? "a whole number is expected"
                                     : "a whole number that is not negative is expected"};
  }
  if (value == std::trunc(value) && numbers.words == 1 && numbers.are_all_clean) return {text, ""};
  return {TextOf(std::trunc(value)), "a whole number is expected"};
}

RepairedText RepairVector(std::size_t wanted, const std::string& text,
                          const std::string& otherwise) {
  const WrittenNumbers numbers = ReadNumbers(text);
  const std::string expected = std::to_string(wanted) + " numbers are expected";
  if (numbers.values.size() == wanted && numbers.words == wanted && numbers.are_all_clean) {
    return {text, ""};
  }
  if (numbers.values.size() < wanted) return {otherwise, expected};
  return {Joined({numbers.values.begin(), numbers.values.begin() + static_cast<int>(wanted)}),
          expected};
}

RepairedText RepairPose(const std::string& text, bool has_quaternion) {
  constexpr std::size_t kPosition = 3, kAngles = 6, kQuaternion = 7;
  const std::size_t wanted = has_quaternion ? kQuaternion : kAngles;
  WrittenNumbers numbers = ReadNumbers(text);
  const bool is_finite = std::all_of(numbers.values.begin(), numbers.values.end(),
                                     [](double value) { return std::isfinite(value); });
  if (numbers.values.size() == wanted && numbers.words == wanted && numbers.are_all_clean &&
      is_finite) {
    const auto is_zero = [](double value) { return value == 0; };
    if (!has_quaternion ||
        !std::all_of(numbers.values.begin() + 3, numbers.values.end(), is_zero)) {
      return {text, ""};
    }
    numbers.values.back() = 1;
    return {Joined(numbers.values), "a rotation needs a quaternion of a length above 0"};
  }
  const std::string expected =
      std::to_string(wanted) +
      (is_finite ? " numbers are expected" : " finite numbers are expected");
  std::vector<double> taken(wanted, 0.0);
  if (has_quaternion) taken.back() = 1;
  const std::size_t used = numbers.values.size() >= wanted ? wanted : kPosition;
  for (std::size_t i = 0; i < std::min(used, numbers.values.size()); ++i) {
    taken[i] = std::isfinite(numbers.values[i]) ? numbers.values[i] : 0.0;
  }
  return {Joined(taken), expected};
}

RepairedText RepairColour(const std::string& text, const std::string& otherwise) {
  WrittenNumbers numbers = ReadNumbers(text);
  std::vector<double>& parts = numbers.values;
  if (parts.size() < 3) return {otherwise, "3 or 4 numbers are expected"};
  const bool has_right_size = numbers.words <= 4 && parts.size() == numbers.words;
  parts.resize(std::min<std::size_t>(parts.size(), 4));
  const auto is_in_range = [](double part) { return part >= 0 && part <= 1; };
  const bool are_in_range = std::all_of(parts.begin(), parts.end(), is_in_range);
  if (has_right_size && numbers.are_all_clean && are_in_range) return {text, ""};
  const double largest = *std::max_element(parts.begin(), parts.end());
  for (double& part : parts) {
    if (part > 1 && largest > kMaxRoundedToOne) part /= kByteColour;
    part = part > 0 ? std::min(part, 1.0) : 0.0;
  }
  return {Joined(parts),
          are_in_range ? "3 or 4 numbers are expected" : "numbers between 0 and 1 are expected"};
}

}  // namespace

std::vector<std::string> WordsOf(std::string_view text) {
  std::vector<std::string> words;
  std::string word;
  const auto end_word = [&] {
    while (!word.empty() && word.back() == ',') word.pop_back();
    if (!word.empty()) words.push_back(std::move(word));
    word.clear();
  };
  for (const char c : text) {
    if (std::isspace(static_cast<unsigned char>(c)) != 0) {
      end_word();
    } else {
      word += c;
    }
  }
  end_word();
  return words;
}

LeadingNumber LeadingNumberOf(const std::string& word) {
  LeadingNumber number;
  char* end = nullptr;
  number.value = std::strtod(word.c_str(), &end);
  number.is_number = end != word.c_str();
  // Accept "1.0f", the notation of C.
  number.is_all =
      number.is_number && (*end == '\0' || ((*end == 'f' || *end == 'F') && end[1] == '\0'));
  return number;
}

bool IsZeroVector(std::string_view text) {
  const std::vector<std::string> words = WordsOf(text);
  return words.size() == 3 && std::all_of(words.begin(), words.end(), [](const std::string& word) {
           const LeadingNumber number = LeadingNumberOf(word);
           return number.is_all && number.value == 0;
         });
}

RepairedText RepairText(const std::string& type, const std::string& text,
                        const std::string& otherwise, bool has_quaternion) {
  static constexpr base::Named<std::size_t> kVectors[] = {
      {"vector3", 3},  {"ignition::math::Vector3d", 3}, {"vector2d", 2},
      {"vector2i", 2}, {"ignition::math::Vector2d", 2}, {"ignition::math::Vector2i", 2}};
  if (WordsOf(text).empty()) return {text, ""};  // for an empty text, libsdformat uses the default
  if (type == "bool") return RepairFlag(text, otherwise);
  if (type == "double" || type == "float" || type == "int" || type == "unsigned int" ||
      type == "uint64_t") {
    return RepairOne(type, text, otherwise);
  }
  if (type == "pose" || type == "ignition::math::Pose3d") return RepairPose(text, has_quaternion);
  if (type == "color" || type == "ignition::math::Color") return RepairColour(text, otherwise);
  const std::size_t* size = base::FindNamed(kVectors, type);
  return size == nullptr ? RepairedText{text, ""} : RepairVector(*size, text, otherwise);
}

RepairedText AsPlainNumbers(RepairedText repaired, const std::string& otherwise) {
  WrittenNumbers numbers = ReadNumbers(repaired.text);
  bool are_plain = true;
  for (double& value : numbers.values) {
    if (!std::isfinite(value)) return {otherwise, "finite numbers are expected"};
    if (value != 0 && !std::isnormal(value)) {
      value = 0;
      are_plain = false;
    }
  }
  are_plain = are_plain && repaired.text.find_first_of("xXfF") == std::string::npos;
  if (!are_plain) repaired.text = Joined(numbers.values);
  return repaired;
}

std::string Quoted(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text.substr(0, kMaxQuoteLength)) {
    quoted += std::iscntrl(static_cast<unsigned char>(c)) != 0 ? ' ' : c;
  }
  return quoted + (text.size() > kMaxQuoteLength ? "…\"" : "\"");
}

}  // namespace gsv::formats
