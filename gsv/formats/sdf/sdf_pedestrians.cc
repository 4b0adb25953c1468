#include "gsv/formats/sdf/sdf_pedestrians.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "gsv/formats/sdf/sdf_xml.h"
#include "gsv/formats/sdf/value_text.h"

namespace gsv::formats {
namespace {

using tinyxml2::XMLElement;

// Reads "x y" or "x y radius", in metres. Any other text gives a goal with NaN.
model::PedestrianGoal GoalFrom(const XMLElement& element) {
  const char* text = element.GetText();
  const std::vector<std::string> words = WordsOf(text == nullptr ? "" : text);
  std::array<double, 3> numbers{0, 0, 0};
  bool is_goal = words.size() == 2 || words.size() == 3;
  for (std::size_t i = 0; is_goal && i < words.size(); ++i) {
    const LeadingNumber number = LeadingNumberOf(words[i]);
    numbers[i] = number.value;
    is_goal = number.is_all;
  }
  if (!is_goal) numbers[0] = std::numeric_limits<double>::quiet_NaN();
  return {numbers[0], numbers[1], numbers[2]};
}

void ReadNumber(const XMLElement& parent, const char* name, double& value) {
  const XMLElement* element = parent.FirstChildElement(name);
  if (element != nullptr && element->QueryDoubleText(&value) != tinyxml2::XML_SUCCESS) {
    value = std::numeric_limits<double>::quiet_NaN();
  }
}

// Warns of attributes and elements that <gsv:pedestrians> does not have.
void ReportUnknownParts(const XMLElement& element, const ReadingContext& context) {
  static constexpr std::string_view kAttributes[] = {"name", "count"};
  static constexpr std::string_view kElements[] = {"gsv:goal",   "gsv:z",     "gsv:speed_deviation",
                                                   "gsv:radius", "gsv:speed", "gsv:height"};
  const auto is_of = [](const auto& names, const char* name) {
    return std::find(std::begin(names), std::end(names), name) != std::end(names);
  };
  for (auto* attribute = element.FirstAttribute(); attribute != nullptr;
       attribute = attribute->Next()) {
    if (is_of(kAttributes, attribute->Name())) continue;
    if (std::string_view(attribute->Name()).find(':') != std::string_view::npos) continue;
    context.Warn("<gsv:pedestrians> has no attribute \"" + std::string(attribute->Name()) +
                     "\"; it is ignored",
                 PlaceOf(context.source, element));
  }
  for (auto* child = element.FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement()) {
    if (is_of(kElements, child->Name())) continue;
    context.Warn("<" + std::string(child->Name()) +
                     "> is not an element of <gsv:pedestrians>; it is ignored",
                 PlaceOf(context.source, *child));
  }
}

}  // namespace

std::shared_ptr<const model::PedestrianGroup> ReadPedestrians(const XMLElement& element,
                                                              const ReadingContext& context) {
  ReportUnknownParts(element, context);
  auto group = std::make_shared<model::PedestrianGroup>();
  if (const char* name = element.Attribute("name")) group->name = name;
  if (element.Attribute("count") != nullptr) group->count = element.IntAttribute("count", 0);
  for (auto* goal = element.FirstChildElement("gsv:goal"); goal != nullptr;
       goal = goal->NextSiblingElement("gsv:goal")) {
    group->route.push_back(GoalFrom(*goal));
  }
  ReadNumber(element, "gsv:z", group->z);
  ReadNumber(element, "gsv:speed", group->speed);
  ReadNumber(element, "gsv:speed_deviation", group->speed_deviation);
  ReadNumber(element, "gsv:radius", group->radius);
  ReadNumber(element, "gsv:height", group->height);
  if (auto ok = model::Check(*group); !ok) {
    context.Warn("the pedestrians are ignored: " + ok.error().message,
                 PlaceOf(context.source, element));
    return nullptr;
  }
  return group;
}

}  // namespace gsv::formats
