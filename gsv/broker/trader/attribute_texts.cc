#include "gsv/broker/trader/attribute_texts.h"

#include <charconv>
#include <cstdint>
#include <limits>
#include <variant>

namespace gsv::broker {
namespace {

using Member = std::variant<std::uint32_t TraderAttributes::*, FollowOption TraderAttributes::*,
                            bool TraderAttributes::*, std::string TraderAttributes::*>;

struct Attribute {
  std::string_view name;
  Member member;
};

constexpr Attribute kAttributes[] = {
    {"def_search_card", &TraderAttributes::def_search_card},
    {"max_search_card", &TraderAttributes::max_search_card},
    {"def_match_card", &TraderAttributes::def_match_card},
    {"max_match_card", &TraderAttributes::max_match_card},
    {"def_return_card", &TraderAttributes::def_return_card},
    {"max_return_card", &TraderAttributes::max_return_card},
    {"max_list", &TraderAttributes::max_list},
    {"def_hop_count", &TraderAttributes::def_hop_count},
    {"max_hop_count", &TraderAttributes::max_hop_count},
    {"def_follow_policy", &TraderAttributes::def_follow_policy},
    {"max_follow_policy", &TraderAttributes::max_follow_policy},
    {"max_link_follow_policy", &TraderAttributes::max_link_follow_policy},
    {"supports_modifiable_properties", &TraderAttributes::supports_modifiable_properties},
    {"supports_dynamic_properties", &TraderAttributes::supports_dynamic_properties},
    {"supports_proxy_offers", &TraderAttributes::supports_proxy_offers},
    {"request_id_stem", &TraderAttributes::request_id_stem},
};

std::string ToText(const std::string& octets) { return octets; }
template <typename Number>
std::string ToText(Number value) {
  return std::to_string(static_cast<std::uint32_t>(value));
}

void FromText(const std::string& text, std::string& value) { value = text; }
template <typename Number>
void FromText(const std::string& text, Number& value) {
  std::uint32_t number = 0;
  const char* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, number);
  std::uint32_t most = std::numeric_limits<std::uint32_t>::max();
  if (std::is_same_v<Number, bool>) most = 1;
  if (std::is_same_v<Number, FollowOption>)
    most = static_cast<std::uint32_t>(FollowOption::kAlways);
  if (read.ec == std::errc() && read.ptr == end && number <= most) {
    value = static_cast<Number>(number);
  }
}

}  // namespace

std::vector<std::pair<std::string, std::string>> AttributeTexts(
    const TraderAttributes& attributes) {
  std::vector<std::pair<std::string, std::string>> texts;
  for (const Attribute& attribute : kAttributes) {
    texts.emplace_back(
        attribute.name,
        std::visit([&](auto member) { return ToText(attributes.*member); }, attribute.member));
  }
  return texts;
}

void SetAttribute(std::string_view name, const std::string& text, TraderAttributes& attributes) {
  for (const Attribute& attribute : kAttributes) {
    if (attribute.name != name) continue;
    std::visit([&](auto member) { FromText(text, attributes.*member); }, attribute.member);
  }
}

}  // namespace gsv::broker
