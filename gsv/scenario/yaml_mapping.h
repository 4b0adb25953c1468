// Reads a YAML mapping key by key and collects problems. A problem in a file names the line and the
// column. A problem in a request names the field instead, such as "robots[1].x".
//
// Bounded  a mapping has at most kMaxKeys keys, and at most kMaxProblems problems are kept, because
//          YAML aliases can expand to many nodes.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <yaml-cpp/yaml.h>

#include "gsv/base/error.h"

namespace gsv::scenario {

inline constexpr std::size_t kMaxKeys = 64;
inline constexpr std::size_t kMaxProblems = 100;

// Formats the places of nodes in a file or a request, and collects the problems with them.
class YamlPlace {
 public:
  // How messages name a place: by line and column of a file, or by the field of a request.
  enum class Naming { kLines, kFields };
  YamlPlace(Naming naming, std::string file, base::Problems& problems)
      : naming_(naming), file_(std::move(file)), problems_(problems) {}

  // Returns the place as "FILE:LINE:COLUMN", counted from 1, or as the field.
  std::string Of(const YAML::Mark& mark, const std::string& field) const;
  void AddProblem(const YAML::Mark& mark, const std::string& field, std::string message) const;
  std::size_t problem_count() const { return problems_.size(); }

 private:
  const Naming naming_;  // how Of() names a place
  const std::string file_;
  base::Problems& problems_;
};

// One mapping. The caller reads the keys that it knows; the destructor reports all other keys.
class YamlMapping {
 public:
  // Adds problems for a node that is not a mapping, and for duplicate keys. `field` is the path of
  // the mapping ("" or "robots[1]").
  YamlMapping(const YAML::Node& node, std::string field, const YamlPlace& place);
  // Adds a problem for each key that was not read.
  ~YamlMapping();
  YamlMapping(const YamlMapping&) = delete;
  YamlMapping& operator=(const YamlMapping&) = delete;

  // These functions return nullopt, or an empty list, if the key is absent or null. If the value
  // has another type or is out of range, they also add a problem.
  std::optional<std::string> Text(const std::string& key);
  std::optional<double> Number(const std::string& key, double min, double max);
  std::optional<double> Angle(const std::string& key);  // Reads an angle in radians.
  std::optional<std::uint64_t> Count(const std::string& key);
  std::optional<bool> Flag(const std::string& key);
  // Reads a value that must be one of two words. Returns whether it is the second word. Adds a
  // problem for other words.
  std::optional<bool> IsSecondOf(const std::string& key, const std::string& first,
                                 const std::string& second);
  std::vector<std::string> Texts(const std::string& key);
  std::vector<YAML::Node> List(const std::string& key);
  std::optional<YAML::Node> Any(const std::string& key);  // reads a value of any type
  // Calls `read` with each element of a list, and with the element's field for messages, such as
  // "robots[2]".
  template <typename Read>
  void Each(const std::string& key, std::size_t max, const Read& read) {
    const std::vector<YAML::Node> list = List(key);
    if (list.size() > max) {
      place_.AddProblem(list[max].Mark(), FieldOf(key),
                        key + " has at most " + std::to_string(max) + " entries");
      return;
    }
    for (std::size_t i = 0; i < list.size(); ++i) {
      read(list[i], FieldOf(key) + "[" + std::to_string(i) + "]");
    }
  }

  // Whether one of the functions above has read the key, and the key has a value other than null.
  bool Has(const std::string& key) const { return marks_.contains(key); }
  bool is_mapping() const { return is_mapping_; }  // false if the node has another type
  const YamlPlace& place() const { return place_; }
  std::string Source() const { return place_.Of(mark_, field_); }  // the place of the mapping
  // The path of a key, such as "robots[1].x".
  std::string FieldOf(const std::string& key) const {
    return field_.empty() ? key : field_ + "." + key;
  }
  // Adds a problem about the mapping, or about the value of a key, which may be missing.
  void AddProblem(std::string message) const {
    place_.AddProblem(mark_, field_, std::move(message));
  }
  void AddProblem(const std::string& key, std::string message) const;

 private:
  struct Entry {
    YAML::Mark mark;  // the place of the key
    YAML::Node value;
  };
  // Reads a scalar that is not in quotes, because a scalar in quotes is a text.
  std::optional<std::string> Plain(const std::string& key, const std::string& expected);
  // Reads a scalar, in quotes or not.
  std::optional<std::string> Scalar(const std::string& key, const std::string& expected);
  // Adds the problem that a key has a value of a wrong type.
  void Expect(const std::string& key, const std::string& expected, const std::string& found);

  const YamlPlace& place_;
  const std::string field_;
  const YAML::Mark mark_;
  const bool is_mapping_;
  std::map<std::string, Entry> unread_;      // entries that have not been read
  std::map<std::string, YAML::Mark> marks_;  // places of the values that have been read
  std::vector<std::string> known_;           // all keys that the caller has asked for
};

}  // namespace gsv::scenario
