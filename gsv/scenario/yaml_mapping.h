// Takes a YAML mapping apart, key by key, and complains, with line and column, of what it is not.
//
// Bounded  a mapping has kMostKeys, and so many complaints are kept: aliases may make a small file
//          large.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <yaml-cpp/yaml.h>

#include "gsv/base/error.h"

namespace gsv::scenario {

inline constexpr std::size_t kMostKeys = 64;
inline constexpr std::size_t kMostComplaints = 100;

// Where complaints go.
class YamlPlace {
 public:
  YamlPlace(std::string file, base::Problems& problems)
      : file_(std::move(file)), problems_(problems) {}

  std::string Of(const YAML::Mark& mark) const;  // "FILE:LINE:COLUMN", counted from 1
  void Complain(const YAML::Mark& mark, std::string message) const;

 private:
  const std::string file_;
  base::Problems& problems_;
};

class YamlMapping {
 public:
  // Complains of a node that is no mapping, and of keys that come twice.
  YamlMapping(const YAML::Node& node, const YamlPlace& place);
  // Complains of keys that nobody asked for.
  ~YamlMapping();
  YamlMapping(const YamlMapping&) = delete;
  YamlMapping& operator=(const YamlMapping&) = delete;

  // Each gives nothing where the key is absent, null or, after a complaint, something else.
  std::optional<std::string> Text(const std::string& key);
  std::optional<double> Number(const std::string& key, double least, double most);
  std::optional<double> Angle(const std::string& key);  // radians
  std::optional<std::uint64_t> Count(const std::string& key);
  std::optional<bool> Flag(const std::string& key);
  // Whether it is the second of two words, rather than the first.
  std::optional<bool> IsSecond(const std::string& key, const std::string& first,
                               const std::string& second);
  std::vector<std::string> Texts(const std::string& key);
  std::vector<YAML::Node> List(const std::string& key);
  std::optional<YAML::Node> Any(const std::string& key);

  // Whether it was asked for and was there, whatever it was.
  bool Had(const std::string& key) const { return marks_.contains(key); }
  const YAML::Mark& mark() const { return mark_; }

 private:
  struct Entry {
    YAML::Mark mark;  // of the key
    YAML::Node value;
  };
  std::optional<std::string> Scalar(const std::string& key, const std::string& expected);
  void Expect(const std::string& key, const std::string& expected, const std::string& found);

  const YamlPlace& place_;
  YAML::Mark mark_;
  std::map<std::string, Entry> left_;        // that nobody asked for yet
  std::map<std::string, YAML::Mark> marks_;  // of the values that were
  std::vector<std::string> known_;
};

}  // namespace gsv::scenario
