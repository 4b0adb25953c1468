#include "gsv/formats/sdf/sdf_pedestrians.h"

#include <limits>
#include <sstream>
#include <string>

#include "gsv/formats/sdf/sdf_xml.h"

namespace gsv::formats {
namespace {

using tinyxml2::XMLElement;

// "x y" or "x y radius"; anything else gives numbers that are none.
model::PedestrianGoal GoalFrom(const XMLElement& element) {
  const char* text = element.GetText();
  std::istringstream stream(text == nullptr ? "" : text);
  stream.imbue(std::locale::classic());
  model::PedestrianGoal goal;
  const bool has_place = static_cast<bool>(stream >> goal.x >> goal.y);
  if (has_place && !(stream >> std::ws).eof()) stream >> goal.radius;
  if (!has_place || stream.fail() || !(stream >> std::ws).eof()) {
    goal.x = std::numeric_limits<double>::quiet_NaN();
  }
  return goal;
}

void ReadNumber(const XMLElement& parent, const char* name, double& value) {
  const XMLElement* element = parent.FirstChildElement(name);
  if (element != nullptr && element->QueryDoubleText(&value) != tinyxml2::XML_SUCCESS) {
    value = std::numeric_limits<double>::quiet_NaN();
  }
}

}  // namespace

std::shared_ptr<const model::PedestrianGroup> ReadPedestrians(const XMLElement& element,
                                                              const ReadingContext& context) {
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
    context.Warn("the pedestrians are left out: " + ok.error().message,
                 PlaceOf(context.source, element));
    return nullptr;
  }
  return group;
}

}  // namespace gsv::formats
